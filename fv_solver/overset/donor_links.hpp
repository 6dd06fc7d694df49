#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "overset/donors.hpp"
#include "parallel/halo.hpp"
#include "parallel/layout.hpp"

namespace littoral::fv {

/// The interpolated cells of this rank's blocks and where the values of their donors are: in a block of this
/// rank, or sent by another one, each donor once and all in one message a neighbour.
template <int D>
class DonorLinks {
 public:
  DonorLinks() = default;
  /// links: numbers of all blocks; receivers in blocks of other ranks are left out. comm collective
  DonorLinks(const OversetLinks<D>& links, const Owners& owners);

  bool empty() const { return empty_; }  ///< on all ranks

  /// set(block, cell, values) with the n interpolated values of every receiver; get(block, cell, values)
  /// gives those of a donor. Blocks are the rank's own. Donors are never receivers, so the order is free.
  /// comm neighbours
  template <class Get, class Set>
  void interpolate(std::size_t n, Get&& get, Set&& set) const;

 private:
  static constexpr std::size_t k_corners = OversetLinks<D>::k_corners;
  static constexpr std::uint32_t k_sent = ~std::uint32_t{0};  // the donor's number counts what was sent
  struct Receiver {
    std::size_t block = 0;
    std::ptrdiff_t cell = 0;
    std::array<std::uint32_t, k_corners> donor_block{};
    std::array<std::ptrdiff_t, k_corners> donor{};
    std::array<double, k_corners> weight{};
  };
  struct Peer {
    int rank = 0;
    std::vector<CellName<D>> gives;
    std::size_t takes = 0;
  };
  struct Sized {
    std::size_t n;
    Halo halo;
    std::vector<double> sent, own, sum;
  };
  Sized& sized(std::size_t n) const;

  bool empty_ = true;
  Ranks ranks_;
  std::vector<Receiver> receivers_;
  std::vector<Peer> peers_;
  mutable std::vector<Sized> sized_;  // made at the first use of so many values
};

template <int D>
template <class Get, class Set>
void DonorLinks<D>::interpolate(std::size_t n, Get&& get, Set&& set) const {
  if (empty_) return;
  auto& [unused, messages, sent, own, sum] = sized(n);
  if (!peers_.empty()) {
    for (std::size_t p = 0; p < peers_.size(); ++p) {
      double* out = messages.template out<double>(p);
      for (const CellName<D>& c : peers_[p].gives) {
        get(c.block, static_cast<std::size_t>(c.cell), out);
        out += n;
      }
    }
    messages.start();
    messages.wait();
    sent.clear();
    for (std::size_t p = 0; p < peers_.size(); ++p) {
      const double* in = messages.template in<double>(p);
      sent.insert(sent.end(), in, in + n * peers_[p].takes);
    }
  }
  for (const Receiver& r : receivers_) {
    sum.assign(n, 0.0);
    for (std::size_t k = 0; k < k_corners; ++k) {
      const double* values = own.data();
      if (r.donor_block[k] == k_sent)
        values = sent.data() + n * static_cast<std::size_t>(r.donor[k]);
      else
        get(r.donor_block[k], static_cast<std::size_t>(r.donor[k]), own.data());
      for (std::size_t i = 0; i < n; ++i) sum[i] += r.weight[k] * values[i];
    }
    set(r.block, static_cast<std::size_t>(r.cell), sum.data());
  }
}

extern template class DonorLinks<2>;
extern template class DonorLinks<3>;

}  // namespace littoral::fv
