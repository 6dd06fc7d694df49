#include "dual_time/plain.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "boundary/boundary_flux.hpp"
#include "boundary/closed_body.hpp"
#include "grid/loops.hpp"
#include "littoral/error.hpp"

namespace littoral::fv {
namespace {

/// body(first offset, cells) for each row of inner cells.
template <int D, class Body>
void for_each_row(const Block<D>& block, Body&& body) {
  std::array<int, D> lower{}, upper = block.extent.n;
  upper[0] = 1;
  for_each_index<D>(lower, upper, [&](const std::array<int, D>& index) {
    body(static_cast<std::size_t>(block.extent.at(index)), static_cast<std::size_t>(block.extent.n[0]));
  });
}

/// The level of p in a closed body with c infinite is free; local steps let it drift. It stays where it was.
/// comm collective
template <int D>
void keep_level(const StepProblem<D>& problem, const std::vector<State<D>>& before,
                std::vector<State<D>>& q) {
  std::array<double, 2> sum{};  // of V (p - p before), of V
  for (std::size_t b = 0; b < q.size(); ++b) {
    const Block<D>& block = problem.blocks[b];
    for_each_row(block, [&](std::size_t first, std::size_t n) {
      for (std::size_t c = first; c < first + n; ++c) {
        const double v = block.solved[c] * block.volume[c];
        sum[0] += v * (q[b].p[c] - before[b].p[c]);
        sum[1] += v;
      }
    });
  }
  problem.exchange.ranks().sum(sum);
  if (sum[1] <= 0.0) return;
  for (std::size_t b = 0; b < q.size(); ++b)
    for (std::size_t c = 0; c < q[b].p.size(); ++c)
      if (problem.blocks[b].solved[c] != 0.0) q[b].p[c] -= sum[0] / sum[1];
}

}  // namespace

template <int D>
void PlainDualTime<D>::set_pseudo_steps(const StepProblem<D>& problem, const std::vector<State<D>>& q) {
  const Equations<D>& e = problem.equations;
  const MassSpeed speed = e.speeds.mass(problem.time.dt, e.fluid.viscosity);
  pseudo_step_.resize(problem.blocks.size());
  beta_.resize(problem.blocks.size());
  for (std::size_t b = 0; b < problem.blocks.size(); ++b) {
    const Block<D>& block = problem.blocks[b];
    pseudo_step_[b].assign(block.extent.size, 0.0);
    beta_[b].assign(block.extent.size, 0.0);
    for_each_row(block, [&](std::size_t first, std::size_t n) {
      for (std::size_t c = first; c < first + n; ++c) {
        const double v = block.volume[c];
        double convection = 0.0, measures = 0.0, friction = 0.0, widest = 0.0;
        for (std::size_t d = 0; d < D; ++d) {
          double s2 = 0.0, flow = 0.0;
          for (std::size_t k = 0; k < D; ++k) {
            const std::size_t up = c + static_cast<std::size_t>(block.extent.stride[d]);
            const double a = 0.5 * (block.area[d][k][c] + block.area[d][k][up]);
            s2 += a * a;
            flow += a * q[b].u[k][c];
          }
          convection += std::abs(flow);
          measures += std::sqrt(s2);
          friction += 4.0 * e.fluid.viscosity * s2 / v;
          widest = std::max(widest, std::sqrt(s2));
        }
        // the thinnest side decides: a larger beta would make the dissipation across it unstable
        const double c_p = 1.0 / speed.inverse(v / widest);
        beta_[b][c] = c_p * c_p;
        pseudo_step_[b][c] = pseudo_cfl_ * v / (convection + c_p * measures + friction);
      }
    });
    // a far field answers p with a flow of S p/(2 rho0 c): slower than c_p, it is stiffer
    for (const Window<D>& w : block.windows) {
      if (w.condition != Condition::far_field) continue;
      double c = std::numeric_limits<double>::max();
      for (std::size_t given = 0; given < w.given_p[0].size(); ++given)
        c = std::min(c, far_field_speed(w, given, e.speeds));
      std::array<int, D> lower = w.lower, upper = w.upper;
      const auto d = static_cast<std::size_t>(w.direction);
      lower[d] = w.side == 0 ? 0 : block.extent.n[d] - 1;
      upper[d] = lower[d] + 1;
      for_each_index<D>(lower, upper, [&](const std::array<int, D>& index) {
        double& beta = beta_[b][static_cast<std::size_t>(block.extent.at(index))];
        beta = std::min(beta, std::sqrt(beta) * c);
      });
    }
  }
}

template <int D>
StepReport PlainDualTime<D>::solve(const StepProblem<D>& problem, const InnerTolerance& tolerance,
                                   std::vector<State<D>>& q) {
  // Martinelli & Jameson 1988: five stages for upwind-biased schemes
  static constexpr double k_stages[] = {0.25, 1.0 / 6.0, 0.375, 0.5, 1.0};
  const double rho0 = problem.equations.fluid.density, inverse_c2 = problem.equations.fluid.inverse_c2;
  StepReport report;
  set_pseudo_steps(problem, q);
  const bool free_level = inverse_c2 == 0.0 && problem.surface == nullptr &&
                          !problem.exchange.ranks().any(!closed_body<D>(problem.blocks));
  const std::vector<State<D>> before = free_level ? q : std::vector<State<D>>{};
  problem.evaluate(q, residual_);
  report.norms.push_back(problem.norm(residual_));
  while (report.cycles < tolerance.max_cycles && std::isfinite(report.norms.back()) &&
         !tolerance.met(report.norms.back(), report.norms.front())) {
    start_ = q;
    for (const double stage : k_stages) {
      for (std::size_t b = 0; b < problem.blocks.size(); ++b) {
        const Block<D>& block = problem.blocks[b];
        const Forcing<D>& forcing = problem.forcing[b];
        for_each_row(block, [&](std::size_t first, std::size_t n) {
          for (std::size_t c = first; c < first + n; ++c) {
            const double step = stage * pseudo_step_[b][c];
            const double forced = forcing.active() ? forcing.rate[c] : 0.0;
            const double of_p = forcing.pressure_rate.empty() ? 0.0 : forcing.pressure_rate[c];
            const double a_p = beta_[b][c] * (problem.time.a0 * inverse_c2 + of_p * forcing.psi);
            const double a_u = problem.time.a0 + forced;
            const double per_volume = step * block.solved[c] / block.volume[c];
            double& p = q[b].p[c];
            p = (start_[b].p[c] + step * a_p * p - per_volume * beta_[b][c] * residual_[b].mass[c]) /
                (1.0 + step * a_p);
            for (std::size_t k = 0; k < D; ++k) {
              double& u = q[b].u[k][c];
              u = (start_[b].u[k][c] + step * a_u * u - per_volume / rho0 * residual_[b].momentum[k][c]) /
                  (1.0 + step * a_u);
            }
          }
        });
      }
      problem.evaluate(q, residual_);
    }
    ++report.cycles;
    report.norms.push_back(problem.norm(residual_));
  }
  if (!std::isfinite(report.norms.back()))
    throw StabilityError("the residual is not finite after " + std::to_string(report.cycles) +
                         " pseudo-time steps");
  report.converged = tolerance.met(report.norms.back(), report.norms.front());
  if (free_level) keep_level(problem, before, q);
  return report;
}

template class PlainDualTime<2>;
template class PlainDualTime<3>;

}  // namespace littoral::fv
