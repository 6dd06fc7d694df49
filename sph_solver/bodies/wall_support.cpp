#include "bodies/wall_support.hpp"

#include <algorithm>
#include <cmath>

#include "bodies/nearest_image.hpp"
#include "bodies/wall_view.hpp"
#include "physics/kernel.hpp"

namespace littoral::sph {
namespace {

// A place counts as wet if a particle stands within this of it, in spacings: no place inside a lattice is
// further than sqrt(D)/2 from one, one above its surface row is 1 away.
template <int D>
constexpr double k_wet_within = D == 2 ? 0.85 : 0.93;

// Images of dummies nearer to the wall than this are taken from here [spacings]: along a wall that cuts the
// lattice the first particles may stand .7 spacings off it, and none between them and the wall.
constexpr double k_least_off = 0.5;

/// A particle and its neighbours, their places side by side: a row's dummies ask for them over and over.
template <int D>
class Around {
 public:
  void gather(const Particles<D>& particles, const NeighborList<D>& neighbors, std::size_t i) {
    const auto* list = neighbors.list() + neighbors.start()[i];
    const std::size_t count = neighbors.start()[i + 1] - neighbors.start()[i];
    for (std::size_t d = 0; d < D; ++d) {
      x_[d].resize(count + 1);
      for (std::size_t k = 0; k < count; ++k) x_[d][k] = particles.x[d][static_cast<std::size_t>(list[k])];
      x_[d][count] = particles.x[d][i];
    }
  }
  /// One of them stands within this distance of the place.
  bool any_near(const Vector<D>& place, double within) const {
    double least = within * within;
    std::array<const double*, D> x;
    for (std::size_t d = 0; d < D; ++d) x[d] = x_[d].data();
    const std::size_t n = x_[0].size();
#pragma omp simd reduction(min : least)
    for (std::size_t k = 0; k < n; ++k) {
      double r2 = 0.0;
      for (std::size_t d = 0; d < D; ++d) r2 += (x[d][k] - place[d]) * (x[d][k] - place[d]);
      least = r2 < least ? r2 : least;
    }
    return least < within * within;
  }

 private:
  std::array<std::vector<double>, D> x_;
};

/// Where walls meet, the image about the one may lie in the other: no void either.
template <int D>
bool is_body(const std::vector<Body>& bodies, const DomainBox<D>& box, const Vector<D>& place,
             double spacing) {
  return std::any_of(bodies.begin(), bodies.end(), [&](const Body& body) {
    return !body.is_sheet() &&
           body.closest_wall(nearest_image<D>(box, body, in_scene<D>(place))).distance <= k_on_body * spacing;
  });
}

}  // namespace

template <int D>
void WallSupport<D>::find(const Particles<D>& particles, const NeighborList<D>& neighbors,
                          const std::vector<Body>& bodies, const DomainBox<D>& box, const Dummies<D>& dummies,
                          const WallList<D>& list, double spacing, bool free_surface) {
  list_ = &list;
  const Kernel<D> kernel(neighbors.kernel_radius());
  R_ = kernel.R;
  B_.assign(list.n_rows(), {});
  crowding_.assign(list.n_rows(), {});
  normal_.assign(list.n_rows(), {});
  close_.assign(list.n_rows(), 0);
  wet_.assign(list.n_pairs(), 0);
  separation_.assign(list.n_pairs(), {});
  const auto n = static_cast<std::ptrdiff_t>(list.n_rows());
#pragma omp parallel
  {
    Around<D> around;
#pragma omp for schedule(static)
    for (std::ptrdiff_t k = 0; k < n; ++k) {
      const auto row = static_cast<std::size_t>(k);
      const std::size_t i = list.particle(row);
      const auto x = at<D>(particles.x, i);
      around.gather(particles, neighbors, i);
      WallView<D> view(bodies, dummies, list, row, x);
      const auto closest = view.closest();
      normal_[row] = closest.n;
      close_[row] = closest.distance < 0.5 * spacing;
      for (std::size_t pair = list.begin(row); pair < list.end(row); ++pair) {
        const std::size_t e = list.dummy(pair);
        Vector<D> dx = dummies[e].x;
        for (std::size_t d = 0; d < D; ++d) dx[d] -= x[d];
        separation_[pair] = dx;
        const double f = -dummies.volume() * kernel.slope_over_r(std::sqrt(dot_of<D>(dx, dx)));
        if (f == 0.0) continue;
        const auto wet_before = [&](const WallPlane<D>& wall) {
          const double along = dot_of<D>(dx, wall.n), depth = along - wall.distance;
          const double off = std::max(depth, k_least_off * spacing);
          Vector<D> mirror;
          for (std::size_t d = 0; d < D; ++d) mirror[d] = x[d] + dx[d] - (depth + off) * wall.n[d];
          return around.any_near(mirror, k_wet_within<D> * spacing) ||
                 is_body<D>(bodies, box, mirror, spacing);
        };
        if (free_surface && !wet_before(view.plane_of_dummy(e))) continue;
        wet_[pair] = 1;
        std::size_t m = 0;
        for (std::size_t a = 0; a < D; ++a) {
          crowding_[row][a] += f * dx[a];
          for (std::size_t b = a; b < D; ++b) B_[row].a[m++] += f * dx[a] * dx[b];
        }
      }
    }
  }
}

template <int D>
SymmetricMatrix<D> WallSupport<D>::renormalisation(std::size_t i) const {
  const auto row = list_->row_of(i);
  return row < 0 ? SymmetricMatrix<D>{} : B_[static_cast<std::size_t>(row)];
}

template <int D>
std::array<double, D> WallSupport<D>::crowding(std::size_t i) const {
  const auto row = list_->row_of(i);
  return row < 0 ? std::array<double, D>{} : crowding_[static_cast<std::size_t>(row)];
}

template <int D>
bool WallSupport<D>::something_above(const std::array<double, D>& n, std::size_t i) const {
  const auto row = list_->row_of(i);
  if (row < 0) return false;
  for (std::size_t pair = list_->begin(static_cast<std::size_t>(row));
       pair < list_->end(static_cast<std::size_t>(row)); ++pair) {
    if (!wet_[pair]) continue;
    const double r2 = dot_of<D>(separation_[pair], separation_[pair]),
                 along = dot_of<D>(n, separation_[pair]);
    if (along > 0.0 && 2.0 * along * along > r2) return true;
  }
  return false;
}

template <int D>
void WallSupport<D>::keep_off(std::size_t i, std::array<double, D>& shift) const {
  const auto row = list_->row_of(i);
  if (row < 0 || !close_[static_cast<std::size_t>(row)]) return;
  const auto& n = normal_[static_cast<std::size_t>(row)];
  const double into = dot_of<D>(shift, n);
  if (into <= 0.0) return;
  for (std::size_t d = 0; d < D; ++d) shift[d] -= into * n[d];
}

template class WallSupport<2>;
template class WallSupport<3>;

}  // namespace littoral::sph
