#pragma once

#include <vector>

#include "boundary/exchange.hpp"
#include "level_set/band.hpp"
#include "physics/equations.hpp"

namespace littoral::fv {

/// How far the pressure that a run starts with is from that of water at rest under its mean level:
/// sqrt(sum V (p - p_h)^2 / sum V (p_h - p0)^2), p_h = p0 + max(0, P(x) - mean of P on the surface of the
/// cell's body of water). 1: the scene gives none. Nothing to compare without gravity or surface: 0.
/// Where the sound speed is infinite that pressure is no state, only the first guess of the first step's
/// inner iteration, and its tolerance is relative to how bad the guess is. Surfaces that lie at cells'
/// centres then move by what is left, cells turn to water and back with it, and with the last air cell goes
/// what holds the pressure: a tank filled to half a cell under its lid flowed at .4 m/s. So a guess further
/// off than k_far is replaced by p_h.
struct StartPressure {
  static constexpr double k_far = 0.5;
  double misfit = 0.0;    // as given
  bool replaced = false;  // by p_h
};

/// in/out q: p. comm collective, the same on all ranks
template <int D>
StartPressure settle_start_pressure(const std::vector<Block<D>>& blocks, const Exchange<D>& exchange,
                                    const Fluid<D>& fluid, const Band<D>& band, const std::vector<Field>& phi,
                                    std::vector<State<D>>& q);

}  // namespace littoral::fv
