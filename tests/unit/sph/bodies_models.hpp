#pragma once

#include <cmath>
#include <memory>
#include <vector>

#include "bodies/triangle_surface.hpp"
#include "bodies/walls.hpp"
#include "clouds.hpp"
#include "physics/dynamics.hpp"

namespace littoral::sph {

using Spec = support::BodySpec;

namespace test {

constexpr double k_g = 0.3, k_c = 20.0;

template <int D>
Numerics<D> numerics_of_unit_lattice() {
  Numerics<D> numerics;
  numerics.eos = {1.0, k_c, 0.0};
  numerics.gravity[D - 1] = -k_g;
  numerics.spacing = 1.0;
  numerics.kernel_radius = D == 2 ? 4.0 : 2.7;
  numerics.skin = 0.3;
  return numerics;
}

template <int D>
DomainBox<D> open_box(double upper) {
  DomainBox<D> box;
  for (std::size_t d = 0; d < D; ++d) {
    box.lower[d] = -6.0;
    box.upper[d] = upper + 6.0;
  }
  return box;
}

/// A tank [0, n]^D open at the top, its walls reaching far above.
inline Spec tank(int dimension, double n) {
  Spec s;
  s.name = "tank";
  s.shape = Spec::Shape::box;
  s.size = {n, dimension == 3 ? n : 0.0, 4 * n};
  s.position = {0.5 * n, dimension == 3 ? 0.5 * n : 0.0, 2 * n};
  s.fluid = Spec::Fluid::inside;
  return s;
}

template <int D>
std::unique_ptr<Walls<D>> walls_of(const std::vector<Spec>& specs, const Numerics<D>& numerics,
                                   const DomainBox<D>& box) {
  std::vector<Body> bodies;
  for (const auto& spec : specs) bodies.emplace_back(spec, D == 2, 0.1);
  return std::make_unique<Walls<D>>(std::move(bodies), numerics, box, Lattice<D>{{}, numerics.spacing});
}

template <int D>
Particles<D> still_water(int n) {
  std::array<int, D> cells;
  cells.fill(n);
  auto particles = cloud<D>(cells, 1.0);
  for (std::size_t i = 0; i < particles.n_owned; ++i) particles.p[i] = k_g * (n - particles.x[D - 1][i]);
  return particles;
}

/// 2 x rows x columns triangles, round to 1 - cos(pi/columns) of its radius.
inline TriangleSoup ball_of_triangles(double radius, int rows, int columns) {
  const double pi = std::acos(-1.0);
  const auto corner = [&](int r, int c) {
    const double polar = pi * r / rows, turn = 2.0 * pi * (c % columns) / columns;
    const double s = r == 0 || r == rows ? 0.0 : std::sin(polar);
    return Vector3{radius * s * std::cos(turn), radius * s * std::sin(turn), radius * std::cos(polar)};
  };
  TriangleSoup soup;
  for (int r = 0; r < rows; ++r)
    for (int c = 0; c < columns; ++c) {
      soup.push_back({corner(r, c), corner(r + 1, c), corner(r + 1, c + 1)});
      soup.push_back({corner(r, c), corner(r + 1, c + 1), corner(r, c + 1)});
    }
  return soup;
}

}  // namespace test
}  // namespace littoral::sph
