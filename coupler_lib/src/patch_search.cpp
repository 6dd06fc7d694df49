#include "patch_search.hpp"

#include <algorithm>

namespace littoral::coupler {

namespace {

// A point this close to a face (in cells) belongs to the cell below it, so that points placed exactly on
// faces always get the same donors, whichever way the search came.
constexpr double k_face = 1e-9;
// How far beyond the outermost centres a dual cell serves [cells].
constexpr double k_reach = 0.5;
constexpr int k_leaf = 8;
constexpr int k_longest_walk = 40;
constexpr double k_stride = 8.0;  // [cells] a far point's direction is not worth more in one go

}  // namespace

template <int A>
PatchSearch<A>::Bounds::Bounds() {
  lower.fill(std::numeric_limits<double>::infinity());
  upper.fill(-std::numeric_limits<double>::infinity());
}
template <int A>
void PatchSearch<A>::Bounds::include(const Point& x) {
  for (std::size_t i = 0; i < A; ++i) {
    lower[i] = std::min(lower[i], x[i]);
    upper[i] = std::max(upper[i], x[i]);
  }
}
template <int A>
void PatchSearch<A>::Bounds::include(const Bounds& other) {
  include(other.lower);
  include(other.upper);
}
template <int A>
void PatchSearch<A>::Bounds::widen() {
  for (std::size_t i = 0; i < A; ++i) {
    const double slack = 1e-6 * (upper[i] - lower[i]);
    lower[i] -= slack;
    upper[i] += slack;
  }
}
template <int A>
bool PatchSearch<A>::Bounds::contains(const Point& x) const {
  for (std::size_t i = 0; i < A; ++i)
    if (!(x[i] >= lower[i] && x[i] <= upper[i])) return false;
  return true;
}
template <int A>
bool PatchSearch<A>::Bounds::meets(const Bounds& other) const {
  for (std::size_t i = 0; i < A; ++i)
    if (upper[i] < other.lower[i] || other.upper[i] < lower[i]) return false;
  return true;
}

template <int A>
PatchSearch<A>::PatchSearch(const DonorPatch& patch, const std::array<std::size_t, A>& axes,
                            std::size_t offset)
    : axes_(axes), offset_(offset), usable_(patch.usable) {
  const std::array<const std::vector<double>*, 3> coordinate{&patch.x, &patch.y, &patch.z};
  x_.resize(patch.size());
  for (std::size_t c = 0; c < x_.size(); ++c)
    for (std::size_t i = 0; i < A; ++i) x_[c][i] = (*coordinate[axes[i]])[c];

  std::size_t stride = 1, extended = 0;
  for (std::size_t d = 0; d < 3; ++d) {
    if (patch.n[d] > 1 && extended < A) {
      n_[extended] = patch.n[d];
      stride_[extended++] = stride;
    }
    stride *= static_cast<std::size_t>(patch.n[d]);
  }
  for (std::size_t k = 0; k < k_corners; ++k)
    for (std::size_t d = 0; d < A; ++d)
      if (k >> d & 1) corner_offset_[k] += stride_[d];

  flag_.assign(x_.size(), 0);
  Index first{}, count;
  for (std::size_t d = 0; d < A; ++d) count[d] = n_[d] - 1;
  Node everything{{}, first, count, 0};
  for_each(everything, [&](const Index& index) {
    const std::size_t cell = at(index);
    bool complete = true;
    for (std::size_t k = 0; k < k_corners; ++k) complete = complete && usable_[corner(cell, k)];
    flag_[cell] = static_cast<std::uint8_t>(is_dual | (complete ? is_complete : 0));
  });
  for_each(everything, [&](const Index& index) {
    if (at_an_edge(index)) flag_[at(index)] |= is_edge;
  });
  build(first, count);
}

template <int A>
std::size_t PatchSearch<A>::at(const Index& index) const {
  std::size_t cell = 0;
  for (std::size_t d = 0; d < A; ++d) cell += static_cast<std::size_t>(index[d]) * stride_[d];
  return cell;
}

template <int A>
bool PatchSearch<A>::complete_at(const Index& index) const {
  for (std::size_t d = 0; d < A; ++d)
    if (index[d] < 0 || index[d] >= n_[d] - 1) return false;
  return flag_[at(index)] & is_complete;
}

template <int A>
bool PatchSearch<A>::at_an_edge(const Index& index) const {
  if (!complete_at(index)) return false;
  for (std::size_t d = 0; d < A; ++d) {
    Index below = index, above = index;
    --below[d];
    ++above[d];
    if (!complete_at(below) || !complete_at(above)) return true;
  }
  return false;
}

/// Where a dual cell can serve: itself, and beyond it towards neighbours that cannot.
template <int A>
typename PatchSearch<A>::Bounds PatchSearch<A>::reach(const Index& index) const {
  const Corners c = corners(at(index));
  Bounds bounds;
  for (const auto& corner_x : c) bounds.include(corner_x);
  if (flag_[at(index)] &
      is_edge) {  // on all sides: beside an edge of the usable part the diagonal neighbour counts, too
    const Map map(c);
    for (std::size_t k = 0; k < k_corners; ++k) {
      Point xi;
      for (std::size_t d = 0; d < A; ++d) xi[d] = (k >> d & 1) ? 1.0 + k_reach : -k_reach;
      bounds.include(map(xi));
    }
  }
  bounds.widen();
  return bounds;
}

template <int A>
template <class Visit>
void PatchSearch<A>::for_each(const Node& node, const Visit& visit) const {
  Index index;
  const int n2 = A == 3 ? node.count[A - 1] : 1;
  for (int k = 0; k < n2; ++k)
    for (int j = 0; j < node.count[1]; ++j)
      for (int i = 0; i < node.count[0]; ++i) {
        index[0] = node.first[0] + i;
        index[1] = node.first[1] + j;
        if constexpr (A == 3) index[2] = node.first[2] + k;
        visit(index);
      }
}

template <int A>
std::size_t PatchSearch<A>::build(const Index& first, const Index& count) {
  const std::size_t me = tree_.size();
  tree_.push_back({{}, first, count, 0});
  int total = 1;
  std::size_t widest = 0;
  for (std::size_t d = 0; d < A; ++d) {
    total *= std::min(count[d], 1000);
    if (count[d] > count[widest]) widest = d;
  }
  if (total <= k_leaf) {
    for_each(tree_[me], [&](const Index& index) { tree_[me].bounds.include(reach(index)); });
    return me;
  }
  Index left = count, right = count, middle = first;
  left[widest] = count[widest] / 2;
  right[widest] = count[widest] - left[widest];
  middle[widest] += left[widest];
  const std::size_t a = build(first, left), b = build(middle, right);
  tree_[me].right = b;
  tree_[me].bounds.include(tree_[a].bounds);
  tree_[me].bounds.include(tree_[b].bounds);
  return me;
}

template <int A>
void PatchSearch<A>::consider(const Point& x, std::size_t cell, Candidate<A>& best) const {
  const Corners c = corners(cell);
  if (!(flag_[cell] & is_edge)) {  // beyond it others serve: no need to invert its map
    Bounds itself;
    for (const Point& corner_x : c) itself.include(corner_x);
    itself.widen();
    if (!itself.contains(x)) return;
  }
  const Map map(c);
  Candidate<A> candidate;
  candidate.cell = cell;
  if (!map.invert(x, candidate.xi)) return;
  for (const double xi : candidate.xi) {
    candidate.outside = std::max({candidate.outside, -xi, xi - 1.0});
    if (std::abs(xi) <= k_face) ++candidate.low_faces;
  }
  if (candidate.outside > k_reach + k_face) return;
  const bool complete = flag_[cell] & is_complete;
  using Kind = typename Candidate<A>::Kind;
  if (candidate.outside <= k_face)
    candidate.kind = complete ? Kind::inside : Kind::fitted;
  else if (complete)
    candidate.kind = Kind::extrapolated;
  else
    return;
  candidate.measure = map.measure();
  if (candidate.kind == Kind::fitted) {
    std::array<bool, k_corners> corner_usable;
    std::array<double, k_corners> weights;
    for (std::size_t k = 0; k < k_corners; ++k) corner_usable[k] = usable(corner(cell, k));
    if (!linear_fit_weights<A>(c, corner_usable, x, weights)) return;
  }
  if (candidate.better_than(best)) best = candidate;
}

template <int A>
void PatchSearch<A>::search(const Point& x, Candidate<A>& best) const {
  std::array<std::size_t, 64> stack;  // halving ranges: depth is about log2 of the number of cells
  std::size_t depth = 0;
  stack[depth++] = 0;
  while (depth > 0) {
    const Node& node = tree_[stack[--depth]];
    if (!node.bounds.contains(x)) continue;
    if (node.right != 0) {
      stack[depth++] = node.right;
      stack[depth++] = static_cast<std::size_t>(&node - tree_.data()) + 1;
    } else {
      for_each(node, [&](const Index& index) { consider(x, at(index), best); });
      // well inside a cell that no other patch meets: there is no better one
      if (best.kind == Candidate<A>::Kind::inside && best.low_faces == 0 && !(flag_[best.cell] & is_shared))
        return;
    }
  }
}

template <int A>
bool PatchSearch<A>::walk(const Point& x, std::size_t start, Candidate<A>& found) const {
  if (start >= flag_.size() || !(flag_[start] & is_dual)) return false;
  std::size_t cell = start;
  for (int steps = 0; steps < k_longest_walk; ++steps) {
    if ((flag_[cell] & (is_complete | is_shared)) != is_complete) return false;
    const Map map(corners(cell));
    if (!map.invert(x, found.xi)) return false;
    bool here = true;
    std::size_t next = cell;
    for (std::size_t d = 0; d < A; ++d) {
      const double xi = found.xi[d];
      if (xi > k_face && xi <= 1.0 + k_face) continue;
      const int index = static_cast<int>(cell / stride_[d] % static_cast<std::size_t>(n_[d]));
      const int wanted = static_cast<int>(std::clamp(std::ceil(xi - k_face) - 1.0, -k_stride, k_stride));
      const int moved = std::clamp(index + wanted, 0, n_[d] - 2);
      if (moved == index) {
        if (xi < -k_face || xi > 1.0 + k_face) here = false;
        continue;  // on the outermost face: this cell holds it; beyond it: `next` may still move sideways
      }
      here = false;
      next += static_cast<std::size_t>(moved) * stride_[d] - static_cast<std::size_t>(index) * stride_[d];
    }
    if (here) {
      found.cell = cell;
      found.kind = Candidate<A>::Kind::inside;
      return true;
    }
    if (next == cell) return false;
    cell = next;
  }
  return false;
}

template <int A>
bool PatchSearch<A>::met_by(const Bounds& bounds) const {
  std::vector<std::size_t> stack{0};
  while (!stack.empty()) {
    const std::size_t me = stack.back();
    stack.pop_back();
    const Node& node = tree_[me];
    if (!node.bounds.meets(bounds)) continue;
    if (node.right == 0) return true;
    stack.push_back(node.right);
    stack.push_back(me + 1);
  }
  return false;
}

template <int A>
void PatchSearch<A>::mark_shared(const std::vector<PatchSearch>& all) {
  for (const auto& node : tree_) {
    if (node.right != 0) continue;
    for (const auto& other : all) {
      if (&other == this || !other.met_by(node.bounds)) continue;
      for_each(node, [&](const Index& index) { flag_[at(index)] |= is_shared; });
      break;
    }
  }
}

template class PatchSearch<2>;
template class PatchSearch<3>;

}  // namespace littoral::coupler
