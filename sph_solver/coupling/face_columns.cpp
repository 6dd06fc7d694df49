#include "coupling/face_columns.hpp"

#include <algorithm>
#include <cmath>

namespace littoral::sph {

namespace {

/// How far the depth may be from that of its rows at a spacing each before their number changes: a change
/// displaces all rows, so few are better; rows of 9/10 or 11/10 of a spacing are as good as whole ones.
constexpr double k_most_strain = 0.1;
constexpr double k_most_depth = 0.75;      // [spacings], of shallow water
constexpr std::size_t k_moving_rows = 12;  // share a change of the level among them

/// Particles lighter or heavier than this are not made, whatever the depth of a film [of a whole one].
constexpr double k_least_share = 0.5, k_most_share = 1.5;

}  // namespace

std::size_t rows_in(double depth, std::size_t before) {
  const auto rows = static_cast<double>(before),
             moving = static_cast<double>(std::min(before, k_moving_rows));
  const double most = std::max(k_most_depth, k_most_strain * moving);
  if (before > 0 && std::fabs(depth - rows) <= most) return before;
  return static_cast<std::size_t>(std::max(1.0, std::round(depth)));
}

template <int D>
void FaceColumns<D>::add(std::vector<std::size_t> elements, std::vector<double> edges) {
  columns_.push_back({std::move(elements), std::move(edges), 0, 0});
}

template <int D>
void FaceColumns<D>::set_probes(const std::vector<FaceElement<D>>& tiles) {
  probes_.clear();
  column_of_.assign(tiles.size(), columns_.size());
  for (std::size_t c = 0; c < columns_.size(); ++c) {
    columns_[c].first_probe = probes_.size();
    for (const std::size_t e : columns_[c].elements) {
      probes_.push_back(tiles[e].centre);
      column_of_[e] = c;
    }
  }
}

template <int D>
std::optional<double> FaceColumns<D>::level_in(const Column& column, const double* phi, const double* known) {
  const std::size_t n = column.elements.size();
  const auto wet = [&](std::size_t k) { return known[k] != 0.0 && phi[k] < 0.0; };
  const auto z = [&](std::size_t k) { return 0.5 * (column.edges[k] + column.edges[k + 1]); };
  std::size_t top = 0;
  while (top < n && wet(top)) ++top;
  if (top == 0) return std::nullopt;
  for (std::size_t k = top; k < n; ++k)
    if (wet(k)) return std::nullopt;
  const std::size_t below = top - 1;
  double slope = 1.0;  // of phi along z: that of a level surface where nothing better is known
  if (top < n && known[top] != 0.0)
    slope = (phi[top] - phi[below]) / (z(top) - z(below));
  else if (below > 0 && phi[below] > phi[below - 1])
    slope = (phi[below] - phi[below - 1]) / (z(below) - z(below - 1));
  const double level = z(below) - phi[below] / slope;
  if (top < n) return std::min(level, z(top));
  if (level < column.edges.back()) return level;
  return std::nullopt;  // full
}

template <int D>
std::size_t FaceColumns<D>::first_moving(const Column& column) {
  return column.rows > k_moving_rows ? column.rows - k_moving_rows : 0;
}

template <int D>
void FaceColumns<D>::divide(const Column& column, double level, double spacing,
                            std::vector<FaceElement<D>>& elements) {
  const std::size_t up = D - 1, first = column.rows == 0 ? column.elements.size() : first_moving(column);
  const double foot = column.edges[first];
  const double height = (level - foot) / static_cast<double>(std::max<std::size_t>(1, column.rows - first));
  for (std::size_t k = 0; k < column.elements.size(); ++k) {
    auto& element = elements[column.elements[k]];
    double width = 1.0;
    for (std::size_t d = 0; d < up; ++d)
      if (d != element.axis) width *= 2.0 * element.half[d];
    const bool moves = k >= first && k < column.rows;
    double extent = moves ? height : column.edges[k + 1] - column.edges[k];
    if (column.rows > 0 && k >= column.rows) extent = 0.0;  // in the air
    element.centre[up] = moves ? foot + (static_cast<double>(k - first) + 0.5) * height
                               : 0.5 * (column.edges[k] + column.edges[k + 1]);
    element.half[up] = 0.5 * extent;
    element.area = width * extent;
    element.stretched = column.rows > 0;
    element.share = moves ? std::clamp(height / spacing, k_least_share, k_most_share) : 1.0;
  }
}

template <int D>
void FaceColumns<D>::follow(const std::vector<double>& phi, const std::vector<double>& known, double spacing,
                            std::vector<FaceElement<D>>& elements, std::vector<Compensated>& mass) {
  for (Column& column : columns_) {
    const auto level = level_in(column, phi.data() + column.first_probe, known.data() + column.first_probe);
    if (!level && column.rows == 0) continue;  // they are the tiles
    const double foot = column.edges.front();
    column.rows =
        level ? std::min(column.elements.size(), rows_in((*level - foot) / spacing, column.rows)) : 0;
    divide(column, level.value_or(foot), spacing, elements);
    if (!level) continue;
    Compensated& top = mass[column.elements[column.rows - 1]];
    for (std::size_t k = column.rows; k < column.elements.size(); ++k) {
      Compensated& carried = mass[column.elements[k]];
      if (carried.value() == 0.0) continue;
      top += carried;
      carried = Compensated();
    }
  }
}

template <int D>
std::size_t FaceColumns<D>::at_height(std::size_t e, double z,
                                      const std::vector<FaceElement<D>>& elements) const {
  if (columns_.empty() || column_of_[e] == columns_.size()) return e;
  const Column& column = columns_[column_of_[e]];
  if (column.rows == 0) return e;
  const std::size_t first = first_moving(column);
  const double foot = column.edges[first];
  if (z < foot) {
    const auto above = std::upper_bound(column.edges.begin() + 1,
                                        column.edges.begin() + static_cast<std::ptrdiff_t>(first), z);
    return column.elements[static_cast<std::size_t>(above - column.edges.begin() - 1)];
  }
  const double height = 2.0 * elements[column.elements[first]].half[D - 1];
  const double last = static_cast<double>(column.rows - first - 1);
  return column
      .elements[first + static_cast<std::size_t>(std::clamp(std::floor((z - foot) / height), 0.0, last))];
}

template class FaceColumns<2>;
template class FaceColumns<3>;

}  // namespace littoral::sph
