#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "overset/ghost_sources.hpp"

namespace littoral::fv {

/// Cells whose values are interpolated from solved cells of other components (overlapping grids):
/// q = sum_k w_k q_k, exact for linear fields, weights trilinear in the dual cell around the place.
template <int D>
struct OversetLinks {
  static constexpr std::size_t k_corners = std::size_t{1} << D;
  struct Receiver {
    std::size_t block = 0;
    std::ptrdiff_t cell = 0;
    std::array<std::uint32_t, k_corners> donor_block{};
    std::array<std::ptrdiff_t, k_corners> donor{};
    std::array<double, k_corners> weight{};  // sum 1; unused corners repeat a donor with weight 0
  };
  std::vector<Receiver> receivers;

  bool empty() const { return receivers.empty(); }
};

/// One block as it takes part in an overlap, on any level of a hierarchy.
template <int D>
struct OverlapBlock {
  const Extent<D>* extent = nullptr;
  const VectorField<D>* centre = nullptr;  // [m] inner cells are read
  std::vector<std::uint8_t> usable;        // may be a donor (extent.size; inner cells are read)
  std::size_t component = 0;
};

template <int D>
struct CellName {
  std::size_t block = 0;
  std::ptrdiff_t cell = 0;
};

/// Donors for `receivers` among the usable cells of other components (of all components but the receiver's
/// own), across joins and periodic faces. Those that find none are put into `orphans`; with `nearest`, they
/// get the nearest usable cell's value instead, as far as there is one: good enough for corrections, not for
/// a state. comm local
template <int D>
OversetLinks<D> find_donors(const std::vector<OverlapBlock<D>>& blocks, const GhostSources<D>& sources,
                            const std::vector<CellName<D>>& receivers, bool nearest,
                            std::vector<CellName<D>>& orphans);

/// 1 for each place that the usable cells of the blocks in `among` enclose or nearly so.
template <int D>
std::vector<std::uint8_t> covered(const std::vector<OverlapBlock<D>>& blocks, const GhostSources<D>& sources,
                                  const std::vector<std::size_t>& among,
                                  const std::vector<std::array<double, D>>& places);

}  // namespace littoral::fv
