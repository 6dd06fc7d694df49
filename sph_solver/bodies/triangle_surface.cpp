#include "bodies/triangle_surface.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <sstream>

#include "littoral/error.hpp"

namespace littoral::sph {
namespace {

constexpr std::size_t k_leaf = 4;     // triangles
constexpr double k_touching = 1e-12;  // of its extent: nearer than this a point is on the surface
// Triangles whose normals differ by less belong to one curved patch; cos 40 degrees: a prism of nine sides
// is round, one of eight has edges.
constexpr double k_cos_edge = 0.766;
constexpr double k_cos_flat = 1.0 - 1e-9;  // by no more than round-off of a file's coordinates

double square_distance(const std::array<Vector3, 2>& box, const Vector3& x) {
  double sum = 0.0;
  for (std::size_t d = 0; d < 3; ++d) {
    const double beyond = std::max({0.0, box[0][d] - x[d], x[d] - box[1][d]});
    sum += beyond * beyond;
  }
  return sum;
}

std::string text_of(const Vector3& x) {
  std::ostringstream text;
  text << "(" << x[0] << ", " << x[1] << ", " << x[2] << ")";
  return text.str();
}

/// The part of a triangle that a point is closest to: a face, an edge (from corner k to the next), a corner.
struct Feature {
  enum class Kind { face, edge, corner } kind;
  std::size_t k;
};

/// Closest point of the triangle a, b, c (Ericson, Real-Time Collision Detection, 2005, section 5.1.5).
Vector3 closest_on_triangle(const Vector3& a, const Vector3& b, const Vector3& c, const Vector3& x,
                            Feature& feature) {
  using Kind = Feature::Kind;
  const Vector3 ab = b - a, ac = c - a, ax = x - a, bx = x - b, cx = x - c;
  const double d1 = dot(ab, ax), d2 = dot(ac, ax), d3 = dot(ab, bx), d4 = dot(ac, bx), d5 = dot(ab, cx),
               d6 = dot(ac, cx);
  if (d1 <= 0.0 && d2 <= 0.0) return feature = {Kind::corner, 0}, a;
  if (d3 >= 0.0 && d4 <= d3) return feature = {Kind::corner, 1}, b;
  if (d6 >= 0.0 && d5 <= d6) return feature = {Kind::corner, 2}, c;
  const double vc = d1 * d4 - d3 * d2, vb = d5 * d2 - d1 * d6, va = d3 * d6 - d5 * d4;
  if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0) return feature = {Kind::edge, 0}, a + (d1 / (d1 - d3)) * ab;
  if (va <= 0.0 && d4 - d3 >= 0.0 && d5 - d6 >= 0.0)
    return feature = {Kind::edge, 1}, b + ((d4 - d3) / ((d4 - d3) + (d5 - d6))) * (c - b);
  if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0) return feature = {Kind::edge, 2}, a + (d2 / (d2 - d6)) * ac;
  feature = {Kind::face, 0};
  return a + (vb / (va + vb + vc)) * ab + (vc / (va + vb + vc)) * ac;
}

}  // namespace

struct TriangleSurface::Nearest {
  double square = std::numeric_limits<double>::infinity();
  Vector3 point{};
  Vector3 outward{};  // pseudonormal there
  bool on_face = false;
  int patch = -1;
};

TriangleSurface::TriangleSurface(const TriangleSoup& soup, const std::string& name) {
  for (std::size_t q = 0; q < soup.size(); ++q)
    for (const Vector3& x : soup[q])
      if (!std::isfinite(x[0] + x[1] + x[2]))
        throw ConfigError(name + ": triangle " + std::to_string(q + 1) + " has a corner " + text_of(x) +
                          ", which is not finite.");
  join(soup);
  if (triangles_.empty()) throw ConfigError(name + ": holds no triangle with an area.");
  check_edges(name);
  turn_outward();
  nodes_.push_back({{}, 0, triangles_.size(), 0});
  divide(0);
  bounds_ = nodes_[0].box;
  find_normals();
  find_patches();
}

void TriangleSurface::join(const TriangleSoup& soup) {
  std::map<Vector3, std::int32_t> known;
  for (const auto& three : soup) {
    Triangle triangle{};
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [place, fresh] = known.try_emplace(three[k], static_cast<std::int32_t>(corners_.size()));
      if (fresh) corners_.push_back(three[k]);
      triangle.corner[k] = place->second;
    }
    const auto& c = triangle.corner;
    if (c[0] != c[1] && c[1] != c[2] && c[2] != c[0]) triangles_.push_back(triangle);
  }
}

void TriangleSurface::check_edges(const std::string& name) {
  std::map<std::array<std::int32_t, 2>, int> uses;
  for (const auto& triangle : triangles_)
    for (std::size_t k = 0; k < 3; ++k) ++uses[{triangle.corner[k], triangle.corner[(k + 1) % 3]}];
  std::size_t open = 0, crowded = 0, twisted = 0;
  std::array<std::int32_t, 2> first{};
  for (const auto& [edge, n] : uses) {
    const auto back = uses.find({edge[1], edge[0]});
    const int total = n + (back == uses.end() ? 0 : back->second);
    if (total == 2 && n == 1) continue;
    if (open + crowded + twisted == 0) first = edge;
    ++(total == 1 ? open : total > 2 ? crowded : twisted);
  }
  if (open + crowded + twisted == 0) return;
  std::ostringstream text;
  text << name << ": is no closed surface:";
  if (open > 0) text << " " << open << " edges belong to one triangle only (a hole);";
  if (crowded > 0) text << " " << crowded << " edges belong to more than two triangles;";
  if (twisted > 0) text << " " << twisted << " edges join triangles of opposite orientation;";
  text << " the first from " << text_of(corners_[static_cast<std::size_t>(first[0])]) << " to "
       << text_of(corners_[static_cast<std::size_t>(first[1])])
       << ". Corners that meet must agree to the last digit. Mend it where it was made.";
  throw ConfigError(text.str());
}

void TriangleSurface::turn_outward() {
  double volume = 0.0;
  const auto corner = [&](const Triangle& t, std::size_t k) {
    return corners_[static_cast<std::size_t>(t.corner[k])] - corners_[0];
  };
  for (const auto& t : triangles_) volume += dot(corner(t, 0), cross(corner(t, 1), corner(t, 2)));
  if (volume >= 0.0) return;
  for (auto& t : triangles_) std::swap(t.corner[1], t.corner[2]);
}

void TriangleSurface::find_normals() {
  std::map<std::array<std::int32_t, 2>, Vector3> across;  // normal of the face with this directed edge
  at_corner_.assign(corners_.size(), {});
  for (auto& t : triangles_) {
    std::array<Vector3, 3> x;
    for (std::size_t k = 0; k < 3; ++k) x[k] = corners_[static_cast<std::size_t>(t.corner[k])];
    const Vector3 area = cross(x[1] - x[0], x[2] - x[0]);
    const double size = norm(area);
    if (size > 0.0) t.normal = (1.0 / size) * area;  // a sliver: its edges are those of its neighbours
    for (std::size_t k = 0; k < 3; ++k) {
      across[{t.corner[k], t.corner[(k + 1) % 3]}] = t.normal;
      const Vector3 p = x[(k + 1) % 3] - x[k], q = x[(k + 2) % 3] - x[k];
      const double angle = std::atan2(norm(cross(p, q)), dot(p, q));
      auto& sum = at_corner_[static_cast<std::size_t>(t.corner[k])];
      sum = sum + angle * t.normal;
    }
  }
  for (auto& t : triangles_)
    for (std::size_t k = 0; k < 3; ++k)
      t.at_edge[k] = t.normal + across.at({t.corner[(k + 1) % 3], t.corner[k]});
}

void TriangleSurface::find_patches() {
  std::map<std::array<std::int32_t, 2>, std::size_t> owner;  // triangle with this directed edge
  for (std::size_t q = 0; q < triangles_.size(); ++q) {
    const auto& corner = triangles_[q].corner;
    for (std::size_t k = 0; k < 3; ++k) owner[{corner[k], corner[(k + 1) % 3]}] = q;
    triangles_[q].patch = -1;
  }
  std::vector<char> seen(triangles_.size(), 0);
  std::int32_t n_patches = 0;
  for (std::size_t first = 0; first < triangles_.size(); ++first) {
    if (seen[first]) continue;
    seen[first] = 1;
    std::vector<std::size_t> members = {first};
    bool curved = false;
    for (std::size_t m = 0; m < members.size(); ++m) {
      const Triangle& here = triangles_[members[m]];
      for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t next = owner.at({here.corner[(k + 1) % 3], here.corner[k]});
        const double cosine = dot(here.normal, triangles_[next].normal);
        if (seen[next] || cosine < k_cos_edge) continue;
        seen[next] = 1;
        members.push_back(next);
        curved = curved || cosine < k_cos_flat;
      }
    }
    if (!curved) continue;
    for (const std::size_t q : members) triangles_[q].patch = n_patches;
    ++n_patches;
  }
}

void TriangleSurface::divide(std::size_t node) {
  constexpr double inf = std::numeric_limits<double>::infinity();
  const std::size_t begin = nodes_[node].begin, end = nodes_[node].end;
  const auto corner = [&](const Triangle& t, std::size_t k) -> const Vector3& {
    return corners_[static_cast<std::size_t>(t.corner[k])];
  };
  std::array<Vector3, 2> box = {{{inf, inf, inf}, {-inf, -inf, -inf}}};
  for (std::size_t q = begin; q < end; ++q)
    for (std::size_t k = 0; k < 3; ++k)
      for (std::size_t d = 0; d < 3; ++d) {
        box[0][d] = std::min(box[0][d], corner(triangles_[q], k)[d]);
        box[1][d] = std::max(box[1][d], corner(triangles_[q], k)[d]);
      }
  nodes_[node].box = box;
  if (end - begin <= k_leaf) return;
  const Vector3 extent = box[1] - box[0];
  const auto axis = static_cast<std::size_t>(std::max_element(extent.begin(), extent.end()) - extent.begin());
  const std::size_t middle = begin + (end - begin) / 2;
  const auto centre = [&](const Triangle& t) {
    return corner(t, 0)[axis] + corner(t, 1)[axis] + corner(t, 2)[axis];
  };
  const auto first = triangles_.begin();
  std::nth_element(first + static_cast<std::ptrdiff_t>(begin), first + static_cast<std::ptrdiff_t>(middle),
                   first + static_cast<std::ptrdiff_t>(end),
                   [&](const Triangle& a, const Triangle& b) { return centre(a) < centre(b); });
  const std::size_t children = nodes_.size();
  nodes_[node].children = children;
  nodes_.push_back({{}, begin, middle, 0});
  nodes_.push_back({{}, middle, end, 0});
  divide(children);
  divide(children + 1);
}

void TriangleSurface::compare(std::size_t triangle, const Vector3& x, Nearest& best) const {
  const Triangle& t = triangles_[triangle];
  std::array<Vector3, 3> c;
  for (std::size_t k = 0; k < 3; ++k) c[k] = corners_[static_cast<std::size_t>(t.corner[k])];
  Feature feature{};
  const Vector3 point = closest_on_triangle(c[0], c[1], c[2], x, feature);
  const double square = dot(x - point, x - point);
  if (square >= best.square || dot(t.normal, t.normal) == 0.0) return;
  best.square = square;
  best.patch = t.patch;
  best.point = point;
  best.on_face = feature.kind == Feature::Kind::face;
  best.outward = feature.kind == Feature::Kind::face ? t.normal
                 : feature.kind == Feature::Kind::edge
                     ? t.at_edge[feature.k]
                     : at_corner_[static_cast<std::size_t>(t.corner[feature.k])];
}

void TriangleSurface::search(std::size_t node, const Vector3& x, Nearest& best) const {
  const Node& here = nodes_[node];
  if (here.children == 0) {
    for (std::size_t q = here.begin; q < here.end; ++q) compare(q, x, best);
    return;
  }
  std::array<std::size_t, 2> order = {here.children, here.children + 1};
  std::array<double, 2> square = {square_distance(nodes_[order[0]].box, x),
                                  square_distance(nodes_[order[1]].box, x)};
  if (square[1] < square[0]) {
    std::swap(order[0], order[1]);
    std::swap(square[0], square[1]);
  }
  for (std::size_t k = 0; k < 2; ++k)
    if (square[k] < best.square) search(order[k], x, best);
}

SurfacePoint TriangleSurface::closest(const Vector3& x) const {
  Nearest best;
  search(0, x, best);
  const double r = std::sqrt(best.square), sign = dot(x - best.point, best.outward) < 0.0 ? -1.0 : 1.0;
  const bool along_the_line = !best.on_face && r > k_touching * norm(bounds_[1] - bounds_[0]);
  const Vector3 normal =
      along_the_line ? (sign / r) * (x - best.point) : (1.0 / norm(best.outward)) * best.outward;
  return {best.point, normal, sign * r, best.patch};
}

}  // namespace littoral::sph
