#include "overset/assembly.hpp"

#include <algorithm>
#include <cstdio>
#include <set>

#include "boundary/links.hpp"
#include "grid/between.hpp"
#include "grid/loops.hpp"
#include "grid/metrics.hpp"
#include "grid/space.hpp"
#include "littoral/error.hpp"
#include "overset/components.hpp"
#include "overset/layers.hpp"
#include "overset/wall_side.hpp"

namespace littoral::fv {
namespace {

template <int D>
bool any_overset(const Block<D>& block) {
  return std::any_of(block.windows.begin(), block.windows.end(),
                     [](const Window<D>& w) { return w.condition == Condition::overset; });
}

/// Layer 0 at the overset windows.
template <int D>
void mark_fronts(const std::vector<Block<D>>& blocks, Layers<D>& depth) {
  for (std::size_t b = 0; b < blocks.size(); ++b)
    for (const Window<D>& window : blocks[b].windows) {
      if (window.condition != Condition::overset) continue;
      const auto d = static_cast<std::size_t>(window.direction);
      auto lower = window.lower, upper = window.upper;
      lower[d] = window.side == 0 ? 0 : blocks[b].extent.n[d] - 1;
      upper[d] = lower[d] + 1;
      for_each_index<D>(lower, upper, [&](const std::array<int, D>& index) {
        depth.set(b, blocks[b].extent.at(index), 0);
      });
    }
}

template <int D>
class Assembler {
 public:
  Assembler(std::vector<Block<D>>& blocks, const OversetOptions& options)
      : blocks_(blocks),
        options_(options),
        sources_(ghost_sources(blocks)),
        component_(components(blocks)),
        depth_(blocks, sources_),
        hole_(blocks.size()) {
    for (const std::size_t c : component_) n_components_ = std::max(n_components_, c + 1);
    for (std::size_t b = 0; b < blocks.size(); ++b) hole_[b].assign(blocks[b].extent.size, 0);
    mark_fronts(blocks_, depth_);
    depth_.spread(options.fringe_layers + options.overlap, [](std::size_t, std::ptrdiff_t) { return true; });
  }

  OversetAssembly<D> assemble() {
    for (std::size_t c = n_components_; c-- > 0;) cut(c);  // from the top: holes of those above are known
    set_statuses();
    OversetAssembly<D> result;
    find_links(result);
    for (std::size_t c = 0; c < n_components_; ++c) share_out(c);
    describe(result);
    note_one_way(result);
    return result;
  }

 private:
  bool at_front(std::size_t b, std::ptrdiff_t cell, int layers) const {
    const int depth = depth_.at(b, cell);
    return depth != Layers<D>::k_none && depth < layers;
  }

  std::vector<OverlapBlock<D>> overlap_blocks(int layers) const {
    std::vector<OverlapBlock<D>> all;
    for (std::size_t b = 0; b < blocks_.size(); ++b) {
      const Block<D>& block = blocks_[b];
      OverlapBlock<D> one{&block.extent, &block.centre, {}, component_[b]};
      one.usable.assign(block.extent.size, 0);
      for_each_index<D>({}, block.extent.n, [&](const std::array<int, D>& index) {
        const std::ptrdiff_t c = block.extent.at(index);
        const auto at = static_cast<std::size_t>(c);
        const bool solved =
            block.status[at] == CellStatus::computed || block.status[at] == CellStatus::forced;
        one.usable[at] = solved && !hole_[b][at] && !at_front(b, c, layers);
      });
      all.push_back(std::move(one));
    }
    return all;
  }

  std::vector<std::size_t> blocks_of(std::size_t component) const {
    std::vector<std::size_t> which;
    for (std::size_t b = 0; b < blocks_.size(); ++b)
      if (component_[b] == component) which.push_back(b);
    return which;
  }

  /// Holes of one component: under those above it, and behind the walls of all others.
  void cut(std::size_t component) {
    std::vector<CellName<D>> cell;
    std::vector<std::array<double, D>> place;
    for (const std::size_t b : blocks_of(component))
      for_each_index<D>({}, blocks_[b].extent.n, [&](const std::array<int, D>& index) {
        cell.push_back({b, blocks_[b].extent.at(index)});
        place.push_back(centre<D>(blocks_[b], cell.back().cell));
      });
    const auto mark = [&](std::size_t i) {
      hole_[cell[i].block][static_cast<std::size_t>(cell[i].cell)] = 1;
    };
    std::vector<std::size_t> above;
    for (std::size_t c = component + 1; c < n_components_; ++c)
      for (const std::size_t b : blocks_of(c)) above.push_back(b);
    std::vector<std::uint8_t> is_covered(place.size(), 0);
    if (!above.empty()) {
      const auto upper = overlap_blocks(options_.fringe_layers + options_.overlap);
      is_covered = covered<D>(upper, sources_, above, place);
    }
    for (std::size_t i = 0; i < place.size(); ++i)
      if (is_covered[i]) mark(i);
    for (std::size_t c = 0; c < n_components_; ++c) {
      if (c == component) continue;
      const WallSide<D> walls(blocks_, blocks_of(c));
      if (walls.empty()) continue;
#pragma omp parallel for schedule(dynamic, 256)
      for (std::size_t i = 0; i < place.size(); ++i)
        if (!is_covered[i] && walls.behind(place[i])) mark(i);
    }
  }

  void set_statuses() {
    Layers<D> layer(blocks_, sources_);
    for (std::size_t b = 0; b < blocks_.size(); ++b)
      for_each_index<D>({}, blocks_[b].extent.n, [&](const std::array<int, D>& index) {
        const std::ptrdiff_t c = blocks_[b].extent.at(index);
        const auto at = static_cast<std::size_t>(c);
        if (!hole_[b][at] && !at_front(b, c, options_.fringe_layers) &&
            blocks_[b].status[at] != CellStatus::blanked)
          layer.set(b, c, 0);
      });
    layer.spread(options_.fringe_layers, [](std::size_t, std::ptrdiff_t) { return true; });
    for (std::size_t b = 0; b < blocks_.size(); ++b) {
      Block<D>& block = blocks_[b];
      for_each_index<D>({}, block.extent.n, [&](const std::array<int, D>& index) {
        const std::ptrdiff_t c = block.extent.at(index);
        const int of = layer.at(b, c);
        if (of == 0) return;
        block.status[static_cast<std::size_t>(c)] =
            of == Layers<D>::k_none ? CellStatus::blanked : CellStatus::interpolated;
      });
      set_solved_mask(block);
    }
  }

  void find_links(OversetAssembly<D>& result) {
    std::vector<CellName<D>> receivers, orphans;
    for (std::size_t b = 0; b < blocks_.size(); ++b)
      for_each_index<D>({}, blocks_[b].extent.n, [&](const std::array<int, D>& index) {
        const std::ptrdiff_t c = blocks_[b].extent.at(index);
        const CellStatus status = blocks_[b].status[static_cast<std::size_t>(c)];
        if (status == CellStatus::interpolated) receivers.push_back({b, c});
        if (status == CellStatus::blanked) ++result.n_blanked;
      });
    hole_.assign(blocks_.size(), {});  // statuses say it all from here on
    for (std::size_t b = 0; b < blocks_.size(); ++b) hole_[b].assign(blocks_[b].extent.size, 0);
    result.links = find_donors<D>(overlap_blocks(0), sources_, receivers, false, orphans);
    if (!orphans.empty()) complain(orphans);
    result.n_interpolated = static_cast<long>(receivers.size());
  }

  /// What a component counts of its cells. The region of a component above others is what its solved cells
  /// can interpolate; a place belongs to the highest component whose region it lies in, so no volume is
  /// counted twice or not at all. Cells that the edge of a region crosses are sampled. post find_links
  void share_out(std::size_t component) {
    const std::vector<std::size_t> own = blocks_of(component);
    std::vector<std::size_t> above;
    for (std::size_t c = component + 1; c < n_components_; ++c)
      for (const std::size_t b : blocks_of(c)) above.push_back(b);
    const bool lies_over =
        std::any_of(own.begin(), own.end(), [&](std::size_t b) { return any_overset(blocks_[b]); });
    const std::vector<OverlapBlock<D>> solved = overlap_blocks(0);
    const auto mine = [&](const std::vector<std::array<double, D>>& place) {
      std::vector<std::uint8_t> is(place.size(), 1);
      if (lies_over) is = covered<D>(solved, sources_, own, place);
      if (above.empty()) return is;
      const auto theirs = covered<D>(solved, sources_, above, place);
      for (std::size_t i = 0; i < is.size(); ++i) is[i] = is[i] != 0 && theirs[i] == 0 ? 1 : 0;
      return is;
    };
    std::vector<CellName<D>> cell;
    std::vector<std::array<double, D>> place;
    for (const std::size_t b : own) {
      blocks_[b].counted.assign(blocks_[b].extent.size, 0.0);
      for_each_index<D>({}, blocks_[b].extent.n, [&](const std::array<int, D>& index) {
        const std::ptrdiff_t c = blocks_[b].extent.at(index);
        if (blocks_[b].status[static_cast<std::size_t>(c)] == CellStatus::blanked) return;
        cell.push_back({b, c});
        place.push_back(centre<D>(blocks_[b], c));
      });
    }
    // deep inside its own grid a cell is counted even beside a wall, whose half cell nobody can interpolate
    const auto deep = [&](const CellName<D>& name) {
      return !at_front(name.block, name.cell, options_.fringe_layers + 1);
    };
    std::vector<std::uint8_t> in = mine(place);
    if (above.empty())
      for (std::size_t i = 0; i < cell.size(); ++i)
        if (deep(cell[i])) in[i] = 1;
    Layers<D> from_in(blocks_, sources_), from_out(blocks_, sources_);
    for (std::size_t i = 0; i < cell.size(); ++i) {
      blocks_[cell[i].block].counted[static_cast<std::size_t>(cell[i].cell)] = in[i];
      (in[i] != 0 ? from_in : from_out).set(cell[i].block, cell[i].cell, 0);
    }
    for (Layers<D>* layers : {&from_in, &from_out})
      layers->spread(1, [](std::size_t, std::ptrdiff_t) { return true; });
    std::vector<CellName<D>> crossed;
    place.clear();
    for (std::size_t i = 0; i < cell.size(); ++i) {
      const auto& [b, c] = cell[i];
      if ((in[i] != 0 ? from_out : from_in).at(b, c) != 1 || (above.empty() && deep(cell[i]))) continue;
      crossed.push_back(cell[i]);
      add_samples(blocks_[b], c, place);
    }
    if (crossed.empty()) return;
    const std::vector<std::uint8_t> sample = mine(place);
    const std::size_t per_cell = sample.size() / crossed.size();
    for (std::size_t i = 0; i < crossed.size(); ++i) {
      double& share = blocks_[crossed[i].block].counted[static_cast<std::size_t>(crossed[i].cell)];
      share = 0.0;
      for (std::size_t s = 0; s < per_cell; ++s)
        share += static_cast<double>(sample[i * per_cell + s]) / static_cast<double>(per_cell);
    }
  }

  /// Places spread evenly over a cell, the same number for each.
  static void add_samples(const Block<D>& block, std::ptrdiff_t c,
                          std::vector<std::array<double, D>>& place) {
    constexpr int k_a_direction = D == 2 ? 8 : 4;
    const std::ptrdiff_t n = block.node_extent.at(block.extent.index(c));
    std::array<int, D> count;
    count.fill(k_a_direction);
    for_each_index<D>({}, count, [&](const std::array<int, D>& index) {
      std::array<double, D> x{};
      for (std::size_t corner = 0; corner < (1u << D); ++corner) {
        std::ptrdiff_t m = n;
        double weight = 1.0;
        for (std::size_t d = 0; d < D; ++d) {
          const double along = (index[d] + 0.5) / k_a_direction;
          const bool upper = (corner >> d) & 1;
          m += upper ? block.node_extent.stride[d] : 0;
          weight *= upper ? along : 1.0 - along;
        }
        for (std::size_t k = 0; k < D; ++k) x[k] += weight * block.node[k][static_cast<std::size_t>(m)];
      }
      place.push_back(x);
    });
  }

  [[noreturn]] void complain(const std::vector<CellName<D>>& orphans) const {
    constexpr std::size_t k_named = 5;
    std::string text = "overset: " + std::to_string(orphans.size()) +
                       " cells must take their values from another grid, but no solved cells of one are "
                       "around them (orphans):";
    for (std::size_t i = 0; i < std::min(k_named, orphans.size()); ++i) {
      const Block<D>& block = blocks_[orphans[i].block];
      const coupler::Vec3 x = centre_in_space(block, orphans[i].cell);
      char line[160];
      std::snprintf(line, sizeof line, "\n  block '%s' at (%.6g, %.6g, %.6g) m", block.name.c_str(), x[0],
                    x[1], x[2]);
      text += line;
    }
    if (orphans.size() > k_named) text += "\n  ...";
    text += "\nLet the grids overlap by more cells (each needs fringe and overlap, " +
            std::to_string(2 * options_.fringe_layers + options_.overlap) +
            " at least, of about equal size), refine the grid below, or make overset.overlap smaller.";
    throw ConfigError(text);
  }

  /// Where the grids below have no hole, values pass upwards only: they do not know of what lies over them.
  /// throws ConfigError where that is a wall
  void note_one_way(OversetAssembly<D>& result) const {
    for (std::size_t c = 1; c < n_components_; ++c) {
      bool lies_over = false, has_walls = false, seen = false;
      std::string name;
      for (const std::size_t b : blocks_of(c)) {
        name = blocks_[b].name;
        lies_over = lies_over || any_overset(blocks_[b]);
        for (const Window<D>& w : blocks_[b].windows)
          has_walls = has_walls || w.condition == Condition::wall || w.condition == Condition::slip;
      }
      for (std::size_t b = 0; b < blocks_.size(); ++b)
        seen = seen || (component_[b] < c &&
                        std::any_of(blocks_[b].status.begin(), blocks_[b].status.end(), [](CellStatus s) {
                          return s == CellStatus::interpolated || s == CellStatus::blanked;
                        }));
      if (!lies_over || seen) continue;
      const std::string text =
          "overset: the grids below '" + name +
          "' take no value from it: their cells are too wide for a hole under its solved part";
      if (has_walls)
        throw ConfigError(text +
                          ", so they would not know of its walls; refine them there, or make it larger");
      result.notes.push_back("warning: " + text);
    }
  }

  void describe(OversetAssembly<D>& result) const {
    for (std::size_t c = 0; c < n_components_; ++c) {
      std::array<long, 3> count{};
      std::string names;
      for (const std::size_t b : blocks_of(c)) {
        names += (names.empty() ? "'" : ", '") + blocks_[b].name + "'";
        for_each_index<D>({}, blocks_[b].extent.n, [&](const std::array<int, D>& index) {
          const auto at = static_cast<std::size_t>(blocks_[b].extent.at(index));
          if (blocks_[b].solved[at] != 0.0) ++count[0];
          if (blocks_[b].status[at] == CellStatus::interpolated) ++count[1];
          if (blocks_[b].status[at] == CellStatus::blanked) ++count[2];
        });
      }
      result.notes.push_back("overset: " + names + ": " + std::to_string(count[0]) + " cells solved, " +
                             std::to_string(count[1]) + " interpolated, " + std::to_string(count[2]) +
                             " blanked");
    }
  }

  std::vector<Block<D>>& blocks_;
  OversetOptions options_;
  GhostSources<D> sources_;
  std::vector<std::size_t> component_;
  std::size_t n_components_ = 0;
  Layers<D> depth_;  // of cells from their component's overset windows
  std::vector<std::vector<std::uint8_t>> hole_;
};

}  // namespace

template <int D>
std::vector<std::array<std::array<double, D>, D>> periods(const std::vector<Block<D>>& blocks) {
  std::vector<std::array<std::array<double, D>, D>> period;
  for (const Block<D>& block : blocks) {
    period.emplace_back();
    for (std::size_t d = 0; d < D; ++d) {
      if (!block.periodic[d]) continue;
      std::array<int, D> ghost{}, image{};
      ghost[d] = -1;
      image[d] = block.extent.n[d] - 1;
      const auto at = centre<D>(block, block.extent.at(ghost)),
                 from = centre<D>(block, block.extent.at(image));
      for (std::size_t k = 0; k < D; ++k) period.back()[d][k] = at[k] - from[k];
    }
  }
  return period;
}

template <int D>
GhostSources<D> ghost_sources(const std::vector<Block<D>>& blocks) {
  std::vector<Extent<D>> extents;
  std::vector<std::array<bool, D>> periodic;
  for (const Block<D>& block : blocks) {
    extents.push_back(block.extent);
    periodic.push_back(block.periodic);
  }
  return GhostSources<D>(extents, periodic, periods(blocks), join_sides(blocks));
}

template <int D>
OversetAssembly<D> assemble_overset(std::vector<Block<D>>& blocks, const OversetOptions& options) {
  if (std::none_of(blocks.begin(), blocks.end(), [](const Block<D>& b) { return any_overset(b); })) return {};
  return Assembler<D>(blocks, options).assemble();
}

template std::vector<std::array<std::array<double, 2>, 2>> periods<2>(const std::vector<Block<2>>&);
template std::vector<std::array<std::array<double, 3>, 3>> periods<3>(const std::vector<Block<3>>&);
template GhostSources<2> ghost_sources<2>(const std::vector<Block<2>>&);
template GhostSources<3> ghost_sources<3>(const std::vector<Block<3>>&);
template OversetAssembly<2> assemble_overset<2>(std::vector<Block<2>>&, const OversetOptions&);
template OversetAssembly<3> assemble_overset<3>(std::vector<Block<3>>&, const OversetOptions&);

}  // namespace littoral::fv
