#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "bodies/body.hpp"
#include "boundary/domain_box.hpp"

namespace littoral::sph {

/// The lattice on which particles start: points at origin + (i + 1/2) spacing.
template <int D>
struct Lattice {
  std::array<double, D> origin{};  // [m]
  double spacing = 0.0;            // dx [m]
};

/// Particles that fill the bodies as deep as a kernel reaches behind their wet surface. They stand on the
/// lattice of the fluid's start, so that at first every lattice place is either water or body and no support
/// has gaps or overlaps, whatever the wall's slope; then they go with their body. Each knows the point of the
/// surface closest to it and the normal there. Where bodies overlap the deeper one has the dummy. A sheet has
/// two at each place next to it, inside no solid: one for the water on either side.
template <int D>
class Dummies {
 public:
  using Columns = std::array<std::vector<double>, D>;

  /// depth: of the filled layer behind the surface [m]
  Dummies(const std::vector<Body>& bodies, const DomainBox<D>& box, const Lattice<D>& lattice, double depth);

  /// Decides which dummies count where the bodies are now, and copies them beyond periodic sides and symmetry
  /// planes as far as `reach`. Those that stand beyond such a side themselves are represented by copies.
  void place(const std::vector<Body>& bodies, double reach);
  /// Positions, velocities and normals from the bodies' present state.
  void refresh(const std::vector<Body>& bodies);

  std::size_t size() const { return source_.size(); }  ///< with copies
  double volume() const { return volume_; }            ///< of each [m^D]
  /// Of which dummy of a body it is a copy, and the sign of that one's component along d in it.
  std::size_t n_sources() const { return made_.size(); }
  std::size_t source(std::size_t k) const { return static_cast<std::size_t>(source_[k]); }
  double sign(std::size_t k, std::size_t d) const { return sign_[k][d]; }
  /// A place seen from a copy, as its source sees it: the copy's body stands there.
  std::array<double, D> in_source(std::size_t k, std::array<double, D> point) const {
    for (std::size_t d = 0; d < D; ++d) point[d] = sign_[k][d] * (point[d] - offset_[k][d]);
    return point;
  }
  /// A direction in the scene, as it is in the image that a copy belongs to.
  std::array<double, D> turned(std::size_t k, const Vector3& direction) const {
    std::array<double, D> out{};
    for (std::size_t d = 0; d < D; ++d) out[d] = sign_[k][d] * direction[scene_axis<D>(d)];
    return out;
  }
  bool same_image(std::size_t k, std::size_t l) const {
    return sign_[k] == sign_[l] && offset_[k] == offset_[l];
  }
  bool on_sheet(std::size_t k) const {
    return !sheets_.empty() && sheets_[static_cast<std::size_t>(dummies_[k].body)].given;
  }
  /// Of the sheet that a dummy belongs to, the point closest to a given one.
  std::array<double, D> closest_on_sheet(std::size_t k, const std::array<double, D>& from) const;
  /// The side of its sheet from which a sheet's dummy is seen, +1 or -1.
  double front(std::size_t k) const { return -made_[source(k)].normal[2]; }

  using Vector = std::array<double, D>;
  /// Copies included; all of one next to each other in memory, as the loops over pairs read it.
  struct Dummy {
    Vector x;       // [m]
    Vector wall;    // [m] closest point of the surface
    Vector normal;  // there, out of the fluid
    Vector u, a;    // of the surface there [m/s, m/s^2]
    std::int32_t body;
    std::int32_t patch;  // of its body's surface, as SurfacePoint has it
  };
  const Dummy& operator[](std::size_t k) const { return dummies_[k]; }
  const Columns& x() const { return x_; }  ///< of all, as cells are filled with them

 private:
  struct Made {
    std::int32_t body;
    Vector3 place, wall, normal;  // in the body's frame
    std::int32_t patch;
  };
  /// Where a sheet is; given: the body is one.
  struct SheetPlace {
    bool given = false;
    Vector3 centre{};
    std::array<Vector3, 2> axis{};
    Point2 half{};
  };
  bool closed(std::size_t d, std::size_t side) const {
    return box_.sides[d][side] != support::Scene::Side::open;
  }
  void fill(const std::vector<Body>& bodies, std::int32_t b, const Lattice<D>& lattice, double depth);
  void make(const Body& own, std::int32_t b, const Vector3& place, double depth);
  bool counts(const std::vector<Body>& bodies, const Made& dummy, const Vector3& place) const;
  void add(std::int32_t source, const std::array<double, D>& sign, const std::array<double, D>& offset);

  DomainBox<D> box_;
  double tolerance_;  // [m] round-off of positions
  double volume_;
  std::vector<Dummy> dummies_;
  Columns x_;
  std::vector<Made> made_;
  std::vector<SheetPlace> sheets_;  // of each body; empty where none is a sheet
  // of each, copies included: x = sign x_source + offset
  std::vector<std::int32_t> source_;
  std::vector<std::array<double, D>> sign_, offset_;
};

/// The scene's three components of a particle's D.
template <int D>
Vector3 in_scene(const std::array<double, D>& x) {
  Vector3 out{};
  for (std::size_t d = 0; d < D; ++d) out[scene_axis<D>(d)] = x[d];
  return out;
}
template <int D>
std::array<double, D> in_plane(const Vector3& x) {
  std::array<double, D> out{};
  for (std::size_t d = 0; d < D; ++d) out[d] = x[scene_axis<D>(d)];
  return out;
}

/// Round-off of a lattice place on a surface, of the spacing: such a place is body.
constexpr double k_on_body = 1e-9;

extern template class Dummies<2>;
extern template class Dummies<3>;

}  // namespace littoral::sph
