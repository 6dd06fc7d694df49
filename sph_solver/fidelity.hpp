#pragma once

#include <cstdint>

#include "physics/riemann.hpp"

namespace littoral::sph {

/// A scheme by one word, chosen from the table of tests/validation/sph_choices. What it sets are defaults: a
/// key given in sph.yaml goes before it.
enum class Fidelity : std::uint8_t { draft, standard, reference };

/// Kernel radius in spacings.
constexpr double default_kernel_radius(Fidelity fidelity, int dimension) {
  if (dimension == 3) return 2.7;
  return fidelity == Fidelity::draft ? 3.0 : 4.0;
}

constexpr RiemannSolver default_riemann(Fidelity fidelity) {
  return fidelity == Fidelity::reference ? RiemannSolver::low_dissipation : RiemannSolver::linearised;
}

}  // namespace littoral::sph
