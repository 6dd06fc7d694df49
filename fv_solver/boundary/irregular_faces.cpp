#include "boundary/irregular_faces.hpp"

#include "physics/flux_rows.hpp"

namespace littoral::fv {
namespace {

/// Numbers of the cells whose values all cells hold, ghosts behind joins those of the cells they copy.
template <int D>
std::vector<Field> numbers(const std::vector<Block<D>>& blocks, const JoinLinks<D>& links) {
  std::vector<Field> number(blocks.size());
  double next = 0.0;
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    number[b].resize(blocks[b].extent.size);
    for (double& n : number[b]) n = next++;
    // a block that closes on itself repeats its own cells
    for (std::size_t d = 0; d < D; ++d) {
      if (!blocks[b].periodic[d]) continue;
      const Extent<D>& e = blocks[b].extent;
      std::array<int, D> lower, upper;
      for (std::size_t k = 0; k < D; ++k) {
        lower[k] = -k_ghost;
        upper[k] = e.n[k] + k_ghost;
      }
      for_each_index<D>(lower, upper, [&](const std::array<int, D>& index) {
        if (index[d] >= 0 && index[d] < e.n[d]) return;
        std::array<int, D> image = index;
        image[d] = ((index[d] % e.n[d]) + e.n[d]) % e.n[d];
        number[b][static_cast<std::size_t>(e.at(index))] = number[b][static_cast<std::size_t>(e.at(image))];
      });
    }
  }
  links.copy([&](std::size_t b) -> Field& { return number[b]; });
  return number;
}

}  // namespace

template <int D>
IrregularFaces<D>::IrregularFaces(const std::vector<Block<D>>& blocks, const std::vector<JoinSide<D>>& joins,
                                  const JoinLinks<D>& links) {
  if (joins.empty()) return;
  const std::vector<Field> number = numbers(blocks, links);
  for (const JoinSide<D>& join : joins) {
    const Block<D>& here = blocks[join.block];
    const Block<D>& there = blocks[join.there.block];
    const auto n = static_cast<std::size_t>(join.direction),
               m = static_cast<std::size_t>(join.there.direction);
    std::array<int, D> lower = join.lower, upper = join.upper;
    lower[n] = join.side == 0 ? -1 : here.extent.n[n];
    upper[n] = lower[n] + 1;
    for_each_index<D>(lower, upper, [&](const std::array<int, D>& ghost) {
      std::array<int, D> inner = ghost;
      inner[n] += join.side == 0 ? 1 : -1;
      const std::array<int, D> inner_there = join.image(ghost, 0, there.extent.n);
      std::array<int, D> ghost_there = inner_there;
      ghost_there[m] += join.there.side == 0 ? -1 : 1;
      const auto at = [&](std::size_t b, const std::array<int, D>& i) {
        return static_cast<std::size_t>(blocks[b].extent.at(i));
      };
      // every face once: from the side of the lower number
      const double own = number[join.block][at(join.block, inner)],
                   others = number[join.there.block][at(join.there.block, inner_there)];
      if (own > others) return;
      bool same = true;
      for (std::size_t d = 0; d < D; ++d) {
        if (d == n) continue;
        const auto a = static_cast<std::size_t>(join.there.axis[d]);
        for (const int step : {-1, 1}) {
          const int step_there = join.there.reversed[d] ? -step : step;
          const auto compare = [&](std::array<int, D> i, std::array<int, D> j) {
            i[d] += step;
            j[a] += step_there;
            same = same &&
                   number[join.block][at(join.block, i)] == number[join.there.block][at(join.there.block, j)];
          };
          compare(inner, ghost_there);
          compare(ghost, inner_there);
        }
      }
      if (same) return;
      Face f;
      f.owner = {join.block, n, here.extent.at(join.side == 0 ? inner : ghost), here.extent.at(inner),
                 join.side == 0 ? -1.0 : 1.0};
      f.other = {join.there.block, m, there.extent.at(join.there.side == 0 ? inner_there : ghost_there),
                 there.extent.at(inner_there), join.there.side == 0 ? -1.0 : 1.0};
      faces_.push_back(f);
    });
  }
}

template <int D>
void IrregularFaces<D>::keep(const Owners& owners) {
  std::vector<Face> both;
  const auto peer = [&](std::size_t block) -> Peer& {
    for (Peer& p : peers_)
      if (p.rank == owners.rank[block]) return p;
    peers_.push_back({owners.rank[block], {}, {}});
    return peers_.back();
  };
  const auto own = [&](Side side) {
    side.block = owners.number[side.block];
    return side;
  };
  for (const Face& f : faces_) {
    const bool owner = owners.here(f.owner.block), other = owners.here(f.other.block);
    if (owner && other)
      both.push_back({own(f.owner), own(f.other)});
    else if (owner)
      peer(f.other.block).gives.push_back(own(f.owner));
    else if (other)
      peer(f.owner.block).takes.push_back(own(f.other));
  }
  faces_ = std::move(both);
  std::vector<Halo::Peer> messages;
  constexpr std::size_t k_bytes = D * sizeof(double);
  for (const Peer& p : peers_)
    messages.push_back({p.rank, k_bytes * p.gives.size(), k_bytes * p.takes.size()});
  halo_ = Halo(owners.ranks, messages);
}

template <int D>
void IrregularFaces<D>::share_friction(const std::vector<Block<D>>& blocks, const Fluid<D>& fluid,
                                       const std::vector<State<D>>& q, std::vector<Residual<D>>& r) const {
  if (fluid.viscosity == 0.0) return;
  const auto outward_friction = [&](const Side& side) {
    std::array<double, D> force{};
    double unused = 0.0;
    FluxRow<D> row;
    row.mass = &unused;
    for (std::size_t k = 0; k < D; ++k) row.momentum[k] = &force[k];
    subtract_stress_row<D>(blocks[side.block], q[side.block], side.direction, side.face, 1,
                           fluid.density * fluid.viscosity, row);
    for (double& x : force) x *= side.outward;
    return force;
  };
  const auto settle = [&](const Side& other, const double* owner_force) {
    const std::array<double, D> force = outward_friction(other);
    const auto c = static_cast<std::size_t>(other.cell);
    for (std::size_t k = 0; k < D; ++k)
      r[other.block].momentum[k][c] -= blocks[other.block].solved[c] * (owner_force[k] + force[k]);
  };
  for (std::size_t p = 0; p < peers_.size(); ++p) {
    double* out = halo_.out<double>(p);
    for (const Side& side : peers_[p].gives)
      for (const double x : outward_friction(side)) *out++ = x;
  }
  halo_.start();
  for (const Face& f : faces_) settle(f.other, outward_friction(f.owner).data());
  halo_.wait();
  for (std::size_t p = 0; p < peers_.size(); ++p) {
    const double* in = halo_.in<double>(p);
    for (const Side& side : peers_[p].takes) {
      settle(side, in);
      in += D;
    }
  }
}

template class IrregularFaces<2>;
template class IrregularFaces<3>;

}  // namespace littoral::fv
