#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace littoral::sph {

/// An axis-aligned box of the particles' space [m]; lower > upper: empty.
template <int D>
struct RankBox {
  std::array<double, D> lower{};
  std::array<double, D> upper{};
};

/// Which rank owns which part of space: a box each, the outer ones without end, together all of space. Lower
/// faces belong to a box, upper ones do not. Boxes of a degenerate bisection (more ranks than particles) may
/// overlap: the lowest rank then owns the place.
template <int D>
class Regions {
 public:
  Regions() = default;
  explicit Regions(std::vector<RankBox<D>> boxes);

  std::size_t size() const { return boxes_.size(); }
  const RankBox<D>& operator[](std::size_t rank) const { return boxes_[rank]; }
  /// Rank that owns x. hint: tried first. A place in none of the boxes (there is none but NaN) stays with
  /// hint.
  std::size_t owner(const std::array<double, D>& x, std::size_t hint) const;

  std::vector<double> pack() const;  ///< (2 D size) for checkpoints
  static Regions unpack(const std::vector<double>& packed);

 private:
  bool holds(std::size_t rank, const std::array<double, D>& x) const;

  std::vector<RankBox<D>> boxes_;
  std::vector<char> overlapped_;  // by a lower rank
};

extern template class Regions<2>;
extern template class Regions<3>;

}  // namespace littoral::sph
