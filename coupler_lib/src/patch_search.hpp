#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "littoral/coupler/fields.hpp"
#include "multilinear.hpp"

namespace littoral::coupler {

/// A dual cell that can serve a point, and how well.
template <int A>
struct Candidate {
  enum class Kind { inside, fitted, extrapolated, none };  // best first
  Kind kind = Kind::none;
  int low_faces = 0;     // faces of the dual cell the point lies on that belong to a neighbour below
  double outside = 0.0;  // [cells] how far beyond the dual cell (extrapolated)
  double measure = std::numeric_limits<double>::infinity();  // its area or volume: the finer wins
  std::size_t cell = 0;                                      // lower corner, index in the patch
  std::array<double, A> xi{};

  bool better_than(const Candidate& other) const {
    if (kind != other.kind) return kind < other.kind;
    if (low_faces != other.low_faces) return low_faces < other.low_faces;
    if (kind == Kind::extrapolated && outside != other.outside) return outside < other.outside;
    return measure < other.measure;
  }
};

/// The dual cells (cubes of neighbouring centres) of one structured patch with A extended directions, and a
/// tree of boxes over their index space. A dual cell is named by its lower corner.
template <int A>
class PatchSearch {
 public:
  using Map = Multilinear<A>;
  using Point = typename Map::Point;
  using Corners = typename Map::Corners;
  static constexpr std::size_t k_corners = Map::k_corners;

  /// `axes`: the coordinates in play ((x, z) in the plane)
  PatchSearch(const DonorPatch& patch, const std::array<std::size_t, A>& axes, std::size_t offset);

  std::size_t offset() const { return offset_; }  ///< of the patch's first cell among all donors
  std::size_t size() const { return x_.size(); }
  Point project(const Vec3& x) const {
    Point point;
    for (std::size_t i = 0; i < A; ++i) point[i] = x[axes_[i]];
    return point;
  }

  /// Improves `best` with this patch's dual cells.
  void search(const Point& x, Candidate<A>& best) const;

  /// Walks from dual cell `start`; true if it ends in a complete dual cell around x that no other patch
  /// meets.
  bool walk(const Point& x, std::size_t start, Candidate<A>& found) const;

  /// Index of corner k of a dual cell, and whether it holds a state.
  std::size_t corner(std::size_t cell, std::size_t k) const { return cell + corner_offset_[k]; }
  bool usable(std::size_t cell) const { return usable_[cell] != 0; }
  Corners corners(std::size_t cell) const {
    Corners c;
    for (std::size_t k = 0; k < k_corners; ++k) c[k] = x_[corner(cell, k)];
    return c;
  }

  /// Marks dual cells that another patch may serve too.
  void mark_shared(const std::vector<PatchSearch>& all);

 private:
  using Index = std::array<int, A>;
  enum Flag : std::uint8_t { is_dual = 1, is_complete = 2, is_shared = 4, is_edge = 8 };
  struct Bounds {
    Point lower, upper;
    Bounds();
    void include(const Point& x);
    void include(const Bounds& other);
    void widen();  // by a little
    bool contains(const Point& x) const;
    bool meets(const Bounds& other) const;
  };
  struct Node {
    Bounds bounds;
    Index first, count;     // dual cells
    std::size_t right = 0;  // the left child follows its parent; 0: leaf
  };

  std::size_t at(const Index& index) const;
  bool complete_at(const Index& index) const;
  bool at_an_edge(const Index& index) const;  ///< complete, but not all around it
  Bounds reach(const Index& index) const;
  std::size_t build(const Index& first, const Index& count);
  void consider(const Point& x, std::size_t cell, Candidate<A>& best) const;
  bool met_by(const Bounds& bounds) const;
  template <class Visit>
  void for_each(const Node& node, const Visit& visit) const;

  std::array<std::size_t, A> axes_;
  std::size_t offset_;
  Index n_{};  // cells
  std::array<std::size_t, A> stride_{};
  std::array<std::size_t, k_corners> corner_offset_{};
  std::vector<Point> x_;
  std::vector<std::uint8_t> usable_, flag_;
  std::vector<Node> tree_;
};

}  // namespace littoral::coupler
