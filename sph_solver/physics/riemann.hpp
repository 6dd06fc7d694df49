#pragma once

#include <cmath>
#include <cstdint>

namespace littoral::sph {

/// How the states on the two sides of the midpoint are found from those of the particles.
enum class Reconstruction : std::uint8_t { first_order, unlimited, minmod, van_leer };

/// What a particle's Riemann problem with a wall is made of.
///   linear        one-sided: its state carried on by its gradients, to the wall and through it (S12)
///   constant      one-sided: its values (Zhang, Hu & Adams 2017); the pressure's slope is that of water
///                 at rest
///   extrapolated  two-sided: dummies with the mean pressure and the mirrored mean velocity of the water
///                 around them (Adami, Hu & Adams 2012)
enum class WallStates : std::uint8_t { linear, constant, extrapolated };

/// How strongly the face pressure answers the jump of velocity.
///   linearised       with the full impedance rho c, eq. (12)
///   low_dissipation  with min(c, 3 (u_l - u_r)) in place of c where the sides approach, with none where
///                    they part (Zhang, Hu & Adams 2017): sound is damped less than by (12), and so is
///                    everything else
enum class RiemannSolver : std::uint8_t { linearised, low_dissipation };

/// The pressure force where p is below p0: (11) as it stands, or switched (S15).
enum class Tension : std::uint8_t { plain, switched };

/// Speed that multiplies the jump of velocity in p_E; closing: u_l - u_r. Value: a number or lanes of them.
template <RiemannSolver solver, class Value, class Number>
inline auto dissipation_speed(Value closing, Number c) {
  if constexpr (solver == RiemannSolver::linearised) {
    return c;
  } else {
    constexpr auto k_strength = static_cast<Number>(3.0);  // Zhang, Hu & Adams 2017
    const Value speed = closing > 0 ? k_strength * closing : Value{};
    return speed < c ? speed : Value{} + c;
  }
}

/// Solution of the linearised Riemann problem (S5), along the line from i to j.
struct FaceState {
  double u;  // velocity along the line [m/s]
  double p;  // [Pa]
};

/// Di Mascio et al. 2021, eq. (12), after Parshikov & Medin 2002. u: velocity along the line from left to
/// right.
template <RiemannSolver solver = RiemannSolver::linearised>
inline FaceState riemann_state(double rho_l, double u_l, double p_l, double rho_r, double u_r, double p_r,
                               double c) {
  const double weight = 1.0 / (rho_l + rho_r);
  return {weight * (rho_l * u_l + rho_r * u_r + (p_l - p_r) / c),
          weight * (rho_r * p_l + rho_l * p_r +
                    dissipation_speed<solver>(u_l - u_r, c) * rho_l * rho_r * (u_l - u_r))};
}

/// Difference the reconstruction adds over the whole distance i to j, seen from one side (S4). `centred`: the
/// particle's own gradient times the distance, `across`: q_j - q_i. Limited variants compare `across` with
/// the upwind difference 2 centred - across. Value: a number or lanes of them.
template <Reconstruction variant, class Value>
inline Value limited_difference(Value centred, Value across) {
  if constexpr (variant == Reconstruction::first_order) return Value{};
  if constexpr (variant == Reconstruction::unlimited) return centred;
  const Value upwind = centred + centred - across;
  const Value product = upwind * across;
  if constexpr (variant == Reconstruction::minmod) {
    // of two of one sign the smaller in size has the smaller square
    const Value smaller = upwind * upwind < across * across ? upwind : across;
    return product > 0 ? smaller : Value{};
  }
  if constexpr (variant == Reconstruction::van_leer) {
    const Value sum =
        product > 0 ? upwind + across : Value{} + 1;  // never divides by zero in a discarded lane
    const Value harmonic = (product + product) / sum;
    return product > 0 ? harmonic : Value{};
  }
}

}  // namespace littoral::sph
