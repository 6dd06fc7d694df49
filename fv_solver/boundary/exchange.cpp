#include "boundary/exchange.hpp"

#include "boundary/ghosts.hpp"
#include "grid/loops.hpp"

namespace littoral::fv {

namespace {

template <int D>
std::vector<ConnectedGhosts> connected_ghosts(const std::vector<Block<D>>& blocks,
                                              const JoinLinks<D>& links) {
  std::vector<Field> cell;
  std::vector<ConnectedGhosts> connected;
  for (const auto& block : blocks) {
    cell.emplace_back(block.extent.size, 0.0);
    for_each_index<D>({}, block.extent.n, [&](const std::array<int, D>& index) {
      cell.back()[static_cast<std::size_t>(block.extent.at(index))] = 1.0;
    });
    fill_scalar_ghosts(block, {}, ScalarGhosts::cell_data, cell.back());
  }
  links.copy([&](std::size_t b) -> Field& { return cell[b]; });
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    connected.emplace_back(cell[b].begin(), cell[b].end());
    for_each_index<D>({}, blocks[b].extent.n, [&](const std::array<int, D>& index) {
      connected.back()[static_cast<std::size_t>(blocks[b].extent.at(index))] = 0;
    });
  }
  return connected;
}

}  // namespace

template <int D>
Exchange<D>::Exchange(const std::vector<Block<D>>& blocks, OversetLinks<D> overset)
    : overset_(std::move(overset)) {
  if (!overset_.empty()) contour_ = ClosedContour<D>(blocks);
  std::vector<Extent<D>> extents;
  for (const auto& block : blocks) extents.push_back(block.extent);
  const std::vector<JoinSide<D>> joins = join_sides(blocks);
  links_ = JoinLinks<D>(joins, extents, k_ghost);
  irregular_ = IrregularFaces<D>(blocks, joins, links_);
  connected_ = connected_ghosts(blocks, links_);
}

template <int D>
void Exchange<D>::states(const std::vector<Block<D>>& blocks, std::vector<State<D>>& q) const {
  for (const auto& r : overset_.receivers) {
    const auto to = static_cast<std::size_t>(r.cell);
    if (blocks[r.block].status[to] != CellStatus::interpolated) continue;  // the partner's region by now
    double p = blocks[r.block].reference_pressure[to];
    std::array<double, D> u{};
    for (std::size_t k = 0; k < r.weight.size(); ++k) {
      const State<D>& donor = q[r.donor_block[k]];
      const auto from = static_cast<std::size_t>(r.donor[k]);
      p += r.weight[k] * (donor.p[from] - blocks[r.donor_block[k]].reference_pressure[from]);
      for (std::size_t d = 0; d < D; ++d) u[d] += r.weight[k] * donor.u[d][from];
    }
    q[r.block].p[to] = p;
    for (std::size_t d = 0; d < D; ++d) q[r.block].u[d][to] = u[d];
  }
  for (std::size_t b = 0; b < blocks.size(); ++b) fill_ghosts(blocks[b], q[b]);
  links_.for_each([&](const CellCopies& c) {
    const double* reference_here = blocks[c.to_block].reference_pressure.data();
    const double* reference_there = blocks[c.from_block].reference_pressure.data();
    const State<D>& from = q[c.from_block];
    State<D>& to = q[c.to_block];
    for (std::size_t i = 0; i < c.to.size(); ++i) {
      const auto g = static_cast<std::size_t>(c.to[i]), o = static_cast<std::size_t>(c.from[i]);
      to.p[g] = from.p[o] + (reference_here[g] - reference_there[o]);
      for (std::size_t k = 0; k < D; ++k) to.u[k][g] = from.u[k][o];
    }
  });
}

template <int D>
void Exchange<D>::scalars(const std::vector<Block<D>>& blocks, const std::vector<std::vector<Field*>>& fields,
                          ScalarGhosts rule) const {
  for (const auto& f : fields) {
    if (rule == ScalarGhosts::level_set)
      for (const auto& r : overset_.receivers) {
        const auto to = static_cast<std::size_t>(r.cell);
        if (blocks[r.block].status[to] != CellStatus::interpolated) continue;
        double sum = 0.0;
        for (std::size_t k = 0; k < r.weight.size(); ++k)
          sum += r.weight[k] * (*f[r.donor_block[k]])[static_cast<std::size_t>(r.donor[k])];
        (*f[r.block])[to] = sum;
      }
    const auto field_of = [&](std::size_t b) -> Field& { return *f[b]; };
    if (rule == ScalarGhosts::level_set) {  // extrapolation looks across joins and periodic faces
      for (std::size_t b = 0; b < blocks.size(); ++b)
        fill_scalar_ghosts(blocks[b], connected_[b], ScalarGhosts::cell_data, *f[b]);
      links_.copy(field_of, true);
    }
    for (std::size_t b = 0; b < blocks.size(); ++b) fill_scalar_ghosts(blocks[b], connected_[b], rule, *f[b]);
    links_.copy(field_of);
  }
}

template <int D>
void Exchange<D>::scalar(const std::vector<Block<D>>& blocks, std::vector<Field>& field,
                         ScalarGhosts rule) const {
  std::vector<Field*> of;
  for (Field& f : field) of.push_back(&f);
  scalars(blocks, {of}, rule);
}

namespace {

/// Geometry of the ghosts beyond `beyond` + 1 faces behind one join.
template <int D>
void join_side_metrics(std::vector<Block<D>>& blocks, const JoinSide<D>& side, std::size_t beyond_wanted) {
  Block<D>& here = blocks[side.block];
  const Block<D>& there = blocks[side.there.block];
  const auto& n_there = there.extent.n;
  for_each_ghost<D>(
      side, here.extent.n, k_ghost, [&](const std::array<int, D>& index, int layer, std::size_t beyond) {
        if (beyond != beyond_wanted) return;
        const std::array<int, D> other = side.image(index, layer, n_there);
        for (std::size_t d = 0; d < D; ++d)
          if (other[d] < -k_ghost || other[d] >= n_there[d] + k_ghost) return;
        const std::ptrdiff_t g = here.extent.at(index), o = there.extent.at(other);
        here.volume[static_cast<std::size_t>(g)] = there.volume[static_cast<std::size_t>(o)];
        for (std::size_t k = 0; k < D; ++k)
          here.centre[k][static_cast<std::size_t>(g)] =
              there.centre[k][static_cast<std::size_t>(o)] + side.there.offset[k];
        for (std::size_t d = 0; d < D; ++d) {
          const auto a = static_cast<std::size_t>(side.there.axis[d]);
          const bool same = side.same_way(d);
          // lower and upper face of the ghost, from the cell's faces in the direction's own sense; the face
          // shared with an inner cell keeps that cell closed to round-off and is left as it is
          for (int up = 0; up < 2; ++up) {
            if (index[d] + up > here.extent.n[d] + k_ghost - 1) continue;
            const bool own =
                static_cast<int>(d) == side.direction && layer == 0 && up == (side.side == 0 ? 1 : 0);
            if (own) continue;
            const int from = same ? up : 1 - up;
            if (other[a] + from > n_there[a] + k_ghost - 1) continue;
            const auto to = static_cast<std::size_t>(g + up * here.extent.stride[d]);
            const auto source = static_cast<std::size_t>(o + from * there.extent.stride[a]);
            for (std::size_t k = 0; k < D; ++k)
              here.area[d][k][to] = (same ? 1.0 : -1.0) * there.area[a][k][source];
          }
        }
      });
}

}  // namespace

template <int D>
void join_metrics(std::vector<Block<D>>& blocks) {
  const std::vector<JoinSide<D>> sides = join_sides(blocks);
  for (std::size_t beyond = 0; beyond < D; ++beyond)
    for (const JoinSide<D>& side : sides) join_side_metrics(blocks, side, beyond);
}

template class Exchange<2>;
template class Exchange<3>;
template void join_metrics(std::vector<Block<2>>&);
template void join_metrics(std::vector<Block<3>>&);

}  // namespace littoral::fv
