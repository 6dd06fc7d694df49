#include "physics/measures.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "grid/loops.hpp"
#include "grid/space.hpp"

namespace littoral::fv {

template <int D>
Field outside_share(const Block<D>& block, const std::vector<coupler::Box>& regions, const Field* wet) {
  Field share(block.extent.size, 0.0);
  for_each_index<D>({}, block.extent.n, [&](const std::array<int, D>& index) {
    const auto c = static_cast<std::size_t>(block.extent.at(index));
    share[c] = counted_share(block, c) * (wet != nullptr ? (*wet)[c] : 1.0);
  });
  if (regions.empty()) return share;
  for_each_index<D>({}, block.extent.n, [&](const std::array<int, D>& index) {
    const auto c = static_cast<std::size_t>(block.extent.at(index));
    std::array<double, D> low, high;
    low.fill(std::numeric_limits<double>::infinity());
    high.fill(-std::numeric_limits<double>::infinity());
    const std::ptrdiff_t n = block.node_extent.at(index);
    for (std::size_t corner = 0; corner < (1u << D); ++corner) {
      std::ptrdiff_t m = n;
      for (std::size_t d = 0; d < D; ++d) m += (corner >> d) & 1 ? block.node_extent.stride[d] : 0;
      for (std::size_t k = 0; k < D; ++k) {
        low[k] = std::min(low[k], block.node[k][static_cast<std::size_t>(m)]);
        high[k] = std::max(high[k], block.node[k][static_cast<std::size_t>(m)]);
      }
    }
    double inside = 0.0;
    for (const coupler::Box& box : regions) {
      double part = 1.0;
      for (std::size_t k = 0; k < D; ++k) {
        const std::size_t a = axis_in_space<D>(k);
        const double overlap = std::min(high[k], box.upper[a]) - std::max(low[k], box.lower[a]);
        part *= std::max(0.0, overlap) / (high[k] - low[k]);
      }
      inside += part;
    }
    share[c] *= std::max(0.0, 1.0 - inside);
  });
  return share;
}

namespace {

/// Height of the water's centre over the cell's against gravity, times g: the cell cut by the plane of phi,
/// as if it were upright.
template <int D>
double lift(const Block<D>& block, const Fluid<D>& fluid, const Field& phi, std::size_t c, double share) {
  std::array<double, D> slope{};  // V grad phi
  double thickness = 0.0, size2 = 0.0, along = 0.0;
  for (std::size_t d = 0; d < D; ++d) {
    const auto s = static_cast<std::size_t>(block.extent.stride[d]);
    const double change = 0.5 * (phi[c + s] - phi[c - s]);
    thickness += std::abs(change);
    for (std::size_t k = 0; k < D; ++k)
      slope[k] += change * 0.5 * (block.area[d][k][c] + block.area[d][k][c + s]);
  }
  for (std::size_t k = 0; k < D; ++k) {
    size2 += slope[k] * slope[k];
    along += fluid.gravity[k] * slope[k];
  }
  return size2 > 0.0 ? 0.5 * (1.0 - share) * thickness * along / std::sqrt(size2) : 0.0;
}

}  // namespace

template <int D>
Integrals integrate(const Block<D>& block, const Fluid<D>& fluid, const State<D>& q, const Field& share,
                    const Field* phi) {
  Integrals sum;
  for_each_index<D>({}, block.extent.n, [&](const std::array<int, D>& index) {
    const auto c = static_cast<std::size_t>(block.extent.at(index));
    const double mass = fluid.rho(q.p[c]) * block.volume[c] * share[c];
    double speed2 = 0.0, height = 0.0;
    for (std::size_t k = 0; k < D; ++k) {
      speed2 += q.u[k][c] * q.u[k][c];
      height -= fluid.gravity[k] * block.centre[k][c];
    }
    if (phi != nullptr && share[c] > 0.0 && share[c] < 1.0)
      height += lift<D>(block, fluid, *phi, c, share[c]);
    sum.mass += mass;
    sum.kinetic_energy += 0.5 * mass * speed2;
    sum.potential_energy += mass * height;
  });
  return sum;
}

template <int D>
double convective_rate(const Block<D>& block, const State<D>& q, double least) {
  double fastest = 0.0;
  for_each_index<D>({}, block.extent.n, [&](const std::array<int, D>& index) {
    const auto c = static_cast<std::size_t>(block.extent.at(index));
    if (block.solved[c] == 0.0) return;
    double rate = 0.0;
    for (std::size_t d = 0; d < D; ++d) {
      double flow = 0.0, s2 = 0.0;
      for (std::size_t k = 0; k < D; ++k) {
        const std::size_t up = c + static_cast<std::size_t>(block.extent.stride[d]);
        const double a = 0.5 * (block.area[d][k][c] + block.area[d][k][up]);
        flow += a * q.u[k][c];
        s2 += a * a;
      }
      rate += std::max(std::abs(flow), least * std::sqrt(s2));
    }
    fastest = std::max(fastest, rate / block.volume[c]);
  });
  return fastest;
}

template Field outside_share<2>(const Block<2>&, const std::vector<coupler::Box>&, const Field*);
template Field outside_share<3>(const Block<3>&, const std::vector<coupler::Box>&, const Field*);
template Integrals integrate<2>(const Block<2>&, const Fluid<2>&, const State<2>&, const Field&,
                                const Field*);
template Integrals integrate<3>(const Block<3>&, const Fluid<3>&, const State<3>&, const Field&,
                                const Field*);
template double convective_rate<2>(const Block<2>&, const State<2>&, double);
template double convective_rate<3>(const Block<3>&, const State<3>&, double);

}  // namespace littoral::fv
