#include "grid/quality.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "boundary/links.hpp"
#include "grid/loops.hpp"
#include "grid/metrics.hpp"

namespace littoral::fv {
namespace {

template <int D>
void keep_larger(Worst<D>& worst, double value, const std::array<int, D>& cell) {
  if (value > worst.value) worst = {value, cell};
}

template <int D>
std::string at(const std::array<int, D>& cell) {
  std::string text;
  for (std::size_t d = 0; d < D; ++d) text += (d ? "," : " (") + std::to_string(cell[d]);
  return text + ")";
}

template <class... Values>
std::string format(const char* pattern, Values... values) {
  char text[256];
  std::snprintf(text, sizeof text, pattern, values...);
  return text;
}

/// The join that cuts the thinnest cells, if that is worth a word.
template <int D>
std::string stiffest_cut(const std::vector<Block<D>>& blocks) {
  double worst = 0.0;
  std::string where;
  for (const JoinSide<D>& side : join_sides(blocks)) {
    const Block<D>& block = blocks[side.block];
    const auto n = static_cast<std::size_t>(side.direction);
    std::array<int, D> lower = side.lower, upper = side.upper;
    lower[n] = side.side == 0 ? 0 : block.extent.n[n] - 1;
    upper[n] = lower[n] + 1;
    for_each_index<D>(lower, upper, [&](const std::array<int, D>& index) {
      const auto c = static_cast<std::size_t>(block.extent.at(index));
      double thick = 0.0;
      for (std::size_t d = 0; d < D; ++d) thick = std::max(thick, thickness(block, d, c));
      if (thick / thickness(block, n, c) <= worst) return;
      worst = thick / thickness(block, n, c);
      where = "block '" + block.name + "', face " + face_name(block, side.direction, side.side);
    });
  }
  constexpr double k_stiff = 20.0;  // from there on smoothing that ends at the join costs inner cycles
  if (worst <= k_stiff) return {};
  return where +
         format(
             ": the join cuts cells %.3g times as wide as thick (the worst of all joins); lines of the "
             "smoother end there, so expect more inner cycles",
             worst);
}

}  // namespace

template <int D>
Quality<D> quality(const Block<D>& block) {
  Quality<D> q;
  q.smallest = std::numeric_limits<double>::infinity();
  for_each_index<D>({}, block.extent.n, [&](const std::array<int, D>& index) {
    const auto c = static_cast<std::size_t>(block.extent.at(index));
    q.smallest = std::min(q.smallest, block.volume[c]);
    q.largest = std::max(q.largest, block.volume[c]);
    double thin = std::numeric_limits<double>::infinity(), thick = 0.0;
    for (std::size_t d = 0; d < D; ++d) {
      const double h = thickness(block, d, c);
      thin = std::min(thin, h);
      thick = std::max(thick, h);
      // ghosts mirror the cell itself or are the other block's cells: neighbours on either side count
      const std::size_t low = c - static_cast<std::size_t>(block.extent.stride[d]);
      const double below = thickness(block, d, low);
      if (h > 0.0 && below > 0.0) keep_larger<D>(q.stretching, std::max(h / below, below / h), index);
      double along = 0.0, length2 = 0.0;
      for (std::size_t k = 0; k < D; ++k) {
        const double e = block.centre[k][c] - block.centre[k][low];
        along += e * block.area[d][k][c];
        length2 += e * e;
      }
      const double s = face_measure(block, d, c);
      if (s > 0.0 && length2 > 0.0)
        keep_larger<D>(q.skewness,
                       std::acos(std::clamp(along / (s * std::sqrt(length2)), -1.0, 1.0)) * 180.0 / M_PI,
                       index);
    }
    if (thin > 0.0) keep_larger<D>(q.aspect, thick / thin, index);
  });
  return q;
}

template <int D>
std::vector<std::string> quality_report(const std::vector<Block<D>>& blocks) {
  std::vector<std::string> lines;
  for (const Block<D>& block : blocks) {
    const Quality<D> q = quality(block);
    std::string cells;
    for (std::size_t d = 0; d < D; ++d) cells += (d ? " x " : "") + std::to_string(block.extent.n[d]);
    lines.push_back("block '" + block.name + "': " + cells +
                    format(" cells, volumes %.3g to %.3g m^%d, skewness up to %.0f degrees", q.smallest,
                           q.largest, D, q.skewness.value) +
                    at<D>(q.skewness.cell) + format(", stretching %.3g", q.stretching.value) +
                    at<D>(q.stretching.cell) + format(", aspect %.3g", q.aspect.value) +
                    at<D>(q.aspect.cell));
  }
  const std::string cut = stiffest_cut(blocks);
  if (!cut.empty()) lines.push_back(cut);
  return lines;
}

template Quality<2> quality<2>(const Block<2>&);
template Quality<3> quality<3>(const Block<3>&);
template std::vector<std::string> quality_report<2>(const std::vector<Block<2>>&);
template std::vector<std::string> quality_report<3>(const std::vector<Block<3>>&);

}  // namespace littoral::fv
