#include "grid/find_joins.hpp"

#include <map>

#include "boundary/exchange.hpp"
#include "grid/join_windows.hpp"
#include "grid/metrics.hpp"
#include "littoral/error.hpp"

namespace littoral::fv {
namespace {

/// Joined faces share their nodes to the bit: those of the lower block (face) win.
template <int D>
void share_nodes(std::vector<Block<D>>& blocks, const std::vector<FaceCell<D>>& faces) {
  for (int round = 0; round < D; ++round)  // a corner may have to travel around
    for (const FaceCell<D>& f : faces) {
      if (!f.match) continue;
      const FaceCell<D>& g = faces[f.match->face];
      if (&g >= &f) continue;
      for (unsigned corner = 0; corner < (1u << (D - 1)); ++corner) {
        const auto to = static_cast<std::size_t>(blocks[f.block].node_extent.at(corner_index(f, corner)));
        const auto from = static_cast<std::size_t>(
            blocks[g.block].node_extent.at(corner_index(g, corner_there(f, g, *f.match, corner))));
        for (std::size_t k = 0; k < D; ++k)
          blocks[f.block].node[k][to] = blocks[g.block].node[k][from] + f.match->offset[k];
      }
    }
}

/// Cuts the windows into rectangles of one join each; what is not met keeps its condition. out     one line a
/// join; problems of windows that are not met though they must be
template <int D>
std::vector<std::string> rebuild_windows(std::vector<Block<D>>& blocks, const std::vector<FaceCell<D>>& faces,
                                         std::string& problems) {
  std::vector<std::string> lines;
  std::map<std::pair<std::size_t, std::size_t>, std::vector<std::size_t>> of_window;
  for (std::size_t f = 0; f < faces.size(); ++f) of_window[{faces[f].block, faces[f].window}].push_back(f);
  std::vector<std::vector<Window<D>>> rebuilt(blocks.size());
  for (std::size_t b = 0; b < blocks.size(); ++b)
    for (std::size_t w = 0; w < blocks[b].windows.size(); ++w) {
      const auto found = of_window.find({b, w});
      if (found == of_window.end()) {
        rebuilt[b].push_back(blocks[b].windows[w]);
        continue;
      }
      for (Window<D>& piece : cut_window<D>(blocks[b].windows[w], faces, found->second)) {
        const bool joined = piece.condition == Condition::join && piece.join.upper != std::array<int, D>{};
        if (joined) {
          if (told_here<D>(b, piece)) lines.push_back(describe_join<D>(blocks, b, piece));
        } else if (piece.request.kind == JoinRequest<D>::Kind::required)
          problems += (problems.empty() ? "" : "\n") + complain_unmet<D>(blocks, b, piece);
        rebuilt[b].push_back(std::move(piece));
      }
    }
  for (std::size_t b = 0; b < blocks.size(); ++b) blocks[b].windows = std::move(rebuilt[b]);
  return lines;
}

/// A block that meets itself, whole face to whole opposite face and the same way round, is a periodic one:
/// lines around it close on themselves.
template <int D>
void close_on_themselves(std::vector<Block<D>>& blocks) {
  for (std::size_t b = 0; b < blocks.size(); ++b)
    for (int d = 0; d < D; ++d) {
      std::vector<Window<D>*> pair;
      for (Window<D>& w : blocks[b].windows)
        if (w.direction == d) pair.push_back(&w);
      if (pair.size() != 2) continue;
      bool closes = true;
      for (const Window<D>* w : pair) {
        closes = closes && w->condition == Condition::join && w->join.block == b && w->join.direction == d &&
                 w->join.side != w->side;
        for (std::size_t k = 0; k < D; ++k)
          closes = closes && w->join.axis[k] == static_cast<int>(k) && !w->join.reversed[k] &&
                   (static_cast<int>(k) == d || w->join.lower[k] == w->lower[k]);
      }
      if (!closes) continue;
      blocks[b].periodic[static_cast<std::size_t>(d)] = true;
      for (Window<D>* w : pair) w->condition = Condition::periodic;
    }
}

}  // namespace

template <int D>
std::vector<std::string> find_joins(std::vector<Block<D>>& blocks) {
  const std::vector<FaceCell<D>> faces = match_faces(blocks);
  if (faces.empty()) return {};
  std::string problems;
  const std::vector<std::string> lines = rebuild_windows(blocks, faces, problems);
  if (!problems.empty()) throw ConfigError(problems);
  if (lines.empty()) return {};
  share_nodes(blocks, faces);
  close_on_themselves(blocks);
  for (auto& block : blocks) set_metrics(block);
  join_metrics(blocks);
  return lines;
}

template std::vector<std::string> find_joins(std::vector<Block<2>>&);
template std::vector<std::string> find_joins(std::vector<Block<3>>&);

}  // namespace littoral::fv
