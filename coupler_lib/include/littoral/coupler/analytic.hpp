#pragma once

#include <mpi.h>

#include <functional>
#include <memory>

#include "littoral/coupler/partner.hpp"

namespace littoral::coupler {

/// Exact state at a point and time.
struct FlowState {
  double p = 0.0;
  Vec3 u{};
  double phi = -1.0e30;
};
using Flow = std::function<FlowState(const Vec3& x, double t)>;

// Flows by formula; 2-D ones lie in the plane (x, z).
Flow uniform_stream(const Vec3& velocity, double pressure);
/// p = p0 - rho0 g (z - level), with g > 0 pointing down.
Flow hydrostatic(double density, double gravity, double level, double reference_pressure);
/// Decaying array of vortices of wavelength L and speed U, advected by `stream`.
Flow taylor_vortex(double density, double speed, double wavelength, double viscosity, const Vec3& stream);
/// Inviscid standing wave on depth H to first order, eta = a cos(kx) sin(wt) (flat at t = 0).
Flow standing_wave(double density, double gravity, double depth, double wavenumber, double amplitude);

/// A grid that knows the flow: donors on a uniform lattice of centres of spacing h, targets in the two
/// outermost layers of that lattice inside what each rank covers. Derivatives: where the schedule
/// interpolates towards t^n+1 the secant, else those at t^n. Lets sph_solver run its whole coupling path in
/// one process or, given its communicator, in several.
std::unique_ptr<FvPartner> analytic_fv_partner(const Flow& flow, const RunPlan& plan, double spacing,
                                               int dimension, MPI_Comm program = MPI_COMM_SELF);
/// Particles that know the flow: samples are exact; dry where phi > 0.
std::unique_ptr<SphPartner> analytic_sph_partner(const Flow& flow, const RunPlan& plan,
                                                 MPI_Comm program = MPI_COMM_SELF);

}  // namespace littoral::coupler
