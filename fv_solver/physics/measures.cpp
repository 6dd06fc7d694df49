#include "physics/measures.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "boundary/boundary_flux.hpp"
#include "boundary/line.hpp"
#include "grid/loops.hpp"
#include "grid/space.hpp"
#include "physics/flux_rows.hpp"

namespace littoral::fv {

template <int D>
Field outside_share(const Block<D>& block, const std::vector<coupler::Box>& regions) {
  Field share = block.solved;
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

template <int D>
Integrals integrate(const Block<D>& block, const Fluid<D>& fluid, const State<D>& q, const Field& share) {
  Integrals sum;
  for_each_index<D>({}, block.extent.n, [&](const std::array<int, D>& index) {
    const auto c = static_cast<std::size_t>(block.extent.at(index));
    const double mass = fluid.rho(q.p[c]) * block.volume[c] * share[c];
    double speed2 = 0.0, height = 0.0;
    for (std::size_t k = 0; k < D; ++k) {
      speed2 += q.u[k][c] * q.u[k][c];
      height -= fluid.gravity[k] * block.centre[k][c];
    }
    sum.mass += mass;
    sum.kinetic_energy += 0.5 * mass * speed2;
    sum.potential_energy += mass * height;
  });
  return sum;
}

template <int D>
WallForce wall_force(const std::vector<Block<D>>& blocks, const Equations<D>& equations,
                     const std::vector<State<D>>& q, const std::string& wall,
                     const coupler::Vec3& moment_about) {
  WallForce force;
  const Fluid<D>& fluid = equations.fluid;
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    const Block<D>& block = blocks[b];
    for (const Window<D>& w : block.windows) {
      if (w.name != wall) continue;
      std::array<int, D> lower = w.lower, upper = w.upper;
      const auto d = static_cast<std::size_t>(w.direction);
      lower[d] = w.side == 0 ? 0 : block.extent.n[d] - 1;
      upper[d] = lower[d] + 1;
      const double outward = w.side == 0 ? -1.0 : 1.0;
      for_each_index<D>(lower, upper, [&](const std::array<int, D>& index) {
        const Line<D> line(block, w, block.extent.at(index));
        const FaceFrame<D> frame(block, w, line);
        const auto relative = [&](std::size_t c) { return q[b].p[c] - block.reference_pressure[c]; };
        const double p0 = relative(line.inner[0]), p1 = relative(line.inner[1]);
        const double p = pressure_on_face(w.condition, p0, p1, frame.d0, frame.outward_slope(p0, p1));
        std::array<double, D> x, push, weight;
        FluxRow<D> traction;
        double unused = 0.0;
        traction.mass = &unused;
        for (std::size_t k = 0; k < D; ++k) {
          x[k] = 0.5 * (block.centre[k][line.inner[0]] + block.centre[k][line.ghost[0]]);
          push[k] = 0.0;
          traction.momentum[k] = &push[k];
        }
        if (fluid.viscosity != 0.0)
          subtract_stress_row<D>(block, q[b], d, static_cast<std::ptrdiff_t>(line.face), 1,
                                 fluid.density * fluid.viscosity, traction);
        const double reference = fluid.hydrostatic(x) - fluid.reference_pressure;
        for (std::size_t k = 0; k < D; ++k) {
          const double area = outward * block.area[d][k][line.face];
          push[k] = outward * push[k] + p * area;
          weight[k] = reference * area;
        }
        const coupler::Vec3 f = vector_in_space<D>(push), h = vector_in_space<D>(weight),
                            at = vector_in_space<D>(x);
        for (std::size_t k = 0; k < 3; ++k) {
          const std::size_t l = (k + 1) % 3, m = (k + 2) % 3;
          force.dynamic[k] += f[k];
          force.hydrostatic[k] += h[k];
          force.moment[k] += (at[l] - moment_about[l]) * f[m] - (at[m] - moment_about[m]) * f[l];
        }
      });
    }
  }
  return force;
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

template Field outside_share<2>(const Block<2>&, const std::vector<coupler::Box>&);
template Field outside_share<3>(const Block<3>&, const std::vector<coupler::Box>&);
template Integrals integrate<2>(const Block<2>&, const Fluid<2>&, const State<2>&, const Field&);
template Integrals integrate<3>(const Block<3>&, const Fluid<3>&, const State<3>&, const Field&);
template WallForce wall_force<2>(const std::vector<Block<2>>&, const Equations<2>&,
                                 const std::vector<State<2>>&, const std::string&, const coupler::Vec3&);
template WallForce wall_force<3>(const std::vector<Block<3>>&, const Equations<3>&,
                                 const std::vector<State<3>>&, const std::string&, const coupler::Vec3&);
template double convective_rate<2>(const Block<2>&, const State<2>&, double);
template double convective_rate<3>(const Block<3>&, const State<3>&, double);

}  // namespace littoral::fv
