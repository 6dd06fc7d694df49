#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "littoral/coupler/contract.hpp"
#include "littoral/coupler/types.hpp"
#include "littoral/coupler/window.hpp"
#include "littoral/support/body.hpp"
#include "littoral/support/config.hpp"
#include "littoral/support/fidelity.hpp"
#include "littoral/support/formula.hpp"

namespace littoral::support {

/// What both solvers must agree on: the content of scene.yaml. Vectors always have three components (x, y,
/// z); in 2-D the plane is (x, z) and y is ignored.
struct Scene {
  std::string title = "untitled";
  int dimension = 2;
  Fidelity fidelity = Fidelity::standard;  // default of both programs' own

  struct Fluid {
    double density = 1000.0;          // rho0 [kg/m^3]
    double sound_speed = 0.0;         // c [m/s]; infinite (".inf") makes FV incompressible
    double reference_pressure = 0.0;  // p0 [Pa], on the free surface
    double viscosity = 0.0;           // nu [m^2/s], kinematic; 0: no viscous term
  } fluid;
  coupler::Vec3 gravity = {0.0, 0.0, 0.0};  // [m/s^2]

  /// What closes the flow at the domain's faces, per direction: both solvers apply it where they reach the
  /// face.
  enum class Side { open, periodic, symmetry };
  struct Domain {
    coupler::Vec3 lower = {0, 0, 0};             // [m]
    coupler::Vec3 upper = {0, 0, 0};             // [m]
    std::array<std::array<Side, 2>, 3> sides{};  // [direction][lower, upper]
  } domain;

  std::map<std::string, double> constants;  // usable in every formula of the scene

  /// State at t = 0; formulas of x, y, z, t. surface < 0 in water (only its sign and zero level matter at
  /// start); absent: water everywhere (no free surface).
  struct Initial {
    Formula u, v, w;  // [m/s]
    Formula p;        // [Pa]
    std::optional<Formula> surface;
  } initial;

  /// Exact or reference solution for the analytic partner; absent: the initial formulas (they may depend on
  /// t).
  struct Region {  // one box of the SPH region: its nominal faces, where SPH ends and FV begins
    coupler::Vec3 lower = {0, 0, 0};
    coupler::Vec3 upper = {0, 0, 0};
  };
  std::vector<Region> regions;

  std::vector<BodySpec> bodies;  // solids in the flow

  enum class CouplingKind { none, imposed, forced };  // alone; Coupling I; Coupling II
  struct Coupling {
    CouplingKind kind = CouplingKind::none;
    double blending_width = 0.0;  // [m] outward from the nominal face: SPH and FV blended, (17)
    double driven_width = 0.0;    // [m] beyond the blending layer: FV's state at the particle
    int fringe_layers = 2;        // cells imposed on FV's side
    coupler::SchedulePolicy schedule;
    coupler::WindowPolicy window;
    double deadline = 600.0;  // [s] wall time a program waits for its partner
  } coupling;

  struct Time {
    double end = 0.0;                  // [s]
    int max_windows = -1;              // stop after so many windows; -1: no limit
    double field_interval = 0.0;       // [s] 0: only first and last
    double checkpoint_interval = 0.0;  // [s] 0: none
  } time;

  double reference_velocity = 0.0;  // [m/s] U_ref of (14) and (22); 0: sound_speed / 10

  /// Acceleration besides gravity, formulas of x, y, z, t.
  struct BodyForce {
    Formula x, y, z;  // [m/s^2]
  } body_force;

  bool has_body_force() const;

  bool has_free_surface() const { return initial.surface.has_value(); }
  bool has_region() const { return coupling.kind != CouplingKind::none; }
  /// U_ref of (14) and (22) [m/s].
  double velocity_scale() const {
    return reference_velocity > 0.0 ? reference_velocity : 0.1 * fluid.sound_speed;
  }
  /// In 2-D the direction y (1) does not exist.
  bool active(std::size_t direction) const { return dimension == 3 || direction != 1; }
  /// Whether a region's face is open to the grid: not on a periodic or symmetry face of the domain, nor on an
  /// open one (nothing of the grid is beyond it). side: 0 lower, 1 upper
  bool open_face(const Region& region, std::size_t direction, std::size_t side) const;

  std::string digest;  // of the resolved scene: both sides must have read the same
  /// Of the part that a continued run must share with the one before: all but title, time and deadline.
  std::string restart_digest;

  void bind(Binder& b);
  /// The whole scene as YAML that reads back to the same values.
  static std::string help();  ///< every key of scene.yaml, with type, unit, range and default
  std::string resolved() const;
  /// Reads and checks scene.yaml; `settings` are the --set that name scene keys ("scene.fluid.density=1").
  /// throws ConfigError with all problems
  static Scene from_file(const std::string& path, const std::vector<std::string>& settings = {});
  /// What the handshake compares (design: protocol version, dimension, rho0, c, p0, nu, g, axes, sign of phi,
  /// boxes, coupling kind, schedule, window policy, digest).
  coupler::Contract contract() const;
};

}  // namespace littoral::support
