#include "physics/surface.hpp"

#include <cmath>

#include "pairs/pair_columns.hpp"
#include "physics/kernel.hpp"
#include "physics/symmetric_matrix.hpp"

namespace littoral::sph {
namespace {

/// What the neighbours of a particle make up: B, and their crowding sum_j V_j grad W_ij.
template <int D>
struct Support {
  SymmetricMatrix<D> B;
  std::array<double, D> crowding;
};

template <int D>
Support<D> support(const Particles<D>& particles, const Kernel<D>& kernel, std::size_t i,
                   const std::int32_t* list, std::size_t count) {
  using Vector = Lanes<double>;
  constexpr std::size_t k_entries = D * (D + 1) / 2;
  Vector B[k_entries] = {}, crowding[D] = {};
  for_each_group<double>(list, count, i, [&](const std::int32_t* j) {
    Vector x[D];
    const Vector r = distances(particles, i, j, x);
    const Vector q = largest(1.0 - r * kernel.inv_R, Vector{});
    const Vector f = gather(particles.V.data(), j) * (q * q * q);
    std::size_t next = 0;
    for (std::size_t a = 0; a < D; ++a) {
      const Vector fx = f * x[a];
      crowding[a] += fx;
      for (std::size_t b = a; b < D; ++b) B[next++] += fx * x[b];
    }
  });
  Support<D> total;
  for (std::size_t a = 0; a < k_entries; ++a) total.B.a[a] = -kernel.slope * sum(B[a]);
  for (std::size_t d = 0; d < D; ++d) total.crowding[d] = -kernel.slope * sum(crowding[d]);
  return total;
}

template <int D>
std::array<double, D> separation(const Particles<D>& particles, std::size_t i, std::size_t j) {
  std::array<double, D> x;
  for (std::size_t d = 0; d < D; ++d) x[d] = particles.x[d][j] - particles.x[d][i];
  return x;
}

template <int D>
double dot(const std::array<double, D>& a, const std::array<double, D>& b) {
  double sum = 0.0;
  for (std::size_t d = 0; d < D; ++d) sum += a[d] * b[d];
  return sum;
}

template <int D>
std::array<double, D> unit(std::array<double, D> v, double least) {
  const double length = std::sqrt(dot<D>(v, v));
  for (double& component : v) component = length > least ? component / length : 0.0;
  return v;
}

/// The two guesses of the outward normal; zero where a guess has no direction.
template <int D>
struct Normals {
  std::array<double, D> from_lambda;   // - grad lambda, renormalised
  std::array<double, D> from_support;  // towards where the kernel's support is empty
};

template <int D>
Normals<D> outward_normals(const Particles<D>& particles, const Kernel<D>& kernel,
                           const std::vector<double>& lambda, const SymmetricMatrix<D>& B,
                           const std::array<double, D>& crowded, std::size_t i, const std::int32_t* list,
                           std::size_t count) {
  constexpr double k_least_gradient = 0.02;    // over R: a plane surface has about 1
  constexpr double k_least_eigenvalue = 0.05;  // of B, below which its inverse only amplifies noise
  std::array<double, D> decrease{}, emptiness{};
  for (std::size_t d = 0; d < D; ++d) emptiness[d] = -crowded[d];  // by walls: no void
  for (std::size_t k = 0; k < count; ++k) {
    const auto j = static_cast<std::size_t>(list[k]);
    const auto x = separation(particles, i, j);
    const double f = -particles.V[j] * kernel.slope_over_r(std::sqrt(dot<D>(x, x)));  // V grad W = f x
    for (std::size_t d = 0; d < D; ++d) {
      decrease[d] -= f * (lambda[j] - lambda[i]) * x[d];
      emptiness[d] -= f * x[d];
    }
  }
  if (B.least_eigenvalue_at_least() > k_least_eigenvalue) decrease = B.inverse() * decrease;
  const double least = k_least_gradient / kernel.R;
  return {unit<D>(decrease, least), unit<D>(emptiness, least)};
}

/// True if a neighbour stands in the 45 degree cone around the normal, whose far end is rounded about the
/// point at distance h = R/2.
template <int D>
bool something_above(const Particles<D>& particles, double R, const std::array<double, D>& n, std::size_t i,
                     const std::int32_t* list, std::size_t count) {
  const double h = 0.5 * R;
  for (std::size_t k = 0; k < count; ++k) {
    const auto x = separation(particles, i, static_cast<std::size_t>(list[k]));
    const double r2 = dot<D>(x, x), along = dot<D>(n, x);
    if (r2 < 2.0 * h * h) {
      if (along > 0.0 && 2.0 * along * along > r2) return true;
    } else if (r2 - 2.0 * along * h + h * h < h * h) {  // |x - n h| < h
      return true;
    }
  }
  return false;
}

}  // namespace

template <int D>
void SurfaceDetection<D>::detect(Particles<D>& particles, const NeighborList<D>& neighbors,
                                 const Ghosts<D>& ghosts, const WallSupport<D>* walls, bool with_crowding) {
  const Kernel<D> kernel(neighbors.kernel_radius());
  lambda_.resize(particles.size());
  const auto n = static_cast<std::ptrdiff_t>(particles.n_owned);
  const auto* start = neighbors.start();
#pragma omp parallel for schedule(static)
  for (std::ptrdiff_t row = 0; row < n; ++row) {
    const auto i = static_cast<std::size_t>(row);
    const auto own = support(particles, kernel, i, neighbors.list() + start[i], start[i + 1] - start[i]);
    lambda_[i] = (walls ? own.B + walls->renormalisation(i) : own.B).smallest_eigenvalue();
    for (std::size_t d = 0; d < D && with_crowding; ++d) particles.shift[d][i] = own.crowding[d];
  }
  ghosts.refresh_scalar(lambda_, particles.n_owned);

#pragma omp parallel for schedule(static)
  for (std::ptrdiff_t row = 0; row < n; ++row) {
    const auto i = static_cast<std::size_t>(row);
    particles.surface[i] = SurfaceFlag::none;
    for (std::size_t d = 0; d < D; ++d) particles.normal[d][i] = 0.0;
    if (lambda_[i] > k_interior_above) continue;
    const auto* list = neighbors.list() + start[i];
    const std::size_t count = start[i + 1] - start[i];
    const auto crowded = walls ? walls->crowding(i) : std::array<double, D>{};
    // B once more: few come here, and kept it would be a tenth of all the memory
    const auto B = support(particles, kernel, i, list, count).B;
    const auto normals = outward_normals<D>(particles, kernel, lambda_, B, crowded, i, list, count);
    const auto is_open = [&](const std::array<double, D>& normal) {
      return dot<D>(normal, normal) > 0.0 &&
             !something_above<D>(particles, kernel.R, normal, i, list, count) &&
             !(walls && walls->something_above(normal, i));
    };
    // Next to an edge of the water grad lambda points along the surface to the edge rather than out of it,
    // and across a sheet of two rows it vanishes; where the support is empty serves there.
    const bool open_along_lambda = is_open(normals.from_lambda);
    if (lambda_[i] >= k_surface_below && !open_along_lambda && !is_open(normals.from_support)) continue;
    particles.surface[i] = SurfaceFlag::surface;
    const auto& chosen = open_along_lambda ? normals.from_lambda : normals.from_support;
    for (std::size_t d = 0; d < D; ++d) particles.normal[d][i] = chosen[d];
  }
}

template <int D>
void SurfaceDetection<D>::mark_near(Particles<D>& particles, const NeighborList<D>& neighbors,
                                    const Ghosts<D>& ghosts) {
  const double R = neighbors.kernel_radius();
  std::vector<double> on_surface(particles.size());  // 1 or 0
  std::array<std::vector<double>, D> normal;
  for (auto& column : normal) column.resize(particles.size());
  for (std::size_t i = 0; i < particles.n_owned; ++i) {
    on_surface[i] = particles.surface[i] == SurfaceFlag::surface ? 1.0 : 0.0;
    for (std::size_t d = 0; d < D; ++d) normal[d][i] = particles.normal[d][i];
  }
  ghosts.refresh_scalar(on_surface, particles.n_owned);
  ghosts.refresh_vector(normal, particles.n_owned);

  distance_.assign(particles.n_owned, 1.0);
  const auto n = static_cast<std::ptrdiff_t>(particles.n_owned);
#pragma omp parallel for schedule(static)
  for (std::ptrdiff_t row = 0; row < n; ++row) {
    const auto i = static_cast<std::size_t>(row);
    if (particles.surface[i] == SurfaceFlag::surface) {
      distance_[i] = 0.0;
      continue;
    }
    double least = R * R;
    std::size_t closest = particles.size();
    for (std::size_t k = neighbors.start()[i]; k < neighbors.start()[i + 1]; ++k) {
      const auto j = static_cast<std::size_t>(neighbors.list()[k]);
      if (on_surface[j] == 0.0) continue;
      const auto x = separation(particles, i, j);
      const double r2 = dot<D>(x, x);
      if (r2 < least) least = r2, closest = j;
    }
    particles.surface[i] = closest < particles.size() ? SurfaceFlag::near : SurfaceFlag::none;
    if (closest == particles.size()) continue;
    distance_[i] = std::sqrt(least) / R;
    for (std::size_t d = 0; d < D; ++d) particles.normal[d][i] = normal[d][closest];
  }
}

template class SurfaceDetection<2>;
template class SurfaceDetection<3>;

}  // namespace littoral::sph
