#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "bodies/shape.hpp"

namespace littoral::sph {

/// Corners of a surface's triangles, three and three; as a file holds them.
using TriangleSoup = std::vector<std::array<Vector3, 3>>;

/// A closed surface of triangles. The side a point is on follows from the angle-weighted normals at the face,
/// edge or corner closest to it (Baerentzen & Aanaes 2005), which is right for every closed surface that does
/// not cut itself.
class TriangleSurface {
 public:
  /// Joins corners that agree to the last digit, leaves out triangles without area, turns all normals
  /// outward. throws ConfigError, with `name`: a corner that is not finite, an edge without a second
  /// triangle, with more than two, or with two that run the same way
  TriangleSurface(const TriangleSoup& soup, const std::string& name);

  SurfacePoint closest(const Vector3& x) const;
  const std::array<Vector3, 2>& bounds() const { return bounds_; }
  std::size_t size() const { return triangles_.size(); }

 private:
  struct Triangle {
    std::array<std::int32_t, 3> corner;
    Vector3 normal;                  // unit
    std::array<Vector3, 3> at_edge;  // sum of both faces' normals; edge k: corner k to the next
    std::int32_t patch;              // as SurfacePoint has it
  };
  /// A box around a range of triangles; its halves are the nodes first and first + 1, or it is a leaf.
  struct Node {
    std::array<Vector3, 2> box;
    std::size_t begin, end, children;
  };
  struct Nearest;

  void join(const TriangleSoup& soup);
  void check_edges(const std::string& name);
  void turn_outward();
  void find_normals();
  void find_patches();
  void divide(std::size_t node);
  void search(std::size_t node, const Vector3& x, Nearest& best) const;
  void compare(std::size_t triangle, const Vector3& x, Nearest& best) const;

  std::vector<Vector3> corners_, at_corner_;
  std::vector<Triangle> triangles_;
  std::vector<Node> nodes_;
  std::array<Vector3, 2> bounds_;
};

}  // namespace littoral::sph
