#pragma once

#include <array>
#include <cmath>
#include <cstddef>

namespace littoral::coupler {

/// The bilinear (A = 2) or trilinear (A = 3) map from the unit square or cube to a cell given by its corners:
/// x(xi) = sum over subsets S of the directions of c_S prod_{d in S} xi_d, relative to corner 0. Corner k has
/// xi_d = bit d of k.
template <int A>
class Multilinear {
 public:
  static constexpr std::size_t k_corners = std::size_t{1} << A;
  using Point = std::array<double, A>;
  using Corners = std::array<Point, k_corners>;

  explicit Multilinear(const Corners& corners) : origin_(corners[0]), c_(corners) {
    for (auto& corner : c_)
      for (std::size_t i = 0; i < A; ++i) corner[i] -= origin_[i];
    for (std::size_t d = 0; d < A; ++d)  // differences along d turn corner values into coefficients
      for (std::size_t k = 0; k < k_corners; ++k)
        if (k >> d & 1)
          for (std::size_t i = 0; i < A; ++i) c_[k][i] -= c_[k ^ (std::size_t{1} << d)][i];
  }

  Point operator()(const Point& xi) const {
    Point x = relative(xi);
    for (std::size_t i = 0; i < A; ++i) x[i] += origin_[i];
    return x;
  }

  /// jacobian[d][i] = d x_i / d xi_d
  std::array<Point, A> jacobian(const Point& xi) const {
    std::array<Point, A> j{};
    for (std::size_t d = 0; d < A; ++d)
      for (std::size_t k = 0; k < k_corners; ++k)
        if (k >> d & 1) {
          const double m = monomial(k ^ (std::size_t{1} << d), xi);
          for (std::size_t i = 0; i < A; ++i) j[d][i] += m * c_[k][i];
        }
    return j;
  }

  /// Newton inversion from the cell's centre, so that the result depends on the cell and the point only.
  /// false where it does not converge or the map is singular
  bool invert(const Point& x, Point& xi) const {
    constexpr int k_max_iterations = 20;
    constexpr double k_last_step = 1e-8;   // the step after it would be its square
    constexpr double k_longest_step = 4.;  // [cells] a wilder step means a far point: do not lose direction
    xi.fill(0.5);
    for (int iteration = 0; iteration < k_max_iterations; ++iteration) {
      const Point at = relative(xi);
      Point residual;
      for (std::size_t i = 0; i < A; ++i) residual[i] = x[i] - origin_[i] - at[i];
      Point step;
      if (!solve(jacobian(xi), residual, step)) return false;
      double largest = 0.0;
      for (const double s : step) {
        if (!(std::abs(s) < 1e300)) return false;  // NaN, too
        largest = std::fmax(largest, std::abs(s));
      }
      const double damping = largest > k_longest_step ? k_longest_step / largest : 1.0;
      for (std::size_t d = 0; d < A; ++d) xi[d] += damping * step[d];
      if (largest < k_last_step) return true;
    }
    return false;
  }

  /// Interpolation weights of the corners at xi; sum 1.
  static std::array<double, k_corners> weights(const Point& xi) {
    std::array<double, k_corners> w;
    for (std::size_t k = 0; k < k_corners; ++k) {
      w[k] = 1.0;
      for (std::size_t d = 0; d < A; ++d) w[k] *= (k >> d & 1) ? xi[d] : 1.0 - xi[d];
    }
    return w;
  }

  /// Solves sum_d j[d][i] s_d = r_i by Cramer's rule: columns of very different length do no harm.
  static bool solve(const std::array<Point, A>& j, const Point& r, Point& s) {
    if constexpr (A == 2) {
      const double det = j[0][0] * j[1][1] - j[1][0] * j[0][1];
      if (det == 0.0) return false;
      s = {(r[0] * j[1][1] - j[1][0] * r[1]) / det, (j[0][0] * r[1] - r[0] * j[0][1]) / det};
    } else {
      const Point c12 = cross(j[1], j[2]), c20 = cross(j[2], j[0]), c01 = cross(j[0], j[1]);
      const double det = dot(j[0], c12);
      if (det == 0.0) return false;
      s = {dot(r, c12) / det, dot(r, c20) / det, dot(r, c01) / det};
    }
    return true;
  }

  /// Area or volume at the cell's centre, unsigned.
  double measure() const {
    Point centre;
    centre.fill(0.5);
    const auto j = jacobian(centre);
    if constexpr (A == 2)
      return std::abs(j[0][0] * j[1][1] - j[1][0] * j[0][1]);
    else
      return std::abs(dot(j[0], cross(j[1], j[2])));
  }

 private:
  static Point cross(const Point& a, const Point& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
  }
  static double dot(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
  static double monomial(std::size_t k, const Point& xi) {
    double m = 1.0;
    for (std::size_t d = 0; d < A; ++d)
      if (k >> d & 1) m *= xi[d];
    return m;
  }
  Point relative(const Point& xi) const {
    Point x{};
    for (std::size_t k = 1; k < k_corners; ++k) {
      const double m = monomial(k, xi);
      for (std::size_t i = 0; i < A; ++i) x[i] += m * c_[k][i];
    }
    return x;
  }

  Point origin_;
  Corners c_;
};

/// Weights of a linear fit through those corners of a cell that are usable (least squares where there are
/// more than A + 1 of them), evaluated at x: exact for linear fields, 0 at the others. Coordinates are those
/// of the cell's mean Jacobian, so a cell of aspect 1000 is as well conditioned as a cube.
/// false where the usable corners do not span the space
template <int A>
bool linear_fit_weights(const typename Multilinear<A>::Corners& corners,
                        const std::array<bool, Multilinear<A>::k_corners>& usable,
                        const typename Multilinear<A>::Point& x,
                        std::array<double, Multilinear<A>::k_corners>& weights) {
  using Map = Multilinear<A>;
  constexpr std::size_t n = A + 1;
  const Map map(corners);
  typename Map::Point middle;
  middle.fill(0.5);
  const auto jacobian = map.jacobian(middle);
  const auto centre = map(middle);
  const auto local = [&](const typename Map::Point& point, std::array<double, n>& basis) {
    typename Map::Point offset, eta;
    for (std::size_t i = 0; i < A; ++i) offset[i] = point[i] - centre[i];
    if (!Map::solve(jacobian, offset, eta)) return false;
    basis[0] = 1.0;
    for (std::size_t i = 0; i < A; ++i) basis[i + 1] = eta[i];
    return true;
  };
  std::array<std::array<double, n>, Map::k_corners> row{};
  std::array<std::array<double, n>, n> normal{};
  std::array<double, n> target{};
  if (!local(x, target)) return false;
  for (std::size_t k = 0; k < Map::k_corners; ++k) {
    if (!usable[k]) continue;
    if (!local(corners[k], row[k])) return false;
    for (std::size_t a = 0; a < n; ++a)
      for (std::size_t b = 0; b < n; ++b) normal[a][b] += row[k][a] * row[k][b];
  }
  // Gauss without pivoting: the matrix is symmetric positive definite unless the corners lie in a plane
  constexpr double k_flat = 1e-6;  // in local coordinates corners are about one apart
  for (std::size_t a = 0; a < n; ++a) {
    if (normal[a][a] < k_flat) return false;
    for (std::size_t b = a + 1; b < n; ++b) {
      const double factor = normal[b][a] / normal[a][a];
      for (std::size_t c = a; c < n; ++c) normal[b][c] -= factor * normal[a][c];
      target[b] -= factor * target[a];
    }
  }
  for (std::size_t a = n; a-- > 0;) {
    for (std::size_t c = a + 1; c < n; ++c) target[a] -= normal[a][c] * target[c];
    target[a] /= normal[a][a];
  }
  for (std::size_t k = 0; k < Map::k_corners; ++k) {
    weights[k] = 0.0;
    if (usable[k])
      for (std::size_t a = 0; a < n; ++a) weights[k] += row[k][a] * target[a];
  }
  return true;
}

}  // namespace littoral::coupler
