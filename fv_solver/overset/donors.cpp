#include "overset/donors.hpp"

#include <algorithm>
#include <limits>
#include <map>

#include "grid/loops.hpp"
#include "grid/space.hpp"
#include "littoral/coupler/donor_search.hpp"

namespace littoral::fv {
namespace {

/// The cell centres of some blocks, one layer of ghosts around each where it stands for a cell, in the order
/// of the search's donors.
template <int D>
struct Centres {
  coupler::DonorGeometry geometry;
  std::vector<CellName<D>> cell;  // the inner cell that a donor is, or is the image of

  Centres(const std::vector<OverlapBlock<D>>& blocks, const GhostSources<D>& sources,
          const std::vector<std::size_t>& among) {
    for (const std::size_t b : among) {
      const OverlapBlock<D>& block = blocks[b];
      coupler::DonorPatch patch;
      patch.n = {1, 1, 1};
      std::array<int, D> lower, upper;
      for (std::size_t d = 0; d < D; ++d) {
        lower[d] = -1;
        upper[d] = block.extent->n[d] + 1;
        patch.n[axis_in_space<D>(d)] = upper[d] - lower[d];
      }
      for_each_index<D>(lower, upper, [&](const std::array<int, D>& index) {
        std::size_t owner = b;
        std::ptrdiff_t at = block.extent->at(index);
        std::array<double, D> offset{};
        bool inner = true;
        for (std::size_t d = 0; d < D; ++d) inner = inner && index[d] >= 0 && index[d] < block.extent->n[d];
        if (!inner) {
          const GhostSource<D>* source = sources.find(b, at);
          if (source != nullptr) owner = source->block, at = source->cell, offset = source->offset;
          inner = source != nullptr;
        }
        const auto c = static_cast<std::size_t>(at);
        std::array<double, D> x{};
        const VectorField<D>& centre = *blocks[owner].centre;
        if (inner) {
          for (std::size_t k = 0; k < D; ++k) x[k] = centre[k][c] + offset[k];
        } else {  // stands for nothing: continues the centres, so that no dual cell is degenerate
          std::array<int, D> near = index;
          for (std::size_t d = 0; d < D; ++d) near[d] = std::clamp(index[d], 0, block.extent->n[d] - 1);
          const auto last = static_cast<std::size_t>(block.extent->at(near));
          for (std::size_t k = 0; k < D; ++k) x[k] = centre[k][last];
          for (std::size_t d = 0; d < D; ++d) {
            if (near[d] == index[d]) continue;
            std::array<int, D> before = near;
            if (block.extent->n[d] > 1) before[d] += index[d] < 0 ? 1 : -1;
            const auto inward = static_cast<std::size_t>(block.extent->at(before));
            for (std::size_t k = 0; k < D; ++k) x[k] += centre[k][last] - centre[k][inward];
          }
        }
        const coupler::Vec3 place = vector_in_space<D>(x);
        patch.x.push_back(place[0]);
        patch.y.push_back(place[1]);
        patch.z.push_back(place[2]);
        patch.usable.push_back(inner && blocks[owner].usable[c] ? 1 : 0);
        cell.push_back({owner, at});
      });
      geometry.patches.push_back(std::move(patch));
    }
  }
};

template <int D>
std::array<double, D> centre_of(const OverlapBlock<D>& block, std::ptrdiff_t cell) {
  std::array<double, D> x;
  for (std::size_t k = 0; k < D; ++k) x[k] = (*block.centre)[k][static_cast<std::size_t>(cell)];
  return x;
}

/// The usable cell of another component nearest to a receiver: by looking at all of them, since few ask.
template <int D>
bool nearest_cell(const std::vector<OverlapBlock<D>>& blocks, const CellName<D>& receiver,
                  CellName<D>& best) {
  const auto x = centre_of<D>(blocks[receiver.block], receiver.cell);
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    if (blocks[b].component == blocks[receiver.block].component) continue;
    for_each_index<D>({}, blocks[b].extent->n, [&](const std::array<int, D>& index) {
      const std::ptrdiff_t c = blocks[b].extent->at(index);
      if (!blocks[b].usable[static_cast<std::size_t>(c)]) return;
      const auto y = centre_of<D>(blocks[b], c);
      double distance2 = 0.0;
      for (std::size_t k = 0; k < D; ++k) distance2 += (x[k] - y[k]) * (x[k] - y[k]);
      if (distance2 < least) least = distance2, best = {b, c};
    });
  }
  return least < std::numeric_limits<double>::infinity();
}

}  // namespace

template <int D>
OversetLinks<D> find_donors(const std::vector<OverlapBlock<D>>& blocks, const GhostSources<D>& sources,
                            const std::vector<CellName<D>>& receivers, bool nearest,
                            std::vector<CellName<D>>& orphans) {
  using Links = OversetLinks<D>;
  Links links;
  std::map<std::size_t, std::vector<CellName<D>>> by_component;
  for (const CellName<D>& r : receivers) by_component[blocks[r.block].component].push_back(r);
  for (const auto& [component, asking] : by_component) {
    std::vector<std::size_t> others;
    for (std::size_t b = 0; b < blocks.size(); ++b)
      if (blocks[b].component != component) others.push_back(b);
    const Centres<D> centres(blocks, sources, others);
    const coupler::DonorSearch search(centres.geometry, D);
    std::int64_t hint = -1;
    for (const CellName<D>& r : asking) {
      typename Links::Receiver receiver;
      receiver.block = r.block;
      receiver.cell = r.cell;
      const coupler::Donor donor =
          search.find(vector_in_space<D>(centre_of<D>(blocks[r.block], r.cell)), hint);
      CellName<D> close;
      if (donor.found) {
        for (std::size_t k = 0; k < Links::k_corners; ++k) {
          const CellName<D>& from = centres.cell[static_cast<std::size_t>(donor.cell[k])];
          receiver.donor_block[k] = static_cast<std::uint32_t>(from.block);
          receiver.donor[k] = from.cell;
          receiver.weight[k] = donor.weight[k];
        }
      } else if (nearest && nearest_cell<D>(blocks, r, close)) {
        receiver.donor_block.fill(static_cast<std::uint32_t>(close.block));
        receiver.donor.fill(close.cell);
        receiver.weight[0] = 1.0;
      } else {
        orphans.push_back(r);
        continue;
      }
      links.receivers.push_back(receiver);
    }
  }
  return links;
}

template <int D>
std::vector<std::uint8_t> covered(const std::vector<OverlapBlock<D>>& blocks, const GhostSources<D>& sources,
                                  const std::vector<std::size_t>& among,
                                  const std::vector<std::array<double, D>>& places) {
  const Centres<D> centres(blocks, sources, among);
  const coupler::DonorSearch search(centres.geometry, D);
  std::vector<std::uint8_t> is(places.size(), 0);
  std::int64_t hint = -1;
  for (std::size_t i = 0; i < places.size(); ++i)
    is[i] = search.find(vector_in_space<D>(places[i]), hint).found ? 1 : 0;
  return is;
}

template OversetLinks<2> find_donors<2>(const std::vector<OverlapBlock<2>>&, const GhostSources<2>&,
                                        const std::vector<CellName<2>>&, bool, std::vector<CellName<2>>&);
template OversetLinks<3> find_donors<3>(const std::vector<OverlapBlock<3>>&, const GhostSources<3>&,
                                        const std::vector<CellName<3>>&, bool, std::vector<CellName<3>>&);
template std::vector<std::uint8_t> covered<2>(const std::vector<OverlapBlock<2>>&, const GhostSources<2>&,
                                              const std::vector<std::size_t>&,
                                              const std::vector<std::array<double, 2>>&);
template std::vector<std::uint8_t> covered<3>(const std::vector<OverlapBlock<3>>&, const GhostSources<3>&,
                                              const std::vector<std::size_t>&,
                                              const std::vector<std::array<double, 3>>&);

}  // namespace littoral::fv
