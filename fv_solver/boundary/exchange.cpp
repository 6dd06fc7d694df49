#include "boundary/exchange.hpp"

#include "boundary/ghosts.hpp"
#include "grid/loops.hpp"
#include "overset/all_cells.hpp"

namespace littoral::fv {

namespace {

/// Of all blocks; kept: those of this rank.
template <int D>
std::vector<ConnectedGhosts> connected_ghosts(const std::vector<Block<D>>& blocks, const JoinLinks<D>& links,
                                              const Owners& owners) {
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
  for (const std::size_t b : owners.mine()) {
    connected.emplace_back(cell[b].begin(), cell[b].end());
    for_each_index<D>({}, blocks[b].extent.n, [&](const std::array<int, D>& index) {
      connected.back()[static_cast<std::size_t>(blocks[b].extent.at(index))] = 0;
    });
  }
  return connected;
}

}  // namespace

template <int D>
Exchange<D>::Exchange(const std::vector<Block<D>>& blocks, const OversetLinks<D>& overset, Layout<D> layout)
    : layout_(std::move(layout)) {
  std::vector<Extent<D>> extents;
  for (const auto& block : blocks) extents.push_back(block.extent);
  links_ = JoinLinks<D>(layout_.joins, extents, k_ghost, layout_.owners);
  const JoinLinks<D> all(layout_.joins, extents, k_ghost);
  irregular_ = IrregularFaces<D>(blocks, layout_.joins, all);
  irregular_.keep(layout_.owners);
  connected_ = connected_ghosts(blocks, all, layout_.owners);
  if (overset.empty()) return;
  contour_ = ClosedContour<D>(blocks, all);
  contour_.keep(layout_.owners);
  overset_ = DonorLinks<D>(overset, layout_.owners);
}

template <int D>
void Exchange<D>::seek_donors(const std::vector<Block<D>>& blocks) {
  if (!overset_.empty()) overset_ = fv::seek_donors<D>(blocks, layout_);
}

template <int D>
void Exchange<D>::states(const std::vector<Block<D>>& blocks, std::vector<State<D>>& q) const {
  overset_.interpolate(
      D + 1,
      [&](std::size_t b, std::size_t c, double* value) {
        value[0] = q[b].p[c] - blocks[b].reference_pressure[c];
        for (std::size_t k = 0; k < D; ++k) value[k + 1] = q[b].u[k][c];
      },
      [&](std::size_t b, std::size_t c, const double* value) {
        if (blocks[b].status[c] != CellStatus::interpolated) return;  // the partner's region by now
        q[b].p[c] = blocks[b].reference_pressure[c] + value[0];
        for (std::size_t k = 0; k < D; ++k) q[b].u[k][c] = value[k + 1];
      });
  arrays_.resize(blocks.size());
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    fill_ghosts(blocks[b], q[b]);
    arrays_[b].assign(1, q[b].p.data());
    for (auto& u : q[b].u) arrays_[b].push_back(u.data());
  }
  links_.template copy_fields<double>(arrays_);
}

template <int D>
void Exchange<D>::scalars(const std::vector<Block<D>>& blocks, const std::vector<std::vector<Field*>>& fields,
                          ScalarGhosts rule) const {
  if (rule == ScalarGhosts::level_set)
    overset_.interpolate(
        fields.size(),
        [&](std::size_t b, std::size_t c, double* value) {
          for (std::size_t i = 0; i < fields.size(); ++i) value[i] = (*fields[i][b])[c];
        },
        [&](std::size_t b, std::size_t c, const double* value) {
          if (blocks[b].status[c] != CellStatus::interpolated) return;
          for (std::size_t i = 0; i < fields.size(); ++i) (*fields[i][b])[c] = value[i];
        });
  arrays_.resize(blocks.size());
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    arrays_[b].clear();
    for (const auto& field : fields) arrays_[b].push_back(field[b]->data());
  }
  const auto fill = [&](ScalarGhosts by) {
    for (const auto& field : fields)
      for (std::size_t b = 0; b < blocks.size(); ++b)
        fill_scalar_ghosts(blocks[b], connected_[b], by, *field[b]);
  };
  if (rule == ScalarGhosts::level_set) {  // extrapolation looks across joins and periodic faces
    fill(ScalarGhosts::cell_data);
    links_.template copy_fields<double>(arrays_, true);
  }
  fill(rule);
  links_.template copy_fields<double>(arrays_);
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
