#pragma once

#include <functional>

#include "boundary/exchange.hpp"
#include "grid/loops.hpp"
#include "grid/space.hpp"
#include "level_set/level_set.hpp"

namespace littoral::fv {

template <int D>
SpaceVector<D> place(const Block<D>& block, std::ptrdiff_t c) {
  SpaceVector<D> x;
  for (std::size_t k = 0; k < D; ++k) x[k] = block.centre[k][static_cast<std::size_t>(c)];
  return x;
}

/// A surface carried by a given flow: what the level set does by itself, without equations for p and u.
template <int D>
struct March {
  using Shape = std::function<double(const SpaceVector<D>&)>;
  using Flow = std::function<SpaceVector<D>(const SpaceVector<D>&, double)>;

  std::vector<Block<D>> blocks;
  Exchange<D> exchange;
  LevelSet<D> surface;
  std::vector<Field> phi_n, phi_nm1;
  std::vector<VectorField<D>> u;
  double t = 0.0, dt_before = 0.0;
  int steps = 0;

  March(std::vector<Block<D>> grid, const Shape& shape, OversetLinks<D> overset = {}, int layers = 8)
      : blocks(std::move(grid)), exchange(blocks, std::move(overset)) {
    surface.options.layers = layers;
    u.resize(blocks.size());
    for (auto& block : blocks) evaluate_surface_windows(block, 0.0);
    surface.initialise(
        blocks, exchange,
        [&](const std::array<double, 3>& x, double) {
          SpaceVector<D> at;
          for (std::size_t k = 0; k < D; ++k) at[k] = x[axis_in_space<D>(k)];
          return shape(at);
        },
        0.0);
    phi_n = phi_nm1 = surface.phi;
  }
  void set_flow(const Flow& flow, double time) {
    for (std::size_t b = 0; b < blocks.size(); ++b) {
      for (auto& component : u[b]) component.resize(blocks[b].extent.size);
      for (std::size_t c = 0; c < blocks[b].extent.size; ++c) {
        const SpaceVector<D> v = flow(place(blocks[b], static_cast<std::ptrdiff_t>(c)), time);
        for (std::size_t k = 0; k < D; ++k) u[b][k][c] = v[k];
      }
    }
  }
  void step(double dt, const Flow& flow, int iterations = 4) {
    const BackwardDifference scheme =
        steps == 0 ? BackwardDifference::first_order(dt) : BackwardDifference::second_order(dt, dt_before);
    t += dt;
    set_flow(flow, t);
    for (auto& block : blocks) evaluate_surface_windows(block, t);
    std::vector<const VectorField<D>*> at;
    for (const auto& field : u) at.push_back(&field);
    const SurfaceStep<D> equation{scheme, phi_n, phi_nm1, surface.forcing, surface.band, surface.patches};
    for (int i = 0; i < iterations; ++i) {
      surface.follower.follow(blocks, exchange, surface.band, surface.patches, surface.phi, at, false,
                              surface.surface_velocity);
      residual = transport<D>(blocks, exchange, equation, surface.surface_velocity, surface.options.sweeps,
                              surface.phi);
    }
    std::swap(phi_nm1, phi_n);
    reinitialise<D>(blocks, exchange, surface.options.layers, InterfaceCells::frozen, surface.phi,
                    surface.band, surface.patches, &phi_nm1);
    phi_n = surface.phi;
    dt_before = dt;
    ++steps;
  }
  /// Largest |phi - exact| in layers [0, layers) of solved cells.
  double error(const Shape& exact, int layers) const {
    double worst = 0.0;
    for (std::size_t b = 0; b < blocks.size(); ++b)
      for (const std::ptrdiff_t c : surface.band.cells(b, 0, layers))
        if (blocks[b].solved[static_cast<std::size_t>(c)] != 0.0)
          worst = std::max(
              worst, std::abs(surface.phi[b][static_cast<std::size_t>(c)] - exact(place(blocks[b], c))));
    return worst;
  }
  double volume() const { return water_volume(blocks, surface.phi); }
  double residual = 0.0;
};

}  // namespace littoral::fv
