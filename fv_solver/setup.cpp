#include "setup.hpp"

#include <cmath>

#include "boundary/ghosts.hpp"
#include "boundary/prescribed.hpp"
#include "checks.hpp"
#include "dual_time/plain.hpp"
#include "dual_time/prescribed.hpp"
#include "grid/box.hpp"
#include "grid/find_joins.hpp"
#include "grid/grid_file.hpp"
#include "grid/loops.hpp"
#include "grid/plate.hpp"
#include "grid/quality.hpp"
#include "grid/ring.hpp"
#include "grid/space.hpp"
#include "implicit/multigrid_solver.hpp"
#include "littoral/error.hpp"
#include "littoral/support/run_plan.hpp"
#include "parallel/cut.hpp"
#include "parallel/load_report.hpp"

namespace littoral::fv {
namespace {

template <int D>
Fluid<D> fluid_of(const support::Scene& scene) {
  Fluid<D> fluid;
  fluid.density = scene.fluid.density;
  fluid.reference_pressure = scene.fluid.reference_pressure;
  fluid.viscosity = scene.fluid.viscosity;
  fluid.inverse_c2 = 1.0 / (scene.fluid.sound_speed * scene.fluid.sound_speed);  // 0 where c is infinite
  for (std::size_t k = 0; k < D; ++k) fluid.gravity[k] = scene.gravity[axis_in_space<D>(k)];
  return fluid;
}

/// The scene's initial formulas, at any time.
template <int D>
FlowFunction<D> initial_flow(const support::Scene& scene) {
  return [initial = scene.initial](const std::array<double, D>& at, double t) {
    const coupler::Vec3 x = vector_in_space<D>(at);
    PointState<D> s;
    s.p = initial.p(x[0], x[1], x[2], t);
    const coupler::Vec3 u = {initial.u(x[0], x[1], x[2], t), initial.v(x[0], x[1], x[2], t),
                             initial.w(x[0], x[1], x[2], t)};
    for (std::size_t k = 0; k < D; ++k) s.u[k] = u[axis_in_space<D>(k)];
    return s;
  };
}

template <int D>
std::unique_ptr<StepSolver<D>> step_solver_of(const FvConfig& config, const support::Scene& scene) {
  using Method = FvConfig::DualTime::Method;
  if (config.dual_time.method == Method::plain)
    return std::make_unique<PlainDualTime<D>>(config.dual_time.pseudo_cfl);
  if (config.dual_time.method == Method::prescribed)
    return std::make_unique<PrescribedFlow<D>>(
        [flow = initial_flow<D>(scene)](const std::array<double, D>& x, double t) { return flow(x, t).u; });
  if (config.dual_time.precision == FvConfig::DualTime::Precision::single)
    return std::make_unique<MultigridSolver<D, float>>();
  return std::make_unique<MultigridSolver<D, double>>();
}

template <int D>
std::vector<Sponge<D>> sponges_of(const FvConfig& config) {
  std::vector<Sponge<D>> sponges;
  for (const SpongeConfig& s : config.sponges) {
    Sponge<D> sponge{s.axis, s.centre, s.from, s.to, s.rate, s.power, {}, {}};
    if (D == 2) sponge.centre[1] = 0.0;
    const std::array<const std::optional<support::Formula>*, 3> formulas = {&s.u, &s.v, &s.w};
    const std::string at = "sponges[" + std::to_string(sponges.size()) + "].";
    for (std::size_t k = 0; k < D; ++k) {
      const std::size_t axis = axis_in_space<D>(k);
      if (const auto& formula = *formulas[axis]) sponge.velocity[k] = prescribed(*formula, at + "uvw"[axis]);
    }
    if (s.surface) sponge.surface = prescribed(*s.surface, at + "surface");
    sponges.push_back(std::move(sponge));
  }
  return sponges;
}

/// Whether the surface leaves a corner of a cell in the air: a grid under water needs no level set.
template <int D>
bool meets_air(const std::vector<Block<D>>& blocks, const Prescribed& surface) {
  for (const Block<D>& block : blocks) {
    bool air = false;
    std::array<int, D> upper = block.extent.n;
    for (int& n : upper) ++n;
    for_each_index<D>({}, upper, [&](const std::array<int, D>& index) {
      std::array<double, D> x;
      for (std::size_t k = 0; k < D; ++k)
        x[k] = block.node[k][static_cast<std::size_t>(block.node_extent.at(index))];
      air = air || surface(vector_in_space<D>(x), 0.0) > 0.0;
    });
    if (air) return true;
  }
  return false;
}

double velocity_scale(const FvConfig& config, const support::Scene& scene) {
  if (std::isfinite(scene.velocity_scale())) return scene.velocity_scale();
  if (config.dual_time.pseudo_sound_speed) return *config.dual_time.pseudo_sound_speed;
  throw ConfigError(
      "the sound speed is infinite, so the flow's velocity scale is unknown: give the scene's "
      "reference_velocity, or dual_time.pseudo_sound_speed");
}

/// A pressure that falls along gravity cannot be the same at both ends of a periodic pair.
template <int D>
void check_gravity(const std::vector<Block<D>>& blocks, const support::Scene& scene) {
  for (const Block<D>& block : blocks)
    for (const Window<D>& w : block.windows) {
      if (w.condition != Condition::join) continue;
      double along = 0.0, scale = 0.0;
      for (std::size_t k = 0; k < D; ++k) {
        along += w.join.offset[k] * scene.gravity[axis_in_space<D>(k)];
        scale += std::abs(w.join.offset[k] * scene.gravity[axis_in_space<D>(k)]);
      }
      constexpr double k_round_off = 1e-12;
      if (std::abs(along) > k_round_off * scale)
        throw ConfigError("block '" + block.name + "', face '" + w.name +
                          "' is joined with an offset along which gravity has a component: a hydrostatic "
                          "pressure cannot be periodic. A driving force belongs into source");
    }
}

}  // namespace

template <int D>
Grid<D> build_grid(const FvConfig& config, const support::Scene& scene) {
  Grid<D> grid;
  std::string problems;
  Neighbourhood others;
  others.automatic = config.joins == FvConfig::Joins::automatic;
  others.alone = config.n_parts() == 1;
  const auto attempt = [&](auto&& build) {
    try {
      for (Block<D>& block : build()) {
        check_windows(block);
        grid.blocks.push_back(std::move(block));
      }
    } catch (const ConfigError& problem) {
      problems += (problems.empty() ? "" : "\n") + std::string(problem.what());
    }
  };
  using Blocks = std::vector<Block<D>>;
  for (const BlockConfig& block : config.blocks)
    attempt([&] { return Blocks{build_block<D>(block, scene, others)}; });
  for (const RingConfig& ring : config.rings)
    attempt([&] { return Blocks{build_ring<D>(ring, scene, others)}; });
  for (const PlateConfig& plate : config.plates)
    attempt([&] { return build_plate<D>(plate, scene, others); });
  for (const GridFileConfig& file : config.grid_files)
    attempt([&] { return build_grid_file<D>(file, scene, others, grid.notes); });
  if (!problems.empty()) throw ConfigError(problems);
  const std::vector<std::string> joins = find_joins(grid.blocks), quality = quality_report(grid.blocks);
  grid.notes.insert(grid.notes.end(), joins.begin(), joins.end());
  grid.notes.insert(grid.notes.end(), quality.begin(), quality.end());
  check_gravity<D>(grid.blocks, scene);
  for (Block<D>& block : grid.blocks) set_outlet_lengths(block);
  grid.overset = assemble_overset<D>(grid.blocks, config.overset);
  grid.notes.insert(grid.notes.end(), grid.overset.notes.begin(), grid.overset.notes.end());
  return grid;
}

namespace {

/// What a rank solves of a grid, and how it is tied to the rest.
template <int D>
struct OwnPart {
  std::vector<Block<D>> blocks;
  Exchange<D> exchange;
};

template <int D>
OwnPart<D> own_part(Grid<D> grid, const FvConfig& config, const Ranks& ranks,
                    std::vector<std::string>& notes) {
  OwnPart<D> own;
  if (!ranks.several()) {
    own.exchange = Exchange<D>(grid.blocks, grid.overset.links);
    own.blocks = std::move(grid.blocks);
    return own;
  }
  const std::vector<Piece<D>> pieces =
      deal<D>(cut_planes<D>(grid.blocks, config.ranks.cut_layers), ranks.size());
  CutGrid<D> parts = cut<D>(grid.blocks, grid.overset.links, pieces, ranks);
  grid.blocks.clear();
  for (std::string& note : load_report<D>(parts.layout)) notes.push_back(std::move(note));
  own.exchange = Exchange<D>(parts.blocks, parts.overset, parts.layout);
  for (const std::size_t b : parts.layout.owners.mine()) own.blocks.push_back(std::move(parts.blocks[b]));
  return own;
}

}  // namespace

namespace {

/// The grid's own sources per volume, and the scene's acceleration of all water: rho0 a.
template <int D>
void set_sources(const FvConfig& config, const support::Scene& scene, Stepper<D>& stepper) {
  const auto& source = config.source;
  if (!source.mass && !source.u && !source.v && !source.w && !scene.has_body_force()) return;
  const auto given = [](const std::optional<support::Formula>& f, const char* key) {
    return prescribed(f.value_or(support::Formula()), key);
  };
  const Prescribed mass = given(source.mass, "source.mass");
  const std::array<Prescribed, 3> force = {given(source.u, "source.u"), given(source.v, "source.v"),
                                           given(source.w, "source.w")};
  const std::array<Prescribed, 3> acceleration = {prescribed(scene.body_force.x, "body_force.x"),
                                                  prescribed(scene.body_force.y, "body_force.y"),
                                                  prescribed(scene.body_force.z, "body_force.z")};
  stepper.set_source(
      [mass, force, acceleration, rho0 = scene.fluid.density](const std::array<double, D>& at, double t) {
        const coupler::Vec3 x = vector_in_space<D>(at);
        Source<D> s;
        s.mass = mass(x, t);
        for (std::size_t k = 0; k < D; ++k) {
          const std::size_t axis = axis_in_space<D>(k);
          s.momentum[k] = force[axis](x, t) + rho0 * acceleration[axis](x, t);
        }
        return s;
      });
}

}  // namespace

template <int D>
Stepper<D> make_stepper(const FvConfig& config, const support::Scene& scene, std::vector<std::string>* notes,
                        const Ranks& ranks) {
  Grid<D> grid = build_grid<D>(config, scene);
  using Correction = LevelSetOptions::VolumeCorrection;
  if (config.level_set.volume_correction == Correction::local && !grid.overset.links.empty())
    throw ConfigError(
        "level_set.volume_correction: local: not on overlapping grids, where water that two of them hold is "
        "no body of its own; use none");
  check_apart<D>(grid.blocks);
  std::vector<std::string> told = grid.notes;
  for (std::string& gap : check_covered<D>(grid.blocks, scene)) told.push_back("warning: " + std::move(gap));
  OwnPart<D> own = own_part<D>(std::move(grid), config, ranks, told);
  if (notes != nullptr) *notes = std::move(told);
  Equations<D> equations;
  equations.fluid = fluid_of<D>(scene);
  equations.limiter = config.limiter;
  equations.flux = config.flux;
  const double velocity = velocity_scale(config, scene);
  equations.speeds.c0 = config.dual_time.pseudo_sound_speed.value_or(velocity);
  equations.speeds.kappa = config.dual_time.kappa;

  InnerTolerance tolerance;
  tolerance.drop = config.dual_time.drop;
  tolerance.floor = config.dual_time.floor.value_or(1e-9 * velocity);
  tolerance.max_cycles = config.dual_time.max_cycles;
  Stepper<D> stepper(std::move(own.blocks), std::move(own.exchange), equations,
                     step_solver_of<D>(config, scene), tolerance);
  stepper.initialise(initial_flow<D>(scene), 0.0);
  const bool crosses = support::level_set_crosses(scene);
  if (scene.has_free_surface() && (!scene.has_region() || crosses)) {
    const Prescribed surface = prescribed(*scene.initial.surface, "initial.surface");
    const bool air = ranks.any(meets_air<D>(stepper.blocks(), surface));
    if (air) stepper.set_surface(surface, config.level_set);
    if (!air && crosses)
      throw ConfigError(
          "the free surface passes through the SPH region's open faces, or the region overlaps the grid, but "
          "the grid ends under water: let it reach into the air");
  }
  set_sources<D>(config, scene, stepper);
  if (!config.sponges.empty()) stepper.set_sponges(sponges_of<D>(config));
  return stepper;
}

template Grid<2> build_grid<2>(const FvConfig&, const support::Scene&);
template Grid<3> build_grid<3>(const FvConfig&, const support::Scene&);
template Stepper<2> make_stepper<2>(const FvConfig&, const support::Scene&, std::vector<std::string>*,
                                    const Ranks&);
template Stepper<3> make_stepper<3>(const FvConfig&, const support::Scene&, std::vector<std::string>*,
                                    const Ranks&);

}  // namespace littoral::fv
