#include "implicit/level_grid.hpp"

namespace littoral::fv {

template <int D>
LevelGrid<D>::LevelGrid(const std::array<int, D>& cells) : extent(cells) {
  volume.assign(extent.size, 0.0);
  status.assign(extent.size, CellStatus::fringe);
  for_each_cell<D>(extent, [&](const auto&, std::ptrdiff_t c) {
    status[static_cast<std::size_t>(c)] = CellStatus::computed;
  });
  for (auto& direction : area)
    for (auto& component : direction) component.assign(extent.size, 0.0);
  for (int d = 0; d < D; ++d)
    for (int side = 0; side < 2; ++side) set_edges(d, side, EdgeCondition::link);
}

template <int D>
std::size_t LevelGrid<D>::face_cells(int d) const {
  std::size_t count = 1;
  for (int e = 0; e < D; ++e)
    if (e != d) count *= static_cast<std::size_t>(extent.n[static_cast<std::size_t>(e)]);
  return count;
}

template <int D>
std::size_t LevelGrid<D>::face_index(int d, const std::array<int, D>& index) const {
  std::size_t position = 0;
  for (int e = D - 1; e >= 0; --e) {
    const auto s = static_cast<std::size_t>(e);
    if (e != d)
      position = position * static_cast<std::size_t>(extent.n[s]) + static_cast<std::size_t>(index[s]);
  }
  return position;
}

template <int D>
void LevelGrid<D>::set_edges(int d, int side, EdgeCondition condition) {
  edge[static_cast<std::size_t>(d)][static_cast<std::size_t>(side)].assign(face_cells(d), condition);
}

template <int D>
std::array<int, D> coarsening_ratio(const std::array<int, D>& cells, const std::array<bool, D>& periodic) {
  std::array<int, D> ratio;
  for (std::size_t d = 0; d < D; ++d) ratio[d] = cells[d] >= 4 && !(periodic[d] && cells[d] % 2 != 0) ? 2 : 1;
  return ratio;
}

namespace {

template <int D>
std::array<int, D> parent(const std::array<int, D>& index, const std::array<int, D>& ratio) {
  std::array<int, D> up;
  for (std::size_t d = 0; d < D; ++d) up[d] = index[d] / ratio[d];
  return up;
}

/// First ghost layers of a cell's property: the image's where periodic, else the neighbour's inside.
template <int D>
void copy_to_ghosts(const LevelGrid<D>& grid, Field& values) {
  for_each_cell<D>(grid.extent, [&](const auto& index, std::ptrdiff_t c) {
    for (std::size_t d = 0; d < D; ++d) {
      const std::ptrdiff_t s = grid.extent.stride[d];
      if (index[d] == 0) values[static_cast<std::size_t>(c - s)] = values[static_cast<std::size_t>(c)];
      if (index[d] == grid.extent.n[d] - 1)
        values[static_cast<std::size_t>(c + s)] = values[static_cast<std::size_t>(c)];
    }
  });
  fill_periodic(grid, values);
}

}  // namespace

template <int D>
LevelGrid<D> coarsen(const LevelGrid<D>& fine, const std::array<int, D>& ratio) {
  std::array<int, D> n;
  for (std::size_t d = 0; d < D; ++d) n[d] = (fine.extent.n[d] + ratio[d] - 1) / ratio[d];
  LevelGrid<D> coarse(n);
  coarse.periodic = fine.periodic;
  coarse.far_speed = fine.far_speed;
  // a value imposed one fine cell beyond the face stays where it is while cells grow
  for (std::size_t d = 0; d < D; ++d) coarse.imposed_distance[d] = fine.imposed_distance[d] / ratio[d];
  if (!fine.forcing.empty()) coarse.forcing.assign(coarse.extent.size, 0.0);
  Field solved(coarse.extent.size, 0.0);
  // of cells that are not solved: what corrections they take decides, see link_corrections
  std::vector<CellStatus> other(coarse.extent.size, CellStatus::blanked);

  for_each_cell<D>(fine.extent, [&](const auto& index, std::ptrdiff_t c) {
    const std::array<int, D> up = parent<D>(index, ratio);
    const auto f = static_cast<std::size_t>(c);
    const auto p = static_cast<std::size_t>(coarse.extent.at(up));
    coarse.volume[p] += fine.volume[f];
    if (fine.solved(c))
      solved[p] += fine.volume[f];
    else if (other[p] != CellStatus::interpolated && fine.status[f] != CellStatus::blanked)
      other[p] = fine.status[f];
    if (!fine.forcing.empty()) coarse.forcing[p] += fine.volume[f] * fine.forcing[f];
    for (std::size_t d = 0; d < D; ++d) {
      if (index[d] % ratio[d] == 0)  // lower face of the parent
        for (std::size_t k = 0; k < D; ++k) coarse.area[d][k][p] += fine.area[d][k][f];
      if (index[d] == fine.extent.n[d] - 1) {  // upper face of the block
        const auto fu = static_cast<std::size_t>(c + fine.extent.stride[d]);
        const auto pu = static_cast<std::size_t>(coarse.extent.at(up) + coarse.extent.stride[d]);
        for (std::size_t k = 0; k < D; ++k) coarse.area[d][k][pu] += fine.area[d][k][fu];
      }
      for (std::size_t side = 0; side < 2; ++side)
        if (index[d] == (side == 0 ? 0 : fine.extent.n[d] - 1))
          coarse.edge[d][side][coarse.face_index(static_cast<int>(d), up)] =
              fine.edge[d][side][fine.face_index(static_cast<int>(d), index)];
    }
  });
  for_each_cell<D>(coarse.extent, [&](const auto&, std::ptrdiff_t c) {
    const auto p = static_cast<std::size_t>(c);
    coarse.status[p] = solved[p] >= 0.499 * coarse.volume[p] ? CellStatus::computed : other[p];
    if (!coarse.forcing.empty()) coarse.forcing[p] /= coarse.volume[p];
  });
  copy_to_ghosts(coarse, coarse.volume);
  return coarse;
}

template <int D>
void find_surface(LevelGrid<D>& grid) {
  grid.beside_air.assign(grid.extent.size, 0);
  for_each_cell<D>(grid.extent, [&](const auto&, std::ptrdiff_t c) {
    if (!grid.wet(c)) return;
    std::size_t air = 0;
    for (std::size_t d = 0; d < D; ++d)
      for (const std::ptrdiff_t step : {-grid.extent.stride[d], grid.extent.stride[d]})
        air += grid.wet(c + step) ? 0 : 1;
    grid.beside_air[static_cast<std::size_t>(c)] = air == 0 ? 0 : air < 2 * D ? 1 : 2;
  });
}

template <int D>
void coarsen_phi(const LevelGrid<D>& fine, const std::array<int, D>& ratio, LevelGrid<D>& coarse) {
  coarse.phi.assign(coarse.extent.size, 0.0);
  Field weight(coarse.extent.size, 0.0);
  for_each_cell<D>(fine.extent, [&](const auto& index, std::ptrdiff_t c) {
    const auto f = static_cast<std::size_t>(c);
    if (fine.status[f] == CellStatus::blanked) return;
    const auto p = static_cast<std::size_t>(coarse.extent.at(parent<D>(index, ratio)));
    weight[p] += fine.volume[f];
    coarse.phi[p] += fine.volume[f] * fine.phi[f];
  });
  for (std::size_t p = 0; p < weight.size(); ++p)
    if (weight[p] > 0.0) coarse.phi[p] /= weight[p];
  copy_to_ghosts(coarse, coarse.phi);
}

template <int D>
void average_state(const LevelGrid<D>& fine, const std::array<int, D>& ratio, const State<D>& fine_state,
                   const LevelGrid<D>& coarse, State<D>& coarse_state) {
  coarse_state.resize(coarse.extent.size);
  Field weight(coarse.extent.size, 0.0);
  for_each_cell<D>(fine.extent, [&](const auto& index, std::ptrdiff_t c) {
    const auto f = static_cast<std::size_t>(c);
    if (fine.status[f] == CellStatus::blanked || !fine.wet(c)) return;
    const auto p = static_cast<std::size_t>(coarse.extent.at(parent<D>(index, ratio)));
    const double v = fine.volume[f];
    weight[p] += v;
    coarse_state.p[p] += v * fine_state.p[f];
    for (std::size_t k = 0; k < D; ++k) coarse_state.u[k][p] += v * fine_state.u[k][f];
  });
  for_each_cell<D>(coarse.extent, [&](const auto&, std::ptrdiff_t c) {
    const auto p = static_cast<std::size_t>(c);
    if (weight[p] <= 0.0) return;
    coarse_state.p[p] /= weight[p];
    for (std::size_t k = 0; k < D; ++k) coarse_state.u[k][p] /= weight[p];
  });
  fill_periodic(coarse, coarse_state.p);
  for (auto& component : coarse_state.u) fill_periodic(coarse, component);
}

template <int D, class Real>
void fill_periodic(const LevelGrid<D>& grid, std::vector<Real>& values) {
  for (std::size_t d = 0; d < D; ++d) {
    if (!grid.periodic[d]) continue;
    const std::ptrdiff_t stride = grid.extent.stride[d];
    const std::ptrdiff_t span = stride * grid.extent.n[d];
    // all cells of the lowest layer, ghosts of the other directions included, so that corners come out right
    std::array<int, D> n = grid.extent.n;
    n[d] = 1;
    std::array<int, D> index{};
    for (std::size_t e = 0; e < D; ++e)
      if (e != d) index[e] = -1;
    for (;;) {
      const auto c = static_cast<std::size_t>(grid.extent.at(index));
      values[c - static_cast<std::size_t>(stride)] = values[c + static_cast<std::size_t>(span - stride)];
      values[c + static_cast<std::size_t>(span)] = values[c];
      std::size_t e = 0;
      for (; e < D; ++e) {
        if (e == d) continue;
        if (++index[e] <= n[e]) break;
        index[e] = -1;
      }
      if (e >= D) break;
    }
  }
}

template struct LevelGrid<2>;
template struct LevelGrid<3>;
template std::array<int, 2> coarsening_ratio<2>(const std::array<int, 2>&, const std::array<bool, 2>&);
template std::array<int, 3> coarsening_ratio<3>(const std::array<int, 3>&, const std::array<bool, 3>&);
template LevelGrid<2> coarsen<2>(const LevelGrid<2>&, const std::array<int, 2>&);
template LevelGrid<3> coarsen<3>(const LevelGrid<3>&, const std::array<int, 3>&);
template void find_surface<2>(LevelGrid<2>&);
template void find_surface<3>(LevelGrid<3>&);
template void coarsen_phi<2>(const LevelGrid<2>&, const std::array<int, 2>&, LevelGrid<2>&);
template void coarsen_phi<3>(const LevelGrid<3>&, const std::array<int, 3>&, LevelGrid<3>&);
template void average_state<2>(const LevelGrid<2>&, const std::array<int, 2>&, const State<2>&,
                               const LevelGrid<2>&, State<2>&);
template void average_state<3>(const LevelGrid<3>&, const std::array<int, 3>&, const State<3>&,
                               const LevelGrid<3>&, State<3>&);
template void fill_periodic<2>(const LevelGrid<2>&, std::vector<double>&);
template void fill_periodic<3>(const LevelGrid<3>&, std::vector<double>&);
template void fill_periodic<2>(const LevelGrid<2>&, std::vector<float>&);
template void fill_periodic<3>(const LevelGrid<3>&, std::vector<float>&);

}  // namespace littoral::fv
