#include "level_set/patches.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "grid/between.hpp"
#include "grid/loops.hpp"
#include "level_set/taylor.hpp"

namespace littoral::fv {
namespace {

/// Length of a cell's diagonal, from the centres around it [m].
template <int D>
double diagonal(const Block<D>& block, std::ptrdiff_t c) {
  double sum = 0.0;
  for (std::size_t d = 0; d < D; ++d) {
    const SpaceVector<D> across = between(block, c - block.extent.stride[d], c + block.extent.stride[d]);
    sum += 0.25 * dot(across, across);
  }
  return std::sqrt(sum);
}

/// The cell whose surroundings hold real values in all directions: c, or one further from walls.
template <int D>
std::ptrdiff_t well_surrounded(const Block<D>& block, const Band<D>& band, std::size_t b, std::ptrdiff_t c) {
  std::ptrdiff_t at = c;
  for (std::size_t d = 0; d < D; ++d) {
    const std::ptrdiff_t s = block.extent.stride[d];
    const bool low = band.stands_for_cell(b, c - s), up = band.stands_for_cell(b, c + s);
    if (low != up && band.stands_for_cell(b, at + (up ? s : -s))) at += up ? s : -s;
  }
  // an inner corner of the grid may lie there
  return band.stands_for_cell(b, at) ? at : c;
}

template <int D>
bool finite(const SpaceVector<D>& v) {
  for (const double x : v)
    if (!std::isfinite(x)) return false;
  return true;
}

/// Foot of the origin on the zero level of a polynomial: steps along the gradient to the level, and along the
/// level to where the origin lies straight below (Chopp 2001). false where it does not get there.
template <int D>
bool foot_of_origin(const Taylor<D>& p, double reach, SpaceVector<D>& r) {
  constexpr int k_steps = 12;
  constexpr double k_flat = 0.1;  // of a distance's gradient, 1: no normal worth that name
  r = {};
  for (int step = 0; step < k_steps; ++step) {
    const SpaceVector<D> g = p.gradient_at(r);
    const double g2 = dot(g, g);
    if (!(g2 > k_flat * k_flat)) return false;
    const double to_level = -p.at(r) / g2, along = dot(r, g) / g2;
    double change = 0.0;
    for (std::size_t k = 0; k < D; ++k) {
      const double move = to_level * g[k] - (r[k] - along * g[k]);
      r[k] += move;
      change = std::max(change, std::abs(move));
    }
    if (!finite<D>(r) || length(r) > reach) return false;
    constexpr double k_round_off = 1e-14;
    if (change < k_round_off * reach) return true;
  }
  constexpr double k_close =
      1e-3;  // flat spots converge slowly; the rest is below the polynomial's own error
  return std::abs(p.at(r)) < k_close * reach;
}

template <int D>
SurfacePatch<D> patch_of(const Taylor<D>& p, const SpaceVector<D>& foot, double width) {
  SurfacePatch<D> patch;
  patch.to_base = foot;
  const SpaceVector<D> g = p.gradient_at(foot);
  const double size = length(g);
  for (std::size_t k = 0; k < D; ++k) patch.normal[k] = g[k] / size;
  const SpaceVector<D>& n = patch.normal;
  SpaceMatrix<D> tangential;  // I - n n
  for (std::size_t k = 0; k < D; ++k)
    for (std::size_t l = 0; l < D; ++l) tangential[k][l] = (k == l ? 1.0 : 0.0) - n[k] * n[l];
  double norm2 = 0.0;
  for (std::size_t i = 0; i < D; ++i)
    for (std::size_t j = 0; j < D; ++j) {
      double sum = 0.0;
      for (std::size_t k = 0; k < D; ++k)
        for (std::size_t l = 0; l < D; ++l) sum += tangential[i][k] * p.hessian[k][l] * tangential[l][j];
      patch.S[i][j] = sum / size;
      norm2 += patch.S[i][j] * patch.S[i][j];
    }
  // radii below a cell's width are not resolved
  const double excess = std::sqrt(norm2) * width;
  if (excess > 1.0)
    for (auto& row : patch.S)
      for (double& value : row) value /= excess;
  return patch;
}

/// The nearest crossing of phi = 0 on the grid lines through a cell, and the line's direction as normal.
template <int D>
bool nearest_crossing(const Block<D>& block, const Field& phi, std::ptrdiff_t c, SurfacePatch<D>& patch) {
  double least = std::numeric_limits<double>::infinity();
  const double here = phi[static_cast<std::size_t>(c)];
  for (std::size_t d = 0; d < D; ++d)
    for (const std::ptrdiff_t step : {-block.extent.stride[d], block.extent.stride[d]}) {
      const double there = phi[static_cast<std::size_t>(c + step)];
      if ((here < 0.0) == (there < 0.0)) continue;
      const SpaceVector<D> line = between(block, c, c + step);
      const double theta = here / (here - there), size = length(line);
      if (!(theta * size < least)) continue;
      least = theta * size;
      for (std::size_t k = 0; k < D; ++k) {
        patch.to_base[k] = theta * line[k];
        patch.normal[k] = (here < 0.0 ? 1.0 : -1.0) * line[k] / size;
      }
      patch.S = {};
    }
  return least < std::numeric_limits<double>::infinity();
}

/// grad phi from the cells of layer 0 alone, which nothing but the motion changes. false: not enough of them,
/// or phi falls from the cell on both sides alike (a drop of one cell): what is left of it is round-off, and
/// no direction
template <int D>
bool frozen_gradient(const Block<D>& block, const Band<D>& band, const Field& phi, std::size_t b,
                     std::ptrdiff_t c, SpaceVector<D>& gradient) {
  SpaceMatrix<D> steps;
  SpaceVector<D> change;
  double variation2 = 0.0;
  const double here = phi[static_cast<std::size_t>(c)];
  for (std::size_t d = 0; d < D; ++d) {
    const std::ptrdiff_t s = block.extent.stride[d];
    const std::ptrdiff_t low = band.layer(b, c - s) == 0 ? c - s : c,
                         up = band.layer(b, c + s) == 0 ? c + s : c;
    if (low == up) return false;
    steps[d] = between(block, low, up);
    const double below = phi[static_cast<std::size_t>(low)], above = phi[static_cast<std::size_t>(up)];
    change[d] = above - below;
    const double variation = std::abs(above - here) + std::abs(here - below);
    variation2 += variation * variation;
  }
  constexpr double k_even = 1e-2;  // of what phi varies by: falling to both sides alike
  if (!(dot(change, change) > k_even * k_even * variation2)) return false;
  gradient = times(inverse<D>(steps), change);
  return finite<D>(gradient);
}

/// Whether a patch's normal is near that of the cells at the surface. Values of phi further out are made from
/// patches; without this check wrong ones could confirm themselves for ever.
template <int D>
bool plausible(const SurfacePatch<D>& patch, const SpaceVector<D>& gradient) {
  constexpr double k_cosine =
      0.96;  // of 16 degrees: the turn of the normal over half a cell on a radius of two
  return dot(patch.normal, gradient) >= k_cosine * length(gradient);
}

}  // namespace

template <int D>
bool own_patch(const Block<D>& block, const Band<D>& band, const Field& phi, std::size_t b, std::ptrdiff_t c,
               SurfacePatch<D>& patch) {
  const double width = diagonal(block, c);
  SurfacePatch<D> crossing;
  const bool crossed = nearest_crossing(block, phi, c, crossing);
  // the closest point is no further than any other of the surface; with room for the curvature in between
  constexpr double k_reach = 2.0, k_room = 0.25;
  const double reach = crossed ? (1.0 + k_room) * length(crossing.to_base) + k_room * width : k_reach * width;
  SpaceVector<D> gradient{};
  const bool check = frozen_gradient<D>(block, band, phi, b, c, gradient);
  for (const std::ptrdiff_t at : {well_surrounded(block, band, b, c), c}) {
    const Taylor<D> p = taylor(block, phi, at).moved(between(block, at, c));
    SpaceVector<D> foot;
    if (!foot_of_origin<D>(p, reach, foot)) continue;
    patch = patch_of<D>(p, foot, width);
    if (!check || plausible<D>(patch, gradient)) return true;
  }
  patch = crossing;
  if (check && crossed)
    for (std::size_t k = 0; k < D; ++k) patch.normal[k] = gradient[k] / length(gradient);
  return crossed;
}

constexpr double k_film = 2.0;  // mark of patches of films; of others 1

/// Whether a cell at the surface sees it only beyond the grid: a film on a wall, thinner than half a cell.
template <int D>
bool is_film(const Block<D>& block, const Band<D>& band, const Field& phi, std::size_t b, std::ptrdiff_t c) {
  if (phi[static_cast<std::size_t>(c)] < 0.0) return false;
  for (const std::ptrdiff_t s : block.extent.stride)
    for (const std::ptrdiff_t other : {c - s, c + s})
      if (phi[static_cast<std::size_t>(other)] < 0.0 && band.stands_for_cell(b, other)) return false;
  return true;
}

template <int D>
Foot<D> closest_point(const SurfacePatch<D>& patch, double reach) {
  const SpaceVector<D>& n = patch.normal;
  SpaceVector<D> r, s{};  // r: from the base to the centre; s: tangential place of the foot
  for (std::size_t k = 0; k < D; ++k) r[k] = -patch.to_base[k];
  const double a = dot(r, n);
  // minimum of (t - s)^2 + (a + s.S s/2)^2: (I + a S) s = t, with the height where s is
  double height = 0.0;
  for (int step = 0; step < 3; ++step) {
    SpaceMatrix<D> m;
    SpaceVector<D> t;
    for (std::size_t k = 0; k < D; ++k) {
      t[k] = r[k] - a * n[k];
      for (std::size_t l = 0; l < D; ++l) m[k][l] = (k == l ? 1.0 : 0.0) + (a - height) * patch.S[k][l];
    }
    const SpaceVector<D> found = times(inverse<D>(m), t);
    if (!finite<D>(found)) break;
    s = found;
    const double size = length(s);
    if (size > reach || dot(s, t) < 0.0) {  // beyond the patch, or the far side of a centre of curvature
      const double t_size = length(t);
      const double keep = t_size > 0.0 ? std::min(reach, t_size) / t_size : 0.0;
      for (std::size_t k = 0; k < D; ++k) s[k] = keep * t[k];
    }
    height = -0.5 * dot(s, times(patch.S, s));
  }
  Foot<D> foot;
  const SpaceVector<D> turned = times(patch.S, s);
  for (std::size_t k = 0; k < D; ++k) {
    foot.to[k] = s[k] + height * n[k] - r[k];
    foot.normal[k] = n[k] + turned[k];
  }
  const double size = length(foot.normal);
  for (double& component : foot.normal) component /= size;
  foot.distance = std::copysign(length(foot.to), -dot(foot.to, foot.normal));
  return foot;
}

template <int D>
SurfacePatch<D> SurfacePatches<D>::at(std::size_t block, std::ptrdiff_t cell) const {
  const auto& f = numbers_[block];
  const auto c = static_cast<std::size_t>(cell);
  SurfacePatch<D> patch;
  std::size_t number = 2 * D;
  for (std::size_t k = 0; k < D; ++k) {
    patch.to_base[k] = f[k][c];
    patch.normal[k] = f[D + k][c];
    for (std::size_t l = 0; l <= k; ++l) patch.S[k][l] = patch.S[l][k] = f[number++][c];
  }
  return patch;
}

template <int D>
void SurfacePatches<D>::put(std::size_t block, std::ptrdiff_t cell, const SurfacePatch<D>& patch) {
  auto& f = numbers_[block];
  const auto c = static_cast<std::size_t>(cell);
  std::size_t number = 2 * D;
  for (std::size_t k = 0; k < D; ++k) {
    f[k][c] = patch.to_base[k];
    f[D + k][c] = patch.normal[k];
    for (std::size_t l = 0; l <= k; ++l) f[number++][c] = patch.S[k][l];
  }
  known_[block][c] = 1.0;
}

template <int D>
void SurfacePatches<D>::exchange_all(const std::vector<Block<D>>& blocks, const Exchange<D>& exchange) {
  std::vector<std::vector<Field*>> fields(k_numbers + 1);
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    for (std::size_t k = 0; k < k_numbers; ++k) fields[k].push_back(&numbers_[b][k]);
    fields[k_numbers].push_back(&known_[b]);
  }
  exchange.scalars(blocks, fields, ScalarGhosts::cell_data);
}

template <int D>
void SurfacePatches<D>::build(const std::vector<Block<D>>& blocks, const Exchange<D>& exchange,
                              const Band<D>& band, const std::vector<Field>& phi) {
  numbers_.resize(blocks.size());
  known_.resize(blocks.size());
  source_.resize(blocks.size());
  feet_.resize(blocks.size());
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    for (Field& f : numbers_[b]) f.resize(blocks[b].extent.size);
    known_[b].assign(blocks[b].extent.size, 0.0);
    source_[b].resize(blocks[b].extent.size);
    feet_[b].assign(static_cast<std::size_t>(band.cells(b).size()), {});
  }
  for (int layer = 0; layer < band.layers(); ++layer) {
    if (layer > 0) exchange_all(blocks, exchange);
    for (std::size_t b = 0; b < blocks.size(); ++b) {
      const Block<D>& block = blocks[b];
      const auto cells = band.cells(b, layer, layer + 1);
      const std::ptrdiff_t before = cells.begin() - band.cells(b).begin();
#pragma omp parallel for schedule(static) if (cells.size() > k_cells_for_threads)
      for (std::ptrdiff_t i = 0; i < cells.size(); ++i) {
        const std::ptrdiff_t c = cells[i];
        SurfacePatch<D> best;
        double least = std::numeric_limits<double>::infinity(), mark = 1.0;
        if (layer == 0 && own_patch(block, band, phi[b], b, c, best)) {
          least = length(best.to_base);
          if (is_film(block, band, phi[b], b, c)) mark = k_film;
        }
        if (layer > 0) {
          const auto& stride = block.extent.stride;
          for_each_around<D>(stride, c, [&](const std::array<int, D>& step, std::ptrdiff_t other) {
            // only layers before: what this layer finds is for the next one
            if (band.layer(b, other) >= layer || !has(b, other)) return;
            SurfacePatch<D> patch = at(b, other);
            const SpaceVector<D> there = between(block, c, other);
            for (std::size_t k = 0; k < D; ++k) patch.to_base[k] += there[k];
            const double distance = length(patch.to_base);
            if (distance >= least) return;
            least = distance;
            best = patch;
            mark = known_[b][static_cast<std::size_t>(other)];
            int code = 0;
            for (std::size_t d = D; d-- > 0;) code = 3 * code + step[d] + 1;
            source_[b][static_cast<std::size_t>(c)] = static_cast<std::uint8_t>(code);
          });
        }
        if (!(least < std::numeric_limits<double>::infinity())) continue;
        put(b, c, best);
        known_[b][static_cast<std::size_t>(c)] = mark;
        // a film is known in its own cell only: carried on beyond, it would grow by a cell in every step
        const double reach = diagonal(block, c) * (mark == k_film ? 0.5 / std::sqrt(double{D}) : 1.0);
        feet_[b][static_cast<std::size_t>(before + i)] = closest_point(best, reach);
      }
    }
  }
  exchange_all(blocks, exchange);
}

template bool own_patch(const Block<2>&, const Band<2>&, const Field&, std::size_t, std::ptrdiff_t,
                        SurfacePatch<2>&);
template bool own_patch(const Block<3>&, const Band<3>&, const Field&, std::size_t, std::ptrdiff_t,
                        SurfacePatch<3>&);
template Foot<2> closest_point(const SurfacePatch<2>&, double);
template Foot<3> closest_point(const SurfacePatch<3>&, double);
template class SurfacePatches<2>;
template class SurfacePatches<3>;

}  // namespace littoral::fv
