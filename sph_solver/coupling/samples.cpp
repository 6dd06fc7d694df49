#include "coupling/samples.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "neighbors/cell_grid.hpp"
#include "physics/kernel.hpp"

namespace littoral::sph {

namespace {

/// Less than the corner of a body of water has [-].
constexpr double k_least_coverage = 0.25;

/// Less of a kernel than the inner corner of a tank leaves free [-]: a point within a body.
constexpr double k_least_free = 0.1;

/// A support of less than this [-] is cut by a surface or a face: a parabola through one side of it swings.
constexpr double k_whole_support = 0.9;

/// Polynomials of a fit: 1, those of first order, those of second.
template <int D, int order>
constexpr std::size_t k_basis = order == 1 ? 1 + D : 1 + D + D*(D + 1) / 2;

template <std::size_t n>
using Moments = std::array<std::array<double, n>, n>;

/// Of a place at d from the target, in kernel radii.
template <int D, int order>
std::array<double, k_basis<D, order>> basis_at(const Point<D>& d) {
  std::array<double, k_basis<D, order>> b{1.0};
  for (std::size_t a = 0; a < D; ++a) b[a + 1] = d[a];
  if constexpr (order == 2) {
    std::size_t next = D + 1;
    for (std::size_t a = 0; a < D; ++a)
      for (std::size_t e = a; e < D; ++e) b[next++] = d[a] * d[e];
  }
  return b;
}

/// Solves A c = (1, 0, ...) by Cholesky; false where A is singular to working use: a pivot that has lost all
/// but 1e-8 of its diagonal comes from points on a line (in 3-D: a plane).
template <std::size_t n>
bool first_column_of_inverse(Moments<n> A, std::array<double, n>& c) {
  for (std::size_t j = 0; j < n; ++j) {
    const double diagonal = A[j][j];
    for (std::size_t k = 0; k < j; ++k) A[j][j] -= A[j][k] * A[j][k];
    if (!(A[j][j] > 1e-8 * diagonal) || diagonal <= 0.0) return false;
    A[j][j] = std::sqrt(A[j][j]);
    for (std::size_t i = j + 1; i < n; ++i) {
      for (std::size_t k = 0; k < j; ++k) A[i][j] -= A[i][k] * A[j][k];
      A[i][j] /= A[j][j];
    }
  }
  for (std::size_t i = 0; i < n; ++i) {
    c[i] = i == 0 ? 1.0 : 0.0;
    for (std::size_t k = 0; k < i; ++k) c[i] -= A[i][k] * c[k];
    c[i] /= A[i][i];
  }
  for (std::size_t i = n; i-- > 0;) {
    for (std::size_t k = i + 1; k < n; ++k) c[i] -= A[k][i] * c[k];
    c[i] /= A[i][i];
  }
  return true;
}

template <int D>
struct Weighted {
  std::size_t j;
  double weight;  // V_j W_j
  Point<D> d;     // from the target, in kernel radii
};

/// Turns the weights V W of the particles near a target into those of the fit's value there; false, and
/// nothing done, where it cannot be fitted.
template <int D, int order>
bool fit(std::vector<Weighted<D>>& near) {
  constexpr std::size_t n = k_basis<D, order>;
  Moments<n> A{};
  for (const Weighted<D>& one : near) {
    const auto b = basis_at<D, order>(one.d);
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < n; ++j) A[i][j] += one.weight * b[i] * b[j];
  }
  std::array<double, n> c{};
  if (!first_column_of_inverse<n>(A, c)) return false;
  for (Weighted<D>& one : near) {
    const auto b = basis_at<D, order>(one.d);
    double factor = 0.0;
    for (std::size_t i = 0; i < n; ++i) factor += c[i] * b[i];
    one.weight *= factor;
  }
  return true;
}

}  // namespace

template <int D>
void sample_states(const Particles<D>& particles, const Layers<D>& layers, const SampleRules& rules,
                   const coupler::Targets& targets, coupler::Samples& samples, const Walls<D>* walls,
                   const Ghosts<D>* ghosts) {
  const Kernel<D> kernel(rules.kernel_radius);
  const bool corrected = rules.method != SampleMethod::shepard;
  std::vector<double> p_beyond(particles.p.begin(),
                               particles.p.begin() + static_cast<std::ptrdiff_t>(particles.size()));
  const auto weight_at = [&](const Point<D>& place) {
    double p = 0.0;
    for (std::size_t d = 0; d < D; ++d) p += rules.weight[space_axis<D>(d)] * place[d];
    return corrected ? p : 0.0;
  };
  for (std::size_t j = 0; j < particles.size(); ++j) p_beyond[j] -= weight_at(at<D>(particles.x, j));
  if (ghosts != nullptr) ghosts->refresh_scalar(p_beyond, particles.n_owned);
  std::array<std::vector<double>, D> x;
  std::vector<std::size_t> source;
  std::vector<std::int64_t> id;
  for (std::size_t j = 0; j < particles.size(); ++j) {
    const Point<D> position = at<D>(particles.x, j);
    if (layers.zone(layers.excess(position)) == Zone::driven) continue;
    for (std::size_t d = 0; d < D; ++d) x[d].push_back(position[d]);
    source.push_back(j);
    id.push_back(particles.id[j]);
  }
  CellGrid<D> grid;
  if (!source.empty()) {
    grid.bin(x, source.size(), rules.kernel_radius);
    grid.sort_cells(x, id);  // sums in an order that does not depend on the number of ranks
  }

  std::array<double*, 3> velocity = {samples.u.data(), samples.v.data(), samples.w.data()};
  const auto n = static_cast<std::ptrdiff_t>(targets.size());
#pragma omp parallel
  {
    std::vector<Weighted<D>> near;
#pragma omp for schedule(static)
    for (std::ptrdiff_t k = 0; k < n; ++k) {
      const auto t = static_cast<std::size_t>(k);
      const Point<D> target = from_vec3<D>({targets.x[t], targets.y[t], targets.z[t]});
      samples.p[t] = samples.u[t] = samples.v[t] = samples.w[t] = samples.coverage[t] = 0.0;
      samples.status[t] = coupler::SampleStatus::uncovered;
      if (layers.excess(target) > layers.blending_width()) continue;

      near.clear();
      double coverage = 0.0;
      const auto add = [&](std::size_t begin, std::size_t end) {
        for (std::size_t q = begin; q < end; ++q) {
          const auto s = static_cast<std::size_t>(grid.order()[q]);
          Point<D> apart{};
          double r2 = 0.0;
          for (std::size_t d = 0; d < D; ++d) {
            apart[d] = (x[d][s] - target[d]) * kernel.inv_R;
            r2 += apart[d] * apart[d];
          }
          if (r2 >= 1.0) continue;
          if (walls != nullptr && walls->between(target, at<D>(x, s))) continue;
          const double weight = particles.V[source[s]] * kernel.value(std::sqrt(r2) * kernel.R);
          near.push_back({s, weight, apart});
          coverage += weight;
        }
      };
      if (!source.empty()) grid.for_each_range(target, kernel.R, add);
      const double whole = coverage;  // of the kernel, walls or not
      if (walls != nullptr) coverage /= std::max(k_least_free, 1.0 - walls->coverage(target));
      samples.coverage[t] = coverage;
      if (coverage < k_least_coverage) {
        if (rules.free_surface) samples.status[t] = coupler::SampleStatus::dry;
        continue;
      }
      const bool parabolic = rules.method == SampleMethod::quadratic && whole > k_whole_support;
      if (!(parabolic && fit<D, 2>(near)) && !(corrected && fit<D, 1>(near)))
        for (Weighted<D>& one : near) one.weight /= whole;
      double p = 0.0;
      Point<D> u{};
      for (const Weighted<D>& neighbor : near) {
        const std::size_t j = source[neighbor.j];
        p += neighbor.weight * p_beyond[j];
        for (std::size_t d = 0; d < D; ++d) u[d] += neighbor.weight * particles.u[d][j];
      }
      samples.p[t] = p + weight_at(target);
      for (std::size_t d = 0; d < D; ++d) velocity[space_axis<D>(d)][t] = u[d];
      samples.status[t] = coupler::SampleStatus::ok;
    }
  }
}

template void sample_states<2>(const Particles<2>&, const Layers<2>&, const SampleRules&,
                               const coupler::Targets&, coupler::Samples&, const Walls<2>*, const Ghosts<2>*);
template void sample_states<3>(const Particles<3>&, const Layers<3>&, const SampleRules&,
                               const coupler::Targets&, coupler::Samples&, const Walls<3>*, const Ghosts<3>*);

}  // namespace littoral::sph
