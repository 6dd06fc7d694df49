#pragma once

#include "littoral/support/fidelity.hpp"
#include "physics/riemann.hpp"

namespace littoral::sph {

using support::Fidelity;  // what it sets here: the table of tests/validation/sph_choices

/// Kernel radius in spacings.
constexpr double default_kernel_radius(Fidelity fidelity, int dimension) {
  if (dimension == 3) return 2.7;
  return fidelity == Fidelity::draft ? 3.0 : 4.0;
}

constexpr RiemannSolver default_riemann(Fidelity fidelity) {
  return fidelity == Fidelity::reference ? RiemannSolver::low_dissipation : RiemannSolver::linearised;
}

}  // namespace littoral::sph
