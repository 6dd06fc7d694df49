#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace littoral::sph {

/// Where a particle stands in the SPH region, from inside out.
enum class Zone : std::uint8_t { interior = 0, blending = 1, driven = 2 };

/// What the surface detection found. near: within one kernel radius of a surface particle.
enum class SurfaceFlag : std::uint8_t { none = 0, near = 1, surface = 2 };

/// State of all particles of a rank, structure of arrays. Owned particles come first, [0, n_owned), sorted by
/// cell in space order; copies follow, [n_owned, n_owned + n_ghost): periodic images, mirror images, halos of
/// other ranks. In 2-D the components are (x, z), in 3-D (x, y, z).
template <int D>
struct Particles {
  using Column = std::vector<double>;

  std::size_t n_owned = 0;
  std::size_t n_ghost = 0;

  std::array<Column, D> x;  // [m]
  std::array<Column, D> u;  // [m/s]
  Column V;                 // [m^D]
  Column m;                 // [kg] (kg/m in 2-D), constant over a particle's life
  Column rho;               // [kg/m^D] = m / V
  Column p;                 // [Pa] = c^2 (rho - rho0) + p0

  // owned only
  std::vector<Zone> zone;
  std::vector<SurfaceFlag> surface;
  std::array<Column, D> normal;  // unit, out of the water, where surface != none
  std::array<Column, D> shift;   // [m/s] velocity of (14), added to u when positions move
  std::vector<std::int64_t> id;  // never reused
  /// Memory of the last search among the partner's donor cells, -1: none. Travels with the particle and is
  /// part of a checkpoint, because the walk from another hint may end in a neighbouring, equally good cell.
  std::vector<std::int64_t> donor_hint;

  std::size_t size() const { return n_owned + n_ghost; }

  /// Calls f(column) for every column that owned and ghost particles have.
  template <class F>
  void for_each_shared_column(F&& f) {
    for (auto& column : x) f(column);
    for (auto& column : u) f(column);
    for (Column* column : {&V, &m, &rho, &p}) f(*column);
  }
  /// Calls f(column) for every column that only owned particles have.
  template <class F>
  void for_each_owned_column(F&& f) {
    f(zone);
    f(surface);
    for (auto& column : normal) f(column);
    for (auto& column : shift) f(column);
    f(id);
    f(donor_hint);
  }
};

}  // namespace littoral::sph
