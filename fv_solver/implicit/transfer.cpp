#include "implicit/transfer.hpp"

#include <cmath>

#include "grid/loops.hpp"

namespace littoral::fv {

template <int D>
Transfer<D>::Transfer(const LevelGrid<D>& fine, const LevelGrid<D>& coarse, const std::array<int, D>& ratio)
    : fine_(fine.extent), coarse_(coarse.extent) {
  for (std::size_t d = 0; d < D; ++d) {
    const int nf = fine_.n[d], nc = coarse_.n[d], r = ratio[d];
    const auto centre = [&](int i) {  // of coarse cell i in units of fine cells; outside: image
      if (i < 0) return fine.periodic[d] ? 0.5 * ((nc - 1) * r + nf) - nf : -0.5 * std::min(r, nf);
      if (i >= nc) {
        const double last = 0.5 * ((nc - 1) * r + nf);
        return fine.periodic[d] ? nf + 0.5 * r : 2.0 * nf - last;
      }
      return 0.5 * (i * r + std::min((i + 1) * r, nf));
    };
    auto& down = down_[d];
    down.resize(static_cast<std::size_t>(nf));
    for (int j = 0; j < nf; ++j) {
      Fine& f = down[static_cast<std::size_t>(j)];
      f.parent = f.neighbour = j / r;
      const double offset = j + 0.5 - centre(f.parent);
      if (std::abs(offset) < 1e-12) continue;
      f.neighbour = f.parent + (offset > 0.0 ? 1 : -1);
      f.weight = offset / (centre(f.neighbour) - centre(f.parent));
    }
    // the transpose; ghost cells carry the weights of the cells they are images of
    auto& up = up_[d];
    up.resize(static_cast<std::size_t>(nc));
    const auto collect = [&](int i, int j, double w) {
      if (w == 0.0) return;
      Coarse& target = up[static_cast<std::size_t>(i)];
      target.cell[static_cast<std::size_t>(target.count)] = j;
      target.weight[static_cast<std::size_t>(target.count++)] = w;
    };
    for (int i = 0; i < nc; ++i) {
      if (i == 0) {
        const Fine& image = down[static_cast<std::size_t>(fine.periodic[d] ? nf - 1 : 0)];
        if (fine.periodic[d] ? image.neighbour == nc : image.neighbour == -1) collect(0, -1, image.weight);
      }
      for (int j = std::max(0, i * r - 1); j < std::min(nf, (i + 1) * r + 1); ++j) {
        const Fine& f = down[static_cast<std::size_t>(j)];
        if (f.parent == i) collect(i, j, 1.0 - f.weight);
        if (f.neighbour == i && f.parent != i) collect(i, j, f.weight);
      }
      if (i == nc - 1) {
        const Fine& image = down[static_cast<std::size_t>(fine.periodic[d] ? 0 : nf - 1)];
        if (fine.periodic[d] ? image.neighbour == -1 : image.neighbour == nc) collect(i, nf, image.weight);
      }
    }
  }
  fine_solved_.assign(fine_.size, 0);
  coarse_solved_.assign(coarse_.size, 0);
  for_each_cell<D>(fine_, [&](const auto&, std::ptrdiff_t c) {
    fine_solved_[static_cast<std::size_t>(c)] = fine.solved(c) ? 1 : 0;
  });
  for_each_cell<D>(coarse_, [&](const auto&, std::ptrdiff_t c) {
    coarse_solved_[static_cast<std::size_t>(c)] = coarse.solved(c) ? 1 : 0;
  });
}

template <int D>
template <class Real>
void Transfer<D>::restrict_residual(const Correction<D, Real>& fine, Correction<D, Real>& coarse) const {
  for_each_cell<D>(coarse_, [&](const std::array<int, D>& index, std::ptrdiff_t c) {
    std::array<double, D + 1> sum{};
    if (coarse_solved_[static_cast<std::size_t>(c)]) {
      std::array<int, D> lower{}, upper, shifted;
      std::array<const Coarse*, D> tap;
      for (std::size_t d = 0; d < D; ++d) {
        tap[d] = &up_[d][static_cast<std::size_t>(index[d])];
        upper[d] = tap[d]->count;
      }
      for_each_index<D>(lower, upper, [&](const std::array<int, D>& t) {
        double w = 1.0;
        for (std::size_t d = 0; d < D; ++d) {
          const auto k = static_cast<std::size_t>(t[d]);
          w *= tap[d]->weight[k];
          shifted[d] = tap[d]->cell[k];
        }
        const auto f = static_cast<std::size_t>(fine_.at(shifted));
        for (std::size_t i = 0; i <= D; ++i) sum[i] += w * static_cast<double>(fine.q[i][f]);
      });
    }
    for (std::size_t i = 0; i <= D; ++i) coarse.q[i][static_cast<std::size_t>(c)] = static_cast<Real>(sum[i]);
  });
}

template <int D>
template <class Real>
void Transfer<D>::add_prolonged(const Correction<D, Real>& coarse, Correction<D, Real>& fine) const {
  for_each_cell<D>(fine_, [&](const std::array<int, D>& index, std::ptrdiff_t c) {
    if (!fine_solved_[static_cast<std::size_t>(c)]) return;
    std::array<const Fine*, D> f;
    for (std::size_t d = 0; d < D; ++d) f[d] = &down_[d][static_cast<std::size_t>(index[d])];
    for (unsigned corner = 0; corner < (1u << D); ++corner) {
      double w = 1.0;
      std::ptrdiff_t offset = coarse_.origin;
      for (std::size_t d = 0; d < D; ++d) {
        const bool far = corner & (1u << d);
        w *= far ? f[d]->weight : 1.0 - f[d]->weight;
        offset += coarse_.stride[d] * (far ? f[d]->neighbour : f[d]->parent);
      }
      if (w == 0.0) continue;
      for (std::size_t i = 0; i <= D; ++i)
        fine.q[i][static_cast<std::size_t>(c)] +=
            static_cast<Real>(w) * coarse.q[i][static_cast<std::size_t>(offset)];
    }
  });
}

template <int D, class Real>
void fill_correction_ghosts(const LevelGrid<D>& grid, Correction<D, Real>& e) {
  for (std::size_t d = 0; d < D; ++d) {
    std::array<int, D> lower, upper;
    for (std::size_t k = 0; k < D; ++k) {  // ghosts of the directions done are part of the layer
      lower[k] = k < d ? -1 : 0;
      upper[k] = grid.extent.n[k] + (k < d ? 1 : 0);
    }
    lower[d] = 0;
    upper[d] = 1;
    for (std::size_t side = 0; side < 2; ++side) {
      for_each_index<D>(lower, upper, [&](std::array<int, D> index) {
        index[d] = side == 0 ? 0 : grid.extent.n[d] - 1;
        const std::ptrdiff_t c = grid.extent.at(index);
        const std::ptrdiff_t s = grid.extent.stride[d];
        const auto ghost = static_cast<std::size_t>(side == 0 ? c - s : c + s);
        if (grid.periodic[d]) {
          const std::ptrdiff_t span = s * (grid.extent.n[d] - 1);
          const auto image = static_cast<std::size_t>(side == 0 ? c + span : c - span);
          for (auto& field : e.q) field[ghost] = field[image];
          return;
        }
        std::array<int, D> inner = index;  // condition and normal of the nearest face, for edges and corners
        for (std::size_t k = 0; k < D; ++k) inner[k] = std::min(std::max(index[k], 0), grid.extent.n[k] - 1);
        const EdgeCondition condition = grid.edge[d][side][grid.face_index(static_cast<int>(d), inner)];
        if (condition == EdgeCondition::link) return;
        const auto face = static_cast<std::size_t>(grid.extent.at(inner) + (side == 0 ? 0 : s));
        std::array<double, D> area;
        for (std::size_t k = 0; k < D; ++k) area[k] = grid.area[d][k][face];
        const SmallMatrix<D> image = mirror<D>(condition, area, grid.imposed_distance[d]);
        for (std::size_t i = 0; i <= D; ++i) {
          double sum = 0.0;
          for (std::size_t j = 0; j <= D; ++j)
            sum += image[i][j] * static_cast<double>(e.q[j][static_cast<std::size_t>(c)]);
          e.q[i][ghost] = static_cast<Real>(sum);
        }
      });
    }
  }
}

template class Transfer<2>;
template class Transfer<3>;
#define LITTORAL_TRANSFER(D, Real)                                                                      \
  template void Transfer<D>::restrict_residual(const Correction<D, Real>&, Correction<D, Real>&) const; \
  template void Transfer<D>::add_prolonged(const Correction<D, Real>&, Correction<D, Real>&) const;     \
  template void fill_correction_ghosts(const LevelGrid<D>&, Correction<D, Real>&)
LITTORAL_TRANSFER(2, float);
LITTORAL_TRANSFER(2, double);
LITTORAL_TRANSFER(3, float);
LITTORAL_TRANSFER(3, double);
#undef LITTORAL_TRANSFER

}  // namespace littoral::fv
