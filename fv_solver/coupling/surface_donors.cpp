#include "coupling/surface_donors.hpp"

#include <algorithm>

#include "grid/loops.hpp"

namespace littoral::fv {
namespace {

constexpr int k_around = 2;  // cells to each side among which water is looked for

/// Slope of p - p0 against phi in the water around a cell [Pa/m]; 0 where there is none.
template <int D>
double slope_in_water(const Block<D>& block, const State<D>& q, const Field& phi, const Field& usable,
                      double p0, const std::array<int, D>& index) {
  std::array<int, D> lower, upper;
  for (std::size_t d = 0; d < D; ++d) {
    lower[d] = index[d] - k_around;
    upper[d] = index[d] + k_around + 1;
  }
  double product = 0.0, square = 0.0;
  for_each_index<D>(lower, upper, [&](const std::array<int, D>& other) {
    const auto c = static_cast<std::size_t>(block.extent.at(other));
    if (!(phi[c] < 0.0) || usable[c] == 0.0) return;
    product += phi[c] * (q.p[c] - p0);
    square += phi[c] * phi[c];
  });
  return square > 0.0 ? product / square : 0.0;
}

}  // namespace

template <int D>
std::vector<State<D>> continue_into_air(const Stepper<D>& stepper, const std::vector<Field>& usable) {
  static_assert(k_around <= k_ghost, "the cells around an inner cell are there");
  const FreeSurface<D>& surface = *stepper.surface();
  const double p0 = stepper.equations().fluid.reference_pressure;
  std::vector<State<D>> q = stepper.state();
  for (std::size_t b = 0; b < q.size(); ++b) {
    const Block<D>& block = stepper.blocks()[b];
    const Field& phi = surface.phi()[b];
    for_each_index<D>({}, block.extent.n, [&](const std::array<int, D>& index) {
      const auto c = static_cast<std::size_t>(block.extent.at(index));
      if (phi[c] < 0.0 || phi[c] > (k_around + 1) * longest_edge(block, c)) return;
      q[b].p[c] = p0 + phi[c] * slope_in_water<D>(block, stepper.state()[b], phi, usable[b], p0, index);
    });
  }
  stepper.exchange().states(stepper.blocks(), q);
  return q;
}

template std::vector<State<2>> continue_into_air(const Stepper<2>&, const std::vector<Field>&);
template std::vector<State<3>> continue_into_air(const Stepper<3>&, const std::vector<Field>&);

}  // namespace littoral::fv
