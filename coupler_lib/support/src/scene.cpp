#include "littoral/support/scene.hpp"

#include <array>
#include <cstdio>

#include "littoral/error.hpp"
#include "littoral/support/run_plan.hpp"
#include "scene_checks.hpp"

namespace littoral::support {
namespace {

using Side = Scene::Side;
using coupler::Schedule;

const std::vector<std::pair<std::string, Side>> k_sides = {
    {"open", Side::open}, {"periodic", Side::periodic}, {"symmetry", Side::symmetry}};
const std::vector<std::pair<std::string, Scene::CouplingKind>> k_kinds = {
    {"none", Scene::CouplingKind::none},
    {"imposed", Scene::CouplingKind::imposed},
    {"forced", Scene::CouplingKind::forced}};
const std::vector<std::pair<std::string, Schedule>> k_schedules = {{"serial", Schedule::serial},
                                                                   {"predicted", Schedule::predicted},
                                                                   {"iterated", Schedule::iterated},
                                                                   {"concurrent", Schedule::concurrent}};

/// FNV-1a: not against forgery, only against two different files.
std::string digest_of(const std::string& text) {
  std::uint64_t hash = 0xcbf29ce484222325ULL;
  for (const char c : text) {
    hash ^= static_cast<unsigned char>(c);
    hash *= 0x100000001b3ULL;
  }
  std::array<char, 20> out{};
  std::snprintf(out.data(), out.size(), "%016llx", static_cast<unsigned long long>(hash));
  return out.data();
}

}  // namespace

void Scene::bind(Binder& b) {
  b.key("title", title).doc("Shown in logs and pictures.");
  b.key("dimension", dimension).min(2).max(3).doc("2: the plane (x, z); 3: z is up.");
  b.choice("fidelity", fidelity, k_fidelities)
      .doc("Cost and error of both programs by one word: default of each one's own key of this name.");
  b.numbers("constants", "For every formula of the scene; an entry may be a formula of the ones before it.",
            constants);
  b.section("fluid", "The water.", [&] {
    b.key("density", fluid.density).unit("kg/m^3").exclusive_min(0).doc("rho0, at the reference pressure.");
    b.key("sound_speed", fluid.sound_speed)
        .unit("m/s")
        .required()
        .exclusive_min(0)
        .may_be_infinite()
        .doc(
            "c; at least 10 times the highest speed. Infinite (.inf): incompressible, without particles "
            "only.");
    b.key("reference_pressure", fluid.reference_pressure).unit("Pa").doc("p0, also on the free surface.");
    b.key("viscosity", fluid.viscosity).unit("m^2/s").min(0).doc("nu, kinematic; 0: no viscous term.");
  });
  b.key("gravity", gravity).unit("m/s^2").doc("Acceleration vector, as [0, 0, -9.81].");
  b.section("body_force", "Acceleration of all water besides gravity.", [&] {
    b.key("x", body_force.x).unit("m/s^2").doc("Along x, a formula of x, y, z, t.");
    b.key("y", body_force.y).unit("m/s^2").doc("Along y; 3-D only.");
    b.key("z", body_force.z).unit("m/s^2").doc("Along z.");
  });
  b.section("domain", "The box of the whole flow; both solvers close it the same way.", [&] {
    b.key("lower", domain.lower).unit("m").required().doc("Lower corner.");
    b.key("upper", domain.upper).unit("m").required().doc("Upper corner.");
    b.choices("x", domain.sides[0], k_sides).doc("What closes the lower and the upper end of x.");
    b.choices("y", domain.sides[1], k_sides).doc("Of y; 3-D only.");
    b.choices("z", domain.sides[2], k_sides).doc("Of z.");
  });
  b.section("initial", "State at t = 0. In 2-D the velocity is (u, w).", [&] {
    b.key("u", initial.u).unit("m/s").doc("Velocity along x.");
    b.key("v", initial.v).unit("m/s").doc("Velocity along y; 3-D only.");
    b.key("w", initial.w).unit("m/s").doc("Velocity along z.");
    b.key("p", initial.p).unit("Pa").doc("Pressure.");
    b.key("surface", initial.surface)
        .unit("m")
        .doc("Below 0 in water, above 0 in air; only sign and zero level count. Left out: water everywhere.");
  });
  b.list<Region>("regions", "Boxes of the particle region: the nominal faces where particles end.", regions,
                 [](Binder& item, Region& region) {
                   item.key("lower", region.lower).unit("m").required().doc("Lower corner.");
                   item.key("upper", region.upper).unit("m").required().doc("Upper corner.");
                 });
  b.list<BodySpec>("bodies", "Solids in the flow, fixed or moving as prescribed.", bodies,
                   [](Binder& item, BodySpec& body) { body.bind(item); });
  b.section("coupling", "How particles and grid meet.", [&] {
    b.choice("kind", coupling.kind, k_kinds)
        .doc(
            "none: one solver alone; imposed: grid cells in the region blanked (Coupling I); forced: kept "
            "and "
            "forced (Coupling II).");
    b.key("blending_width", coupling.blending_width)
        .unit("m")
        .min(0)
        .doc("Layer outside the region's open faces where both states are blended.");
    b.key("driven_width", coupling.driven_width)
        .unit("m")
        .min(0)
        .doc("Layer beyond it where particles follow the grid; at least one kernel radius.");
    b.key("fringe_layers", coupling.fringe_layers)
        .min(2)  // the reconstruction at a computed cell's face reads two cells on either side
        .doc("Grid cells on which the particles' state is imposed.");
    b.choice("schedule", coupling.schedule.schedule, k_schedules)
        .doc("How the solvers take turns in a window.");
    b.key("passes", coupling.schedule.passes).min(1).doc("Passes of a window; iterated only.");
    b.key("dt", coupling.window.dt).unit("s").exclusive_min(0).doc("Length of a window; auto: by substeps.");
    b.key("substeps", coupling.window.substeps).min(1).doc("Particle steps in a window, where dt is auto.");
    b.key("deadline", coupling.deadline)
        .unit("s")
        .exclusive_min(0)
        .doc("Wall time that a program waits for its partner.");
  });
  b.section("time", "When to stop and when to write.", [&] {
    b.key("end", time.end).unit("s").required().exclusive_min(0).doc("Physical time at which the run ends.");
    b.key("max_windows", time.max_windows).min(-1).doc("Stop after so many windows; -1: no limit.");
    b.key("field_interval", time.field_interval)
        .unit("s")
        .min(0)
        .doc("Between fields; 0: first and last only.");
    b.key("checkpoint_interval", time.checkpoint_interval)
        .unit("s")
        .min(0)
        .doc("Between checkpoints; 0: none.");
  });
  b.key("reference_velocity", reference_velocity)
      .unit("m/s")
      .min(0)
      .doc("U_ref of the particle shifting and of the forcing; 0: a tenth of the sound speed.");
  check_scene(*this, b);
}

Scene Scene::from_file(const std::string& path, const std::vector<std::string>& settings) {
  Document document = Document::from_file(path);
  for (const auto& setting : settings) document.set(setting);
  Binder binder(document);
  Scene scene;
  scene.bind(binder);
  binder.finish();
  scene.digest = digest_of(scene.resolved());
  Scene lasting = scene;
  lasting.title.clear();
  lasting.time = Time{};
  lasting.coupling.deadline = 0.0;
  scene.restart_digest = digest_of(lasting.resolved());
  for (BodySpec& body : scene.bodies)
    if (!body.file.empty()) body.file = document.resolve(body.file);
  return scene;
}

std::string Scene::help() {
  Binder binder(Binder::Mode::help);
  Scene().bind(binder);
  return binder.text();
}

std::string Scene::resolved() const {
  Binder binder(Binder::Mode::resolved);
  Scene copy = *this;  // bind() takes references to members; in this mode it only reads them
  copy.bind(binder);
  return binder.text();
}

bool Scene::has_body_force() const {
  for (const Formula* component : {&body_force.x, &body_force.y, &body_force.z})
    if (!component->is_constant() || (*component)(0, 0, 0, 0) != 0.0) return true;
  return false;
}

bool Scene::open_face(const Region& region, std::size_t direction, std::size_t side) const {
  if (!active(direction)) return false;
  // as far apart as round-off of decimal input
  const double tolerance = 1e-9 * (domain.upper[direction] - domain.lower[direction]);
  return side == 0 ? region.lower[direction] > domain.lower[direction] + tolerance
                   : region.upper[direction] < domain.upper[direction] - tolerance;
}

coupler::Contract Scene::contract() const {
  const auto word = [](auto value, const auto& words) {
    for (const auto& entry : words)
      if (entry.second == value) return entry.first;
    return std::string();
  };
  const std::array<std::string, 3> axes = {"x", "y", "z"};
  coupler::Contract contract;
  const auto vector = [&](const std::string& key, const coupler::Vec3& v) {
    for (std::size_t d = 0; d < 3; ++d) contract.set(key + "." + axes[d], v[d]);
  };
  contract.set("dimension", dimension);
  contract.set("axes", dimension == 2 ? "x right, z up, plane (x, z)" : "x, y, z up");
  contract.set("sign of phi", "negative in water");
  contract.set("fluid.density", fluid.density);
  contract.set("fluid.sound_speed", fluid.sound_speed);
  contract.set("fluid.reference_pressure", fluid.reference_pressure);
  contract.set("fluid.viscosity", fluid.viscosity);
  vector("gravity", gravity);
  contract.set("free surface", has_free_surface() ? "yes" : "no");
  contract.set("phi crosses", level_set_crosses(*this) ? "yes" : "no");
  vector("domain.lower", domain.lower);
  vector("domain.upper", domain.upper);
  for (std::size_t d = 0; d < 3; ++d)
    if (active(d))
      contract.set("domain." + axes[d],
                   word(domain.sides[d][0], k_sides) + ", " + word(domain.sides[d][1], k_sides));
  contract.set("regions", static_cast<double>(regions.size()));
  for (std::size_t r = 0; r < regions.size(); ++r) {
    vector("regions[" + std::to_string(r) + "].lower", regions[r].lower);
    vector("regions[" + std::to_string(r) + "].upper", regions[r].upper);
  }
  contract.set("coupling.kind", word(coupling.kind, k_kinds));
  contract.set("coupling.blending_width", coupling.blending_width);
  contract.set("coupling.driven_width", coupling.driven_width);
  contract.set("coupling.fringe_layers", coupling.fringe_layers);
  contract.set("coupling.schedule", word(coupling.schedule.schedule, k_schedules));
  contract.set("coupling.passes", coupling.schedule.sph_passes());
  if (coupling.window.dt)
    contract.set("coupling.dt", *coupling.window.dt);
  else
    contract.set("coupling.substeps", coupling.window.substeps);
  contract.set("time.end", time.end);
  contract.set("time.max_windows", time.max_windows);
  contract.set("scene digest", digest);
  // Another solver that has no scene file need not repeat what is only ours: the rest of the flow's domain,
  // the layers within the particles' region, when we stop early, the file.
  for (const auto& entry : std::vector<coupler::Contract::Entry>(contract.entries()))
    if (entry.key.rfind("domain.", 0) == 0) contract.make_optional(entry.key);
  for (const char* key : {"coupling.blending_width", "coupling.driven_width", "coupling.fringe_layers",
                          "time.max_windows", "scene digest"})
    contract.make_optional(key);
  return contract;
}

}  // namespace littoral::support
