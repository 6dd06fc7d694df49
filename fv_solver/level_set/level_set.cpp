#include "level_set/level_set.hpp"

#include <cmath>
#include <cstdio>

#include "grid/space.hpp"
#include "littoral/error.hpp"

namespace littoral::fv {

template <int D>
void LevelSet<D>::initialise(const std::vector<Block<D>>& blocks, const Exchange<D>& exchange,
                             const Prescribed& surface, double t) {
  phi.resize(blocks.size());
  forcing.resize(blocks.size());
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    const Block<D>& block = blocks[b];
    phi[b].resize(block.extent.size);
    for (std::size_t c = 0; c < block.extent.size; ++c) {
      const coupler::Vec3 x = centre_in_space<D>(block, static_cast<std::ptrdiff_t>(c));
      phi[b][c] = surface(x, t);
      if (std::isfinite(phi[b][c])) continue;
      char text[160];
      std::snprintf(
          text, sizeof text,
          "initial.surface is %g at (%g, %g, %g) m, t = %g s: it must be finite wherever the grid is",
          phi[b][c], x[0], x[1], x[2], t);
      throw ConfigError(text);
    }
  }
  exchange.scalar(blocks, phi, ScalarGhosts::level_set);
  reinitialise(blocks, exchange, options.layers, InterfaceCells::all, phi, band, patches);
}

template struct LevelSet<2>;
template struct LevelSet<3>;

}  // namespace littoral::fv
