#include "config.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "io/stl.hpp"
#include "littoral/error.hpp"
#include "littoral/support/both_files.hpp"

namespace littoral::sph {
namespace {

const std::vector<std::pair<std::string, Reconstruction>> k_reconstructions = {
    {"first_order", Reconstruction::first_order},
    {"unlimited", Reconstruction::unlimited},
    {"minmod", Reconstruction::minmod},
    {"van_leer", Reconstruction::van_leer}};
const std::vector<std::pair<std::string, WallStates>> k_wall_states = {
    {"linear", WallStates::linear},
    {"constant", WallStates::constant},
    {"extrapolated", WallStates::extrapolated}};
const std::vector<std::pair<std::string, RiemannSolver>> k_riemann_solvers = {
    {"linearised", RiemannSolver::linearised}, {"low_dissipation", RiemannSolver::low_dissipation}};
const std::vector<std::pair<std::string, Tension>> k_tensions = {{"plain", Tension::plain},
                                                                 {"switched", Tension::switched}};
const std::vector<std::pair<std::string, Precision>> k_precisions = {{"double", Precision::all_double},
                                                                     {"mixed", Precision::mixed}};
const std::vector<std::pair<std::string, Integrator>> k_integrators = {{"rk4", Integrator::rk4},
                                                                       {"midpoint", Integrator::midpoint}};
const std::vector<std::pair<std::string, GaugeConfig::Kind>> k_gauges = {
    {"point", GaugeConfig::Kind::point},
    {"elevation", GaugeConfig::Kind::elevation},
    {"pressure_disc", GaugeConfig::Kind::pressure_disc},
    {"force_disc", GaugeConfig::Kind::force_disc}};
const std::vector<std::pair<std::string, Config::InitialDistribution>> k_distributions = {
    {"lattice", Config::InitialDistribution::lattice}, {"relaxed", Config::InitialDistribution::relaxed}};

}  // namespace

void Config::bind(support::Binder& b) {
  b.key("scene", scene).doc("File of the scene, shared with the partner; relative to this file.");
  b.key("spacing", spacing)
      .unit("m")
      .required()
      .exclusive_min(0)
      .doc("Particle spacing dx of the initial lattice.");
  b.choice("initial_distribution", initial_distribution, k_distributions)
      .doc(
          "lattice: rows; relaxed: even, without rows that a vortex would strain apart. relaxed wants a "
          "domain "
          "full of water without open sides.");
  b.choice("fidelity", fidelity, support::k_fidelities)
      .doc(
          "Defaults of other keys at once. draft: kernel_radius 3 in 2-D; standard; reference: riemann "
          "low_dissipation. Left out: the scene's.");
  if (b.mode() == support::Binder::Mode::read) riemann = default_riemann(fidelity);
  b.key("kernel_radius", kernel_radius)
      .unit("dx")
      .min(2)
      .max(6)
      .doc("Radius R of the kernel in spacings; auto: 4 in 2-D (draft: 3), 2.7 in 3-D.");
  b.choice("reconstruction", reconstruction, k_reconstructions)
      .doc("States of the Riemann problem between two particles: how their gradients are used.");
  b.choice("wall_states", wall_states, k_wall_states)
      .doc(
          "A particle's Riemann problem with a body. One-sided, with all its gradients (linear) or none "
          "(constant); extrapolated: with dummies that take their states from the water around them.");
  b.choice("riemann", riemann, k_riemann_solvers)
      .doc(
          "linearised: eq. (12) of Di Mascio et al. 2021; low_dissipation: damps sound, and vortices, less.");
  b.choice("tension", tension, k_tensions)
      .doc(
          "Pressure force inside the water where p is below the reference pressure. plain: eq. (11) of Di "
          "Mascio et al. 2021; switched: its part that makes clumps left out (Sun et al. 2018).");
  b.choice("precision", precision, k_precisions)
      .doc("Of the pair loops; mixed: a pair in float, what it adds to and the particles in double.");
  b.section("shifting", "Keeps the particles evenly spread.", [&] {
    b.key("enabled", shifting).doc("Move particles towards voids, along the surface only where it is near.");
  });
  b.section("time", "Limits of the time step.", [&] {
    b.choice("integrator", integrator, k_integrators)
        .doc("rk4: classical, four slopes a step; midpoint: two slopes, of second order.");
    b.key("cfl", cfl).unit("-").exclusive_min(0).max(1).doc("Of R / c; auto: 0.375 (rk4), 0.27 (midpoint).");
    b.key("viscous_cfl", viscous_cfl)
        .unit("-")
        .exclusive_min(0)
        .max(1)
        .doc("Of R^2 / nu; auto: 0.035 (rk4), 0.025 (midpoint).");
    b.key("force_cfl", force_cfl).unit("-").exclusive_min(0).max(2).doc("Of sqrt(R / |du/dt|).");
  });
  b.section("neighbors", "Lists of neighbours.", [&] {
    b.key("skin", skin)
        .unit("dx")
        .exclusive_min(0)
        .max(4)
        .doc(
            "How far a particle may go before lists are made anew, at most: less where lists and pairs "
            "together "
            "cost least then.");
  });
  b.section("ranks", "A run on several MPI ranks.", [&] {
    b.key("load_drift", load_drift)
        .unit("-")
        .min(1)
        .max(100)
        .doc(
            "Space is divided anew when the fullest rank's share has grown by this factor since the last "
            "time.");
  });
  b.section("output", "What is written besides scalars.", [&] {
    b.key("fields", fields)
        .doc("Of the particles: velocity, pressure, density, volume, zone, surface, normal, shift, id.");
  });
  b.list<GaugeConfig>(
      "gauges", "Places recorded each window, in gauges.csv.", gauges,
      [](support::Binder& item, GaugeConfig& gauge) {
        item.key("name", gauge.name).required().doc("Column prefix.");
        item.choice("kind", gauge.kind, k_gauges)
            .doc(
                "point: pressure and velocity; elevation: of the surface on a vertical line; pressure_disc: "
                "mean over a disc of what the particles there have; force_disc: force on a disc of a body's "
                "wall "
                "over its area, as a sensor shows it.");
        item.key("position", gauge.position).unit("m").required().doc("x, y, z.");
        item.key("normal", gauge.normal).doc("Of a disc; out of the water.");
        item.key("diameter", gauge.diameter).unit("m").min(0).doc("Of a disc.");
      });
  for (std::size_t k = 0; k < gauges.size(); ++k) {
    const std::string at = "gauges[" + std::to_string(k) + "].";
    if (!gauges[k].is_disc()) continue;
    b.check(gauges[k].diameter > 0.0, at + "diameter", "a disc needs a diameter above 0.");
    b.check(norm(gauges[k].normal) > 0.0, at + "normal", "has no direction.");
  }
  coupling.bind(b);
  const std::vector<std::string> known = {"velocity", "pressure", "density", "volume", "zone",
                                          "surface",  "normal",   "shift",   "id"};
  for (const auto& field : fields)
    b.check(std::find(known.begin(), known.end(), field) != known.end(), "output.fields",
            "no field is called '" + field + "'");
}

namespace {

/// A gauge outside the domain would record nothing but NaN.
void check_gauges(const std::string& path, const RunConfig& config) {
  const support::Scene& scene = config.scene;
  std::ostringstream problems;
  const auto next = [&] { return problems.tellp() > 0 ? "\n" : ""; };
  for (const GaugeConfig& gauge : config.sph.gauges) {
    if (gauge.kind == GaugeConfig::Kind::force_disc && scene.bodies.empty())
      problems << next() << path << ": gauge '" << gauge.name
               << "': a force_disc lies in a body's wall, and the scene has no bodies. Take a pressure_disc.";
    for (std::size_t d = 0; d < 3; ++d) {
      if (!scene.active(d) || (d == 2 && gauge.kind == GaugeConfig::Kind::elevation)) continue;
      const double lower = scene.domain.lower[d], upper = scene.domain.upper[d];
      const double slack = 1e-9 * (upper - lower);  // a place on the edge, by a formula
      if (gauge.position[d] >= lower - slack && gauge.position[d] <= upper + slack) continue;
      problems << next() << path << ": gauge '" << gauge.name << "': "
               << "xyz"[d] << " = " << gauge.position[d] << " m is outside the domain, which reaches from "
               << lower << " to " << upper << " m. Move it inside.";
    }
  }
  if (problems.tellp() > 0) throw ConfigError(problems.str());
}

}  // namespace

RunConfig read_config(const std::string& path, const std::vector<std::string>& settings,
                      const std::vector<std::string>& scene_settings) {
  support::Document document = support::Document::from_file(path);
  for (const auto& setting : settings) document.set(setting);
  RunConfig config;
  config.scene = support::read_both_files(document, scene_settings,
                                          [&](support::Binder& binder, const support::Scene& scene) {
                                            config.sph.fidelity = scene.fidelity;
                                            config.sph.bind(binder);
                                          });
  check_gauges(path, config);
  for (auto& gauge : config.sph.gauges) gauge.dry_pressure = config.scene.fluid.reference_pressure;
  if (!std::isfinite(config.scene.fluid.sound_speed))
    throw ConfigError(
        document.resolve(config.sph.scene) +
        ": fluid.sound_speed is infinite; particles need a finite one, 10 times the highest speed.");
  if (config.sph.tension == Tension::switched && !config.scene.bodies.empty())
    throw ConfigError(path +
                      ": tension is switched, which does not know the walls of bodies. Use plain here.");
  if (config.sph.initial_distribution == Config::InitialDistribution::relaxed) {
    bool closed = !config.scene.has_free_surface();
    for (std::size_t d = 0; d < 3; ++d)
      if (config.scene.dimension == 3 || d != 1)
        for (const auto side : config.scene.domain.sides[d])
          closed = closed && side != support::Scene::Side::open;
    if (!closed || !config.scene.bodies.empty())
      throw ConfigError(path +
                        ": initial_distribution is relaxed, which wants a domain full of water without open "
                        "sides and bodies. Use lattice here.");
  }
  return config;
}

std::string resolved_text(RunConfig config) {
  support::Binder scene(support::Binder::Mode::resolved), sph(support::Binder::Mode::resolved);
  config.scene.bind(scene);
  config.sph.bind(sph);
  std::istringstream lines(scene.text());
  std::string text = sph.text() + "---\nscene:\n";
  for (std::string line; std::getline(lines, line);) text += line.empty() ? "\n" : "  " + line + "\n";
  return text;
}

std::string help_text() {
  support::Binder binder(support::Binder::Mode::help);
  Config config;
  config.bind(binder);
  return "# sph.yaml\n" + binder.text() + "\n# scene.yaml\n" + support::Scene::help();
}

template <int D>
Numerics<D> numerics_of(const RunConfig& config) {
  const auto& [scene, sph] = config;
  Numerics<D> numerics;
  numerics.eos = {scene.fluid.density, scene.fluid.sound_speed, scene.fluid.reference_pressure};
  numerics.viscosity = scene.fluid.viscosity;
  for (std::size_t d = 0; d < D; ++d) numerics.gravity[d] = scene.gravity[scene_axis<D>(d)];
  if (scene.has_body_force()) {
    const std::array<support::Formula, 3> force = {scene.body_force.x, scene.body_force.y,
                                                   scene.body_force.z};
    numerics.body_force.emplace();
    for (std::size_t d = 0; d < D; ++d) (*numerics.body_force)[d] = force[scene_axis<D>(d)];
  }
  numerics.free_surface = scene.has_free_surface();
  numerics.spacing = sph.spacing;
  numerics.kernel_radius = sph.kernel_radius.value_or(default_kernel_radius(sph.fidelity, D)) * sph.spacing;
  numerics.skin = sph.skin * sph.spacing;
  numerics.reconstruction = sph.reconstruction;
  numerics.wall_states = sph.wall_states;
  numerics.riemann = sph.riemann;
  numerics.tension = sph.tension;
  numerics.shifting = sph.shifting;
  numerics.reference_velocity =
      scene.reference_velocity > 0.0 ? scene.reference_velocity : 0.1 * scene.fluid.sound_speed;
  numerics.precision = sph.precision;
  numerics.integrator = sph.integrator;
  numerics.cfl = sph.cfl.value_or(default_cfl(sph.integrator));
  numerics.viscous_cfl = sph.viscous_cfl.value_or(default_viscous_cfl(sph.integrator));
  numerics.force_cfl = sph.force_cfl;
  return numerics;
}

template <int D>
DomainBox<D> domain_of(const RunConfig& config) {
  const auto& [scene, sph] = config;
  const double reach = numerics_of<D>(config).kernel_radius + 2.0 * sph.skin * sph.spacing;
  DomainBox<D> box;
  std::string problems;
  for (std::size_t d = 0; d < D; ++d) {
    const std::size_t axis = scene_axis<D>(d);
    box.lower[d] = scene.domain.lower[axis];
    box.upper[d] = scene.domain.upper[axis];
    box.sides[d] = scene.domain.sides[axis];
    const bool closed =
        box.sides[d][0] != support::Scene::Side::open && box.sides[d][1] != support::Scene::Side::open;
    if (!closed) continue;
    std::ostringstream text;
    const double length = box.length(d), rows = length / sph.spacing;
    const char name = "xyz"[axis];
    if (std::fabs(rows - std::round(rows)) > 1e-6 * rows) {
      text << "spacing " << sph.spacing << " m does not divide the domain's length along " << name << ", "
           << length << " m, which is closed at both ends. Next that do: " << length / std::floor(rows + 1.0)
           << ", " << length / std::max(1.0, std::floor(rows)) << ".\n";
    }
    if (length < reach)
      text << "the domain is " << length << " m long along " << name
           << ", less than the reach of the neighbour lists, " << reach << " m. Use a smaller spacing.\n";
    problems += text.str();
  }
  if (!problems.empty()) throw ConfigError("sph.yaml: " + problems.substr(0, problems.size() - 1));
  return box;
}

namespace {

std::shared_ptr<const TriangleSurface> read_surface(const support::BodySpec& spec) {
  return std::make_shared<const TriangleSurface>(read_triangles(spec.file, spec.scale),
                                                 "body '" + spec.name + "', " + spec.file);
}

/// Through a body thinner than a kernel radius the water of one side would feel that of the other. A plate
/// has no thickness and keeps them apart by itself; of a surface from a file only the whole is looked at.
template <int D>
void require_thickness(const support::BodySpec& spec, const Body& body, double kernel_radius) {
  if (body.holds_fluid() || body.is_sheet()) return;
  double least = spec.shape == support::BodySpec::Shape::wedge ? std::min(spec.size[0], spec.size[2])
                                                               : std::numeric_limits<double>::infinity();
  const auto corners = body.local_bounds();
  for (std::size_t d = 0; d < D; ++d) {
    const std::size_t axis = scene_axis<D>(d);
    least = std::min(least, corners[1][axis] - corners[0][axis]);
  }
  if (least >= kernel_radius) return;
  std::ostringstream text;
  text << "bodies: '" << spec.name << "' is " << least << " m thick, less than the kernel radius, "
       << kernel_radius
       << " m: water on one side would feel the water on the other. Use a smaller spacing or a thicker body.";
  throw ConfigError(text.str());
}

/// A solid that stays where no water can feel it is a slip of its position or scale.
template <int D>
void require_in_reach(const Body& body, const DomainBox<D>& box, double kernel_radius) {
  if (body.moves() || body.holds_fluid()) return;
  const auto corners = body.bounds();
  for (std::size_t d = 0; d < D; ++d) {
    if (box.is_periodic(d)) continue;
    const double low = corners[0][scene_axis<D>(d)], high = corners[1][scene_axis<D>(d)];
    const auto reach = [&](std::size_t side) {
      return box.sides[d][side] == support::Scene::Side::open ? kernel_radius : 0.0;
    };
    if (high > box.lower[d] - reach(0) && low < box.upper[d] + reach(1)) continue;
    std::ostringstream text;
    text << "bodies: '" << body.name() << "' lies wholly outside of the domain: along "
         << "xyz"[scene_axis<D>(d)] << " from " << low << " to " << high << " m, the domain from "
         << box.lower[d] << " to " << box.upper[d] << " m. Check its position, and the scale of a file.";
    throw ConfigError(text.str());
  }
}

}  // namespace

template <int D>
std::unique_ptr<Walls<D>> walls_of(const RunConfig& config, const std::array<double, D>& origin) {
  if (config.scene.bodies.empty()) return nullptr;
  const auto numerics = numerics_of<D>(config);
  std::vector<Body> bodies;
  for (const auto& spec : config.scene.bodies) {
    bodies.emplace_back(spec, D == 2, numerics.kernel_radius / numerics.eos.c,
                        spec.shape == support::BodySpec::Shape::stl ? read_surface(spec) : nullptr);
    require_thickness<D>(spec, bodies.back(), numerics.kernel_radius);
    require_in_reach<D>(bodies.back(), domain_of<D>(config), numerics.kernel_radius);
  }
  auto walls = std::make_unique<Walls<D>>(std::move(bodies), numerics, domain_of<D>(config),
                                          Lattice<D>{origin, numerics.spacing});
  std::vector<WallDisc> discs;
  for (const GaugeConfig& gauge : config.sph.gauges)
    if (gauge.kind == GaugeConfig::Kind::force_disc)
      discs.push_back({gauge.name, gauge.position, gauge.normal, gauge.diameter});
  if (!discs.empty()) walls->watch(discs, domain_of<D>(config));
  return walls;
}

template std::unique_ptr<Walls<2>> walls_of<2>(const RunConfig&, const std::array<double, 2>&);
template std::unique_ptr<Walls<3>> walls_of<3>(const RunConfig&, const std::array<double, 3>&);
template Numerics<2> numerics_of<2>(const RunConfig&);
template Numerics<3> numerics_of<3>(const RunConfig&);
template DomainBox<2> domain_of<2>(const RunConfig&);
template DomainBox<3> domain_of<3>(const RunConfig&);

}  // namespace littoral::sph
