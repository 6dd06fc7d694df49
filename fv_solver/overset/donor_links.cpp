#include "overset/donor_links.hpp"

#include <map>

namespace littoral::fv {

template <int D>
DonorLinks<D>::DonorLinks(const OversetLinks<D>& links, const Owners& owners) : ranks_(owners.ranks) {
  // of each rank, the cells asked for, and the number of each among them
  std::vector<std::vector<CellName<D>>> wanted(static_cast<std::size_t>(ranks_.size()));
  std::vector<std::map<std::pair<std::size_t, std::ptrdiff_t>, std::size_t>> number(wanted.size());
  for (const auto& link : links.receivers) {
    if (!owners.here(link.block)) continue;
    Receiver r;
    r.block = owners.number[link.block];
    r.cell = link.cell;
    r.weight = link.weight;
    for (std::size_t k = 0; k < k_corners; ++k) {
      const std::size_t from = link.donor_block[k];
      r.donor_block[k] = static_cast<std::uint32_t>(owners.number[from]);
      r.donor[k] = link.donor[k];
      if (owners.here(from)) continue;
      const auto rank = static_cast<std::size_t>(owners.rank[from]);
      const auto found = number[rank].emplace(std::pair{from, link.donor[k]}, wanted[rank].size());
      if (found.second) wanted[rank].push_back({owners.number[from], link.donor[k]});
      r.donor_block[k] = k_sent;
      r.donor[k] = static_cast<std::ptrdiff_t>((rank << 32) + found.first->second);
    }
    receivers_.push_back(r);
  }
  empty_ = !ranks_.any(!receivers_.empty());
  if (empty_ || !ranks_.several()) return;
  const std::vector<std::vector<CellName<D>>> asked = ranks_.swap(wanted);
  std::vector<std::size_t> first(wanted.size());  // of what each rank sends
  std::size_t total = 0;
  for (std::size_t rank = 0; rank < wanted.size(); ++rank) {
    first[rank] = total;
    total += wanted[rank].size();
    if (!asked[rank].empty() || !wanted[rank].empty())
      peers_.push_back({static_cast<int>(rank), asked[rank], wanted[rank].size()});
  }
  for (Receiver& r : receivers_)
    for (std::size_t k = 0; k < k_corners; ++k) {
      if (r.donor_block[k] != k_sent) continue;
      const auto rank = static_cast<std::size_t>(r.donor[k] >> 32);
      r.donor[k] = static_cast<std::ptrdiff_t>(first[rank]) + (r.donor[k] & 0xffffffff);
    }
}

template <int D>
typename DonorLinks<D>::Sized& DonorLinks<D>::sized(std::size_t n) const {
  for (Sized& sized : sized_)
    if (sized.n == n) return sized;
  std::vector<Halo::Peer> messages;
  for (const Peer& peer : peers_)
    messages.push_back({peer.rank, peer.gives.size() * n * sizeof(double), peer.takes * n * sizeof(double)});
  sized_.push_back({n, Halo(ranks_, messages), {}, std::vector<double>(n), std::vector<double>(n)});
  return sized_.back();
}

template class DonorLinks<2>;
template class DonorLinks<3>;

}  // namespace littoral::fv
