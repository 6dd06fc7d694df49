#include "clip.hpp"

#include <algorithm>
#include <limits>

namespace littoral::coupler {

namespace {

constexpr double k_inf = std::numeric_limits<double>::infinity();

Box inside_out() { return {{k_inf, k_inf, k_inf}, {-k_inf, -k_inf, -k_inf}}; }

void include(Box& box, const Vec3& x) {
  for (std::size_t d = 0; d < 3; ++d) {
    box.lower[d] = std::min(box.lower[d], x[d]);
    box.upper[d] = std::max(box.upper[d], x[d]);
  }
}

/// Visits each dual cell: its lower corner's indices and the box it serves.
template <class Visit>
void for_each_dual_cell(const DonorPatch& patch, const Visit& visit) {
  const auto& n = patch.n;
  if (patch.size() == 0) return;
  const auto cells = [](int count) { return std::max(1, count - 1); };  // a thin direction has one layer
  const bool planar = n[0] == 1 || n[1] == 1 || n[2] == 1;
  for (int k = 0; k < cells(n[2]); ++k)
    for (int j = 0; j < cells(n[1]); ++j)
      for (int i = 0; i < cells(n[0]); ++i) {
        Box box = inside_out();
        for (int corner = 0; corner < 8; ++corner) {
          const int a = std::min(i + (corner & 1), n[0] - 1), b = std::min(j + (corner >> 1 & 1), n[1] - 1),
                    c = std::min(k + (corner >> 2), n[2] - 1);
          const auto at =
              static_cast<std::size_t>(a) +
              static_cast<std::size_t>(n[0]) * (static_cast<std::size_t>(b) +
                                                static_cast<std::size_t>(n[1]) * static_cast<std::size_t>(c));
          include(box, {patch.x[at], patch.y[at], patch.z[at]});
        }
        for (std::size_t d = 0; d < 3; ++d) {
          const double extent = box.upper[d] - box.lower[d];
          const double margin = planar && extent == 0.0 ? k_inf : 0.51 * extent;
          box.lower[d] -= margin;
          box.upper[d] += margin;
        }
        visit(std::array<int, 3>{i, j, k}, box);
      }
}

}  // namespace

Box reach(const DonorGeometry& geometry) {
  Box all = inside_out();
  for (const auto& patch : geometry.patches)
    for_each_dual_cell(patch, [&](const std::array<int, 3>&, const Box& box) {
      include(all, box.lower);
      include(all, box.upper);
    });
  return all.empty() ? Box::nothing() : all;
}

std::vector<Clip> clip(const DonorGeometry& geometry, const Box& needs) {
  std::vector<Clip> clips;
  for (std::size_t p = 0; p < geometry.patches.size(); ++p) {
    const auto& patch = geometry.patches[p];
    std::array<int, 3> low = patch.n, high{-1, -1, -1};
    for_each_dual_cell(patch, [&](const std::array<int, 3>& index, const Box& box) {
      if (!box.meets(needs)) return;
      for (std::size_t d = 0; d < 3; ++d) {
        low[d] = std::min(low[d], index[d]);
        high[d] = std::max(high[d], std::min(index[d] + 1, patch.n[d] - 1));
      }
    });
    if (high[0] < 0) continue;
    clips.push_back({p, low, {high[0] - low[0] + 1, high[1] - low[1] + 1, high[2] - low[2] + 1}});
  }
  return clips;
}

std::vector<Run> runs(const DonorGeometry& geometry, const std::vector<Clip>& clips) {
  std::vector<std::size_t> offset{0};
  for (const auto& patch : geometry.patches) offset.push_back(offset.back() + patch.size());
  std::vector<Run> result;
  for (const auto& c : clips) {
    const auto& n = geometry.patches[c.patch].n;
    for (int k = 0; k < c.n[2]; ++k)
      for (int j = 0; j < c.n[1]; ++j) {
        const auto row = static_cast<std::size_t>(c.first[1] + j) +
                         static_cast<std::size_t>(n[1]) * static_cast<std::size_t>(c.first[2] + k);
        const Run run{
            offset[c.patch] + static_cast<std::size_t>(c.first[0]) + static_cast<std::size_t>(n[0]) * row,
            static_cast<std::size_t>(c.n[0])};
        if (!result.empty() && result.back().first + result.back().n == run.first)
          result.back().n += run.n;
        else
          result.push_back(run);
      }
  }
  return result;
}

DonorGeometry clipped(const DonorGeometry& geometry, const std::vector<Clip>& clips) {
  DonorGeometry result;
  result.epoch = geometry.epoch;
  for (const auto& c : clips) {
    const auto& whole = geometry.patches[c.patch];
    DonorPatch part;
    part.n = c.n;
    const std::size_t row = static_cast<std::size_t>(whole.n[0]);
    for (int k = 0; k < c.n[2]; ++k)
      for (int j = 0; j < c.n[1]; ++j) {
        const std::size_t begin =
            static_cast<std::size_t>(c.first[0]) +
            row * (static_cast<std::size_t>(c.first[1] + j) +
                   static_cast<std::size_t>(whole.n[1]) * static_cast<std::size_t>(c.first[2] + k));
        const auto copy = [&](const auto& from, auto& to) {
          to.insert(to.end(), from.begin() + static_cast<std::ptrdiff_t>(begin),
                    from.begin() + static_cast<std::ptrdiff_t>(begin) + c.n[0]);
        };
        copy(whole.x, part.x);
        copy(whole.y, part.y);
        copy(whole.z, part.z);
        copy(whole.usable, part.usable);
      }
    result.patches.push_back(std::move(part));
  }
  return result;
}

Box around(const Targets& targets) {
  Box box = inside_out();
  for (std::size_t i = 0; i < targets.size(); ++i) include(box, {targets.x[i], targets.y[i], targets.z[i]});
  return targets.size() == 0 ? Box::nothing() : box;
}

std::vector<std::size_t> held_by(const Box& box, const Targets& targets) {
  std::vector<std::size_t> held;
  if (box.empty()) return held;
  for (std::size_t i = 0; i < targets.size(); ++i)
    if (box.contains({targets.x[i], targets.y[i], targets.z[i]})) held.push_back(i);
  return held;
}

}  // namespace littoral::coupler
