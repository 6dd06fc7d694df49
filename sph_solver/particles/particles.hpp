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

/// What a particle is born with; the rest follows from it or is found by the step.
template <int D>
struct NewParticle {
  std::array<double, D> x{};  // [m]
  std::array<double, D> u{};  // [m/s]
  double V = 0.0;             // [m^D]
  double m = 0.0;             // [kg] (kg/m in 2-D)
  double p = 0.0;             // [Pa]; m = rho(p) V
  Zone zone = Zone::interior;
};

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
  std::vector<std::int64_t>
      id;  // never reused; a copy has its source's. Sums run in an order made of places and ids

  // owned only
  std::vector<Zone> zone;
  std::vector<SurfaceFlag> surface;
  std::array<Column, D> normal;  // unit, out of the water, where surface != none
  std::array<Column, D> shift;   // [m/s] velocity of (14), added to u when positions move
  /// Memory of the last search among the partner's donor cells, -1: none. Travels with the particle and is
  /// part of a checkpoint, because the walk from another hint may end in a neighbouring, equally good cell.
  std::vector<std::int64_t> donor_hint;

  std::int64_t next_id = 0;    // of the next particle born: the same on all ranks
  std::uint64_t revision = 0;  // counts changes of who is owned and where: lists of another revision are void

  std::size_t size() const { return n_owned + n_ghost; }

  /// Calls f(column) for every column that owned and ghost particles have.
  template <class F>
  void for_each_shared_column(F&& f) {
    for (auto& column : x) f(column);
    for (auto& column : u) f(column);
    for (Column* column : {&V, &m, &rho, &p}) f(*column);
    f(id);
  }
  /// Calls f(column) for every column that only owned particles have.
  template <class F>
  void for_each_owned_column(F&& f) {
    f(zone);
    f(surface);
    for (auto& column : normal) f(column);
    for (auto& column : shift) f(column);
    f(donor_hint);
  }

  // Whatever changes the owned particles drops the copies: they no longer belong to anybody.
  void reserve(std::size_t n);
  void drop_ghosts() { resize_ghosts(0); }
  void resize_ghosts(std::size_t n);             ///< columns of owned and copies grow or shrink at the end
  void append(const NewParticle<D>& born);       ///< at the end of the owned ones, with a fresh id
  void remove(const std::vector<char>& doomed);  ///< (n_owned) non-zero: goes; the others keep their order
  void permute(const std::vector<std::int32_t>& order);  ///< new[k] = old[order[k]], a sort for instance
};

extern template struct Particles<2>;
extern template struct Particles<3>;

}  // namespace littoral::sph
