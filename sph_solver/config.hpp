#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bodies/walls.hpp"
#include "boundary/domain_box.hpp"
#include "coupling/coupling_config.hpp"
#include "fidelity.hpp"
#include "littoral/support/config.hpp"
#include "littoral/support/scene.hpp"
#include "physics/numerics.hpp"

namespace littoral::sph {

/// A place where the flow is recorded each window.
struct GaugeConfig {
  enum class Kind { point, elevation, pressure_disc, force_disc };
  bool is_disc() const { return kind == Kind::pressure_disc || kind == Kind::force_disc; }
  std::string name;
  Kind kind = Kind::point;
  std::array<double, 3> position = {0, 0, 0};  // [m] elevation: z is ignored
  std::array<double, 3> normal = {1, 0, 0};    // of discs
  double diameter = 0.0;                       // [m] of discs
  double dry_pressure = 0.0;                   // [Pa] what a dry place shows: the scene's reference pressure
};

/// Content of sph.yaml.
struct Config {
  std::string scene = "scene.yaml";
  double spacing = 0.0;  // dx [m]
  enum class InitialDistribution { lattice, relaxed } initial_distribution = InitialDistribution::lattice;
  Fidelity fidelity = Fidelity::standard;
  std::optional<double> kernel_radius;  // [dx]; absent: that of the fidelity
  Reconstruction reconstruction = Reconstruction::unlimited;
  WallStates wall_states = WallStates::linear;
  RiemannSolver riemann = RiemannSolver::linearised;
  Tension tension = Tension::plain;
  Precision precision = Precision::all_double;
  bool shifting = true;
  Integrator integrator = Integrator::rk4;
  std::optional<double> cfl;          // absent: that of the integrator
  std::optional<double> viscous_cfl;  // absent: that of the integrator
  double force_cfl = 0.25;
  double skin = 0.4;  // [dx]
  double load_drift = 1.1;
  std::vector<std::string> fields = {"velocity", "pressure"};
  std::vector<GaugeConfig> gauges;
  CouplingConfig coupling;

  void bind(support::Binder& b);
};

/// Both files of a run.
struct RunConfig {
  support::Scene scene;
  Config sph;
};

/// Reads sph.yaml and the scene it names. throws ConfigError with all problems
RunConfig read_config(const std::string& path, const std::vector<std::string>& settings,
                      const std::vector<std::string>& scene_settings);
std::string resolved_text(RunConfig config);  ///< YAML of both, every key
std::string help_text();                      ///< every key of sph.yaml and scene.yaml

template <int D>
Numerics<D> numerics_of(const RunConfig& config);
/// throws ConfigError: a periodic or mirrored length that is no multiple of the spacing, or shorter than the
/// kernel radius
template <int D>
DomainBox<D> domain_of(const RunConfig& config);
/// The scene's bodies filled with dummies on the lattice of the particles, which begins at `origin`; null
/// without bodies. throws ConfigError, IoError
template <int D>
std::unique_ptr<Walls<D>> walls_of(const RunConfig& config, const std::array<double, D>& origin);

}  // namespace littoral::sph
