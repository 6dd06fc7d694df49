#include "boundary/links.hpp"

#include <unordered_map>

namespace littoral::fv {

template <int D>
JoinLinks<D>::JoinLinks(const std::vector<JoinSide<D>>& joins, const std::vector<Extent<D>>& extents,
                        int layers, const Owners& owners)
    : ranks_(owners.ranks), n_blocks_(owners.mine().size()) {
  // in the order of a ghost's faces, so that a copy finds what it reads already traced to its cell
  struct Traced {
    Copy copy;
    bool face;
  };
  std::vector<Traced> traced;
  std::vector<std::unordered_map<std::ptrdiff_t, std::size_t>> place(extents.size());
  for (std::size_t beyond_wanted = 0; beyond_wanted < D; ++beyond_wanted)
    for (const JoinSide<D>& side : joins) {
      const Extent<D>& here = extents[side.block];
      const Extent<D>& there = extents[side.there.block];
      for_each_ghost<D>(side, here.n, layers,
                        [&](const std::array<int, D>& index, int layer, std::size_t beyond) {
                          if (beyond != beyond_wanted) return;
                          const std::array<int, D> other = side.image(index, layer, there.n);
                          // a block thinner than the ghosts are deep ends the copy at its own ghosts
                          for (std::size_t d = 0; d < D; ++d)
                            if (other[d] < -layers || other[d] >= there.n[d] + layers) return;
                          Copy copy{side.block, side.there.block, here.at(index), there.at(other)};
                          const auto further = place[copy.from_block].find(copy.from);
                          if (further != place[copy.from_block].end()) {
                            const Copy& onward = traced[further->second].copy;
                            copy.from_block = onward.from_block;
                            copy.from = onward.from;
                          }
                          const auto known = place[copy.to_block].emplace(copy.to, traced.size());
                          if (known.second)
                            traced.push_back({copy, beyond == 0});
                          else
                            traced[known.first->second].copy = copy;
                        });
    }
  for (const Traced& t : traced) {
    add(all_, t.copy, owners);
    if (t.face) add(faces_, t.copy, owners);
  }
}

template <int D>
void JoinLinks<D>::add(Pass& pass, const Copy& copy, const Owners& owners) {
  const bool takes = owners.here(copy.to_block), gives = owners.here(copy.from_block);
  const std::size_t to = owners.number[copy.to_block], from = owners.number[copy.from_block];
  // both ranks begin a new run where either block changes, so that they pack alike
  const auto append = [](std::vector<Cells>& runs, std::size_t block, std::size_t other,
                         std::ptrdiff_t cell) {
    if (runs.empty() || runs.back().block != block || runs.back().other != other)
      runs.push_back({block, other, {}});
    runs.back().cell.push_back(cell);
  };
  if (takes && gives) {
    if (pass.copies.empty() || pass.copies.back().to.block != to || pass.copies.back().from.block != from)
      pass.copies.push_back({{to, from, {}}, {from, to, {}}});
    pass.copies.back().to.cell.push_back(copy.to);
    pass.copies.back().from.cell.push_back(copy.from);
    return;
  }
  if (!takes && !gives) return;
  const int rank = owners.rank[takes ? copy.from_block : copy.to_block];
  std::size_t p = 0;
  while (p < pass.peers.size() && pass.peers[p].rank != rank) ++p;
  if (p == pass.peers.size()) pass.peers.push_back({rank, {}, {}, 0, 0});
  Peer& peer = pass.peers[p];
  if (takes) {
    append(peer.takes, to, copy.from_block, copy.to);
    ++peer.n_takes;
  } else {
    append(peer.gives, from, copy.to_block, copy.from);
    ++peer.n_gives;
  }
}

template <int D>
Halo& JoinLinks<D>::halo(const Pass& pass, std::size_t bytes) const {
  for (auto& sized : pass.halos)
    if (sized.bytes == bytes) return sized.halo;
  std::vector<Halo::Peer> peers;
  for (const Peer& peer : pass.peers)
    peers.push_back({peer.rank, peer.n_gives * bytes, peer.n_takes * bytes});
  pass.halos.push_back({bytes, Halo(ranks_, peers)});
  return pass.halos.back().halo;
}

template <int D>
template <class T>
void JoinLinks<D>::copy_fields(const std::vector<std::vector<T*>>& fields, bool faces_only) const {
  const Pass& pass = faces_only ? faces_ : all_;
  if (fields.empty()) return;
  const std::size_t n = fields[0].size();
  Halo* messages = pass.peers.empty() ? nullptr : &halo(pass, n * sizeof(T));
  if (messages != nullptr) {
    for (std::size_t p = 0; p < pass.peers.size(); ++p) {
      T* out = messages->out<T>(p);
      for (const Cells& run : pass.peers[p].gives)
        for (std::size_t k = 0; k < n; ++k) {
          const T* from = fields[run.block][k];
          for (const std::ptrdiff_t c : run.cell) *out++ = from[c];
        }
    }
    messages->start();
  }
  for (const Copies& c : pass.copies)
    for (std::size_t k = 0; k < n; ++k) {
      T* to = fields[c.to.block][k];
      const T* from = fields[c.from.block][k];
      for (std::size_t i = 0; i < c.to.cell.size(); ++i) to[c.to.cell[i]] = from[c.from.cell[i]];
    }
  if (messages == nullptr) return;
  messages->wait();
  for (std::size_t p = 0; p < pass.peers.size(); ++p) {
    const T* in = messages->in<T>(p);
    for (const Cells& run : pass.peers[p].takes)
      for (std::size_t k = 0; k < n; ++k) {
        T* to = fields[run.block][k];
        for (const std::ptrdiff_t c : run.cell) to[c] = *in++;
      }
  }
}

template <int D>
std::vector<JoinSide<D>> join_sides(const std::vector<Block<D>>& blocks) {
  std::vector<JoinSide<D>> sides;
  for (std::size_t b = 0; b < blocks.size(); ++b)
    for (const Window<D>& w : blocks[b].windows)
      if (w.condition == Condition::join) sides.push_back({b, w.direction, w.side, w.lower, w.upper, w.join});
  return sides;
}

template class JoinLinks<2>;
template class JoinLinks<3>;
template void JoinLinks<2>::copy_fields(const std::vector<std::vector<double*>>&, bool) const;
template void JoinLinks<3>::copy_fields(const std::vector<std::vector<double*>>&, bool) const;
template void JoinLinks<2>::copy_fields(const std::vector<std::vector<float*>>&, bool) const;
template void JoinLinks<3>::copy_fields(const std::vector<std::vector<float*>>&, bool) const;
template std::vector<JoinSide<2>> join_sides(const std::vector<Block<2>>&);
template std::vector<JoinSide<3>> join_sides(const std::vector<Block<3>>&);

}  // namespace littoral::fv
