#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "coupling/compensated.hpp"
#include "coupling/face_element.hpp"

namespace littoral::sph {

/// Rows of the particles that enter through an upright outer face which the surface crosses.
enum class FaceRows {
  level,  ///< the water of each column of elements is divided evenly: rows rise and sink with the level
  fixed   ///< elements stay where they are, the surface cuts one of them: (19), as in the paper
};

/// Columns of elements of upright outer faces, and the rows that the water in each is divided into. An
/// element that the surface cuts makes whole particles at a fixed height, now and then: steps of a row that
/// the stream carries in. Instead the uppermost elements of a column are stretched to the level of the
/// moment, as many as their height is about a spacing; a particle is born with the mass of its row. Further
/// down rows stay where they are, as the water there does under waves.
template <int D>
class FaceColumns {
 public:
  /// elements: from the foot up, the tiles of a column whose edges are `edges` (one more of them)
  void add(std::vector<std::size_t> elements, std::vector<double> edges);
  bool empty() const { return columns_.empty(); }

  /// Whether an element may be stretched.
  bool moves(std::size_t e) const { return column_of_[e] != columns_.size(); }

  /// Where FV's phi is asked for: the centre of each tile, foot first, column by column.
  const std::vector<Point<D>>& probes() const { return probes_; }
  void set_probes(const std::vector<FaceElement<D>>& tiles);

  /// Stretches the elements of each column to the level that phi at the probes gives; known[k] 0: FV has no
  /// state there (air). A column in which water does not lie under air (dry at its foot, full, overturning)
  /// has its tiles back. What an element carries that has no row any more goes to the row on top.
  void follow(const std::vector<double>& phi, const std::vector<double>& known, double spacing,
              std::vector<FaceElement<D>>& elements, std::vector<Compensated>& mass);

  /// Element of the row at height z [m] in the column of element e; e itself where rows are its tiles.
  std::size_t at_height(std::size_t e, double z, const std::vector<FaceElement<D>>& elements) const;

  std::size_t size() const { return columns_.size(); }
  double rows(std::size_t c) const { return static_cast<double>(columns_[c].rows); }  ///< 0: the tiles
  void set_rows(std::size_t c, double rows) { columns_[c].rows = static_cast<std::size_t>(rows); }

 private:
  struct Column {
    std::vector<std::size_t> elements;
    std::vector<double> edges;  // [m] of the tiles
    std::size_t rows = 0;
    std::size_t first_probe = 0;
  };
  static std::optional<double> level_in(const Column& column, const double* phi, const double* known);
  static void divide(const Column& column, double level, double spacing,
                     std::vector<FaceElement<D>>& elements);
  static std::size_t first_moving(const Column& column);

  std::vector<Column> columns_;
  std::vector<Point<D>> probes_;
  std::vector<std::size_t> column_of_;  // of an element; size(): none
};

/// Rows of about a spacing that water of this depth [spacings] is divided into, if it was `before` rows (0:
/// none) so far: the number stays while a row's height is near enough to a spacing.
std::size_t rows_in(double depth, std::size_t before);

extern template class FaceColumns<2>;
extern template class FaceColumns<3>;

}  // namespace littoral::sph
