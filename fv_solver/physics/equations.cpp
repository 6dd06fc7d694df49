#include "physics/equations.hpp"

#include <omp.h>

#include "boundary/boundary_flux.hpp"
#include "free_surface/cut_faces.hpp"
#include "grid/loops.hpp"
#include "physics/flux_rows.hpp"

namespace littoral::fv {
namespace {

/// Cells a tile spans in each direction across the rows: rows, fluxes and residual of a tile stay in cache.
constexpr int k_tile = 16;

template <int D>
struct Buffers {
  Field storage;
  std::array<FluxRow<D>, 2> row;
  void resize(std::size_t n) {
    if (storage.size() >= 2 * (D + 1) * n) return;
    storage.resize(2 * (D + 1) * n);
    double* next = storage.data();
    for (auto& r : row) {
      r.mass = next;
      next += n;
      for (auto& m : r.momentum) {
        m = next;
        next += n;
      }
    }
  }
};

template <int D>
class TileLoop {
 public:
  TileLoop(const Equations<D>& equations, const Block<D>& block, const State<D>& q, const double* p,
           const BackwardDifference& time, const History<D>& history, const Forcing<D>& forcing,
           const BoundaryFluxes<D>& boundary, const FluxConstants<D>& constants, const CutFaces<D>* cut,
           Residual<D>& r)
      : equations_(equations),
        block_(block),
        q_(q),
        p_(p),
        time_(time),
        history_(history),
        forcing_(forcing),
        boundary_(boundary),
        cut_(cut),
        r_(r),
        constants_(constants) {}

  template <bool Compressible, bool Limited>
  void run(const std::array<int, D>& lower, const std::array<int, D>& upper, Buffers<D>& buffers) const {
    rows(lower, upper, [&](std::ptrdiff_t c, std::ptrdiff_t n) { time_row<Compressible>(c, n); });
    along_rows<Compressible, Limited>(lower, upper, buffers.row[0]);
    for (std::size_t d = 1; d < D; ++d) across_rows<Compressible, Limited>(d, lower, upper, buffers.row);
    rows(lower, upper, [&](std::ptrdiff_t c, std::ptrdiff_t n) {
      if (forcing_.active()) forcing_row(c, n);
      if (Compressible && equations_.fluid.has_gravity()) gravity_row(c, n);
      mask_row(c, n);
    });
  }

 private:
  template <class Body>
  void rows(std::array<int, D> lower, std::array<int, D> upper, Body&& body) const {
    const std::ptrdiff_t n = upper[0] - lower[0];
    upper[0] = lower[0] + 1;
    for_each_index<D>(lower, upper,
                      [&](const std::array<int, D>& index) { body(block_.extent.at(index), n); });
  }

  template <bool Compressible>
  void time_row(std::ptrdiff_t c, std::ptrdiff_t n) const {
    const double* __restrict volume = block_.volume.data() + c;
    const double* __restrict p = p_ + c;
    const double* __restrict p_r = block_.reference_pressure.data() + c;
    const double* __restrict h_m = history_.mass.data() + c;
    double* __restrict r_m = r_.mass.data() + c;
    const double a0 = time_.a0, rho0 = constants_.rho0, p0 = constants_.p0, ic2 = constants_.inverse_c2;
#pragma omp simd
    for (std::ptrdiff_t i = 0; i < n; ++i) {
      // what does not change in time drops out of the backward difference: only (p - P)/c^2 is left of rho
      double rate = h_m[i];
      if constexpr (Compressible) rate += a0 * p[i] * ic2;
      r_m[i] = volume[i] * rate;
    }
    for (std::size_t k = 0; k < D; ++k) {
      const double* __restrict u = q_.u[k].data() + c;
      const double* __restrict h_u = history_.momentum[k].data() + c;
      double* __restrict r_u = r_.momentum[k].data() + c;
#pragma omp simd
      for (std::ptrdiff_t i = 0; i < n; ++i) {
        double rho = rho0;
        if constexpr (Compressible) rho += (p[i] + p_r[i] - p0) * ic2;
        r_u[i] = volume[i] * (a0 * rho * u[i] + h_u[i]);
      }
    }
  }

  /// Fluxes through `n` faces from offset `first`, friction included; `given` as in put_given.
  template <bool Compressible, bool Limited>
  void flux_row(std::size_t d, std::ptrdiff_t first, std::ptrdiff_t n, const FluxRow<D>& f) const {
    inviscid_row<D, Compressible, Limited>(block_, p_, q_, d, first, n, constants_, f);
  }
  void add_friction(std::size_t d, std::ptrdiff_t first, std::ptrdiff_t n, const FluxRow<D>& f) const {
    if (constants_.mu != 0.0) subtract_stress_row<D>(block_, q_, d, first, n, constants_.mu, f);
  }
  /// Replaces fluxes of a row where the free surface cuts its stencils.
  void put_cut(std::size_t d, const std::array<int, D>& index, std::ptrdiff_t n, const FluxRow<D>& f,
               bool after_friction) const {
    if (cut_ != nullptr && (!after_friction || constants_.mu != 0.0))
      cut_->put(d, index, n, f, after_friction);
  }
  /// Replaces fluxes of a row that lies on the block's face by the windows' own.
  static void put_given(const FaceFlux<D>& face, std::size_t position, std::ptrdiff_t n, std::ptrdiff_t to,
                        const FluxRow<D>& f) {
    for (std::ptrdiff_t i = 0; i < n; ++i) {
      const std::size_t at = position + static_cast<std::size_t>(i);
      if (!face.given[at]) continue;
      f.mass[to + i] = face.mass[at];
      for (std::size_t k = 0; k < D; ++k) f.momentum[k][to + i] = face.momentum[k][at];
    }
  }

  static void add_difference(double* __restrict r, const double* __restrict up, const double* __restrict low,
                             std::ptrdiff_t n) {
#pragma omp simd
    for (std::ptrdiff_t i = 0; i < n; ++i) r[i] += up[i] - low[i];
  }
  void accumulate(std::ptrdiff_t c, std::ptrdiff_t n, const FluxRow<D>& up, const FluxRow<D>& low,
                  std::ptrdiff_t shift) const {
    add_difference(r_.mass.data() + c, up.mass + shift, low.mass, n);
    for (std::size_t k = 0; k < D; ++k)
      add_difference(r_.momentum[k].data() + c, up.momentum[k] + shift, low.momentum[k], n);
  }

  /// Faces of direction 0: one row of fluxes holds both sides of every cell.
  template <bool Compressible, bool Limited>
  void along_rows(std::array<int, D> lower, std::array<int, D> upper, const FluxRow<D>& f) const {
    const int begin = lower[0], end = upper[0];
    upper[0] = lower[0] + 1;
    for_each_index<D>(lower, upper, [&](const std::array<int, D>& index) {
      const std::ptrdiff_t c = block_.extent.at(index);
      const std::ptrdiff_t n = end - begin;
      flux_row<Compressible, Limited>(0, c, n + 1, f);
      put_cut(0, index, n + 1, f, false);
      const std::size_t position = face_position<D>(block_, 0, index);
      if (begin == 0 && boundary_[0][0].any) put_given(boundary_[0][0], position, 1, 0, f);
      if (end == block_.extent.n[0] && boundary_[0][1].any) put_given(boundary_[0][1], position, 1, n, f);
      add_friction(0, c, n + 1, f);
      put_cut(0, index, n + 1, f, true);
      accumulate(c, n, f, f, 1);
    });
  }

  /// Faces of direction d > 0: rows of fluxes below and above a row of cells, in turns.
  template <bool Compressible, bool Limited>
  void across_rows(std::size_t d, std::array<int, D> lower, std::array<int, D> upper,
                   std::array<FluxRow<D>, 2> f) const {
    const int begin = lower[d], end = upper[d];
    const std::ptrdiff_t n = upper[0] - lower[0];
    upper[0] = lower[0] + 1;
    upper[d] = begin + 1;
    for_each_index<D>(lower, upper, [&](std::array<int, D> index) {
      for (int j = begin; j <= end; ++j) {
        index[d] = j;
        const std::ptrdiff_t c = block_.extent.at(index);
        flux_row<Compressible, Limited>(d, c, n, f[1]);
        put_cut(d, index, n, f[1], false);
        const bool last = j == block_.extent.n[d];
        if ((j == 0 || last) && boundary_[d][last ? 1 : 0].any)
          put_given(boundary_[d][last ? 1 : 0], face_position<D>(block_, d, index), n, 0, f[1]);
        add_friction(d, c, n, f[1]);
        put_cut(d, index, n, f[1], true);
        if (j > begin) accumulate(c - block_.extent.stride[d], n, f[1], f[0], 0);
        std::swap(f[0], f[1]);
      }
    });
  }

  /// (21), implicit in q.
  void forcing_row(std::ptrdiff_t c, std::ptrdiff_t n) const {
    const double* __restrict volume = block_.volume.data() + c;
    const auto add = [&](Field& row, const Field& of, const Field& value, const Field& target,
                         double density) {
      double* __restrict r = row.data() + c;
      const double* __restrict rate = of.data() + c;
      const double* __restrict v = value.data() + c;
      const double* __restrict t = target.data() + c;
      for (std::ptrdiff_t i = 0; i < n; ++i) r[i] += volume[i] * rate[i] * density * (v[i] - t[i]);
    };
    if (!forcing_.pressure_rate.empty())
      add(r_.mass, forcing_.pressure_rate, q_.p, forcing_.target.p, forcing_.psi);
    for (std::size_t k = 0; k < D; ++k)
      add(r_.momentum[k], forcing_.rate, q_.u[k], forcing_.target.u[k], constants_.rho0);
  }

  /// Weight beyond that of the hydrostatic reference: (rho(p) - rho(P)) g.
  void gravity_row(std::ptrdiff_t c, std::ptrdiff_t n) const {
    const double* __restrict volume = block_.volume.data() + c;
    const double* __restrict p = p_ + c;
    for (std::size_t k = 0; k < D; ++k) {
      const double g = equations_.fluid.gravity[k] * constants_.inverse_c2;
      double* __restrict r = r_.momentum[k].data() + c;
#pragma omp simd
      for (std::ptrdiff_t i = 0; i < n; ++i) r[i] -= volume[i] * p[i] * g;
    }
  }

  void mask_row(std::ptrdiff_t c, std::ptrdiff_t n) const {
    const double* __restrict solved = block_.solved.data() + c;
    const auto mask = [&](Field& row) {
      double* __restrict r = row.data() + c;
#pragma omp simd
      for (std::ptrdiff_t i = 0; i < n; ++i) r[i] *= solved[i];
    };
    mask(r_.mass);
    for (auto& row : r_.momentum) mask(row);
  }

  const Equations<D>& equations_;
  const Block<D>& block_;
  const State<D>& q_;
  const double* p_;
  const BackwardDifference& time_;
  const History<D>& history_;
  const Forcing<D>& forcing_;
  const BoundaryFluxes<D>& boundary_;
  const CutFaces<D>* cut_;
  Residual<D>& r_;
  FluxConstants<D> constants_;
};

/// Tiles over the directions across the rows.
template <int D>
std::vector<std::pair<std::array<int, D>, std::array<int, D>>> tiles_of(const Block<D>& block) {
  std::array<int, D> count;
  count[0] = 1;
  for (std::size_t d = 1; d < D; ++d) count[d] = (block.extent.n[d] + k_tile - 1) / k_tile;
  std::vector<std::pair<std::array<int, D>, std::array<int, D>>> tiles;
  for_each_index<D>({}, count, [&](const std::array<int, D>& t) {
    std::array<int, D> lower{}, upper = block.extent.n;
    for (std::size_t d = 1; d < D; ++d) {
      lower[d] = t[d] * k_tile;
      upper[d] = std::min(lower[d] + k_tile, block.extent.n[d]);
    }
    tiles.emplace_back(lower, upper);
  });
  return tiles;
}

}  // namespace

template <int D>
void Equations<D>::residual(const Block<D>& block, const State<D>& q, const BackwardDifference& time,
                            const History<D>& history, const Forcing<D>& forcing, Residual<D>& r,
                            const BlockSurface<D>* surface) const {
  if (r.mass.size() != block.extent.size) r.resize(block.extent.size);
  relative_pressure_.resize(block.extent.size);
  const auto size = static_cast<std::ptrdiff_t>(block.extent.size);
  {
    double* __restrict p = relative_pressure_.data();
    const double* __restrict absolute = q.p.data();
    const double* __restrict reference = block.reference_pressure.data();
#pragma omp parallel for simd schedule(static)
    for (std::ptrdiff_t c = 0; c < size; ++c) p[c] = absolute[c] - reference[c];
  }
  const double* p = relative_pressure_.data();
  BoundaryFluxes<D> boundary;
  compute_boundary_fluxes<D>(block, fluid, speeds, time.dt, p, q, boundary);
  const FluxConstants<D> constants{fluid.density,
                                   fluid.reference_pressure,
                                   fluid.inverse_c2,
                                   speeds.c0,
                                   speeds.mass(time.dt, fluid.viscosity),
                                   fluid.density * fluid.viscosity,
                                   upwinding(flux)};
  if (surface != nullptr)
    surface->faces.compute(block, fluid, constants, limiter != Limiter::none, surface->phi, surface->wet,
                           surface->settled, p, q);
  const TileLoop<D> loop(*this, block, q, p, time, history, forcing, boundary, constants,
                         surface != nullptr ? &surface->faces : nullptr, r);
  const auto tiles = tiles_of(block);
  const auto n_tiles = static_cast<std::ptrdiff_t>(tiles.size());
  const bool compressible = fluid.inverse_c2 != 0.0, limited = limiter != Limiter::none;
#pragma omp parallel
  {
    Buffers<D> buffers;
    buffers.resize(static_cast<std::size_t>(block.extent.n[0] + 1));
#pragma omp for schedule(static)
    for (std::ptrdiff_t t = 0; t < n_tiles; ++t) {
      const auto& [lower, upper] = tiles[static_cast<std::size_t>(t)];
      if (compressible && limited) loop.template run<true, true>(lower, upper, buffers);
      if (compressible && !limited) loop.template run<true, false>(lower, upper, buffers);
      if (!compressible && limited) loop.template run<false, true>(lower, upper, buffers);
      if (!compressible && !limited) loop.template run<false, false>(lower, upper, buffers);
    }
  }
}

template struct Equations<2>;
template struct Equations<3>;

}  // namespace littoral::fv
