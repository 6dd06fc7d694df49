#include "free_surface/cut_faces.hpp"

#include <cmath>
#include <optional>

#include "boundary/boundary_flux.hpp"
#include "grid/between.hpp"
#include "grid/loops.hpp"
#include "grid/small_matrix.hpp"
#include "physics/velocity_gradient.hpp"

namespace littoral::fv {
namespace {

/// Windows whose flux is their own (boundary/boundary_flux.hpp) keep it.
bool has_own_flux(Condition condition) {
  switch (condition) {
    case Condition::periodic:
    case Condition::state:
    case Condition::fringe:
    case Condition::join:
    case Condition::overset:
    case Condition::convective:
      return false;
    default:
      return true;
  }
}

/// What friction at the surface needs of a water cell beside it.
template <int D>
struct SurfaceFlow {
  VelocityGradient<D> gradient;  // [1/s]
  SpaceVector<D> normal;         // out of the water
};

/// Force of the stress through a face of a water cell on the side of the air, without its shear along the
/// surface: T' = T - s n - n s with s the part of T n along the surface, so that T' n = (n.T n) n. pure
template <int D>
SpaceVector<D> free_shear_force(const SurfaceFlow<D>& flow, double mu, const SpaceVector<D>& area) {
  const auto& [g, n] = flow;
  SpaceVector<D> on_surface{}, force{};  // T n, T A
  double normal_stress = 0.0, area_n = 0.0;
  for (std::size_t k = 0; k < D; ++k) {
    for (std::size_t l = 0; l < D; ++l) {
      on_surface[k] += mu * (g[k][l] + g[l][k]) * n[l];
      force[k] += mu * (g[k][l] + g[l][k]) * area[l];
    }
    normal_stress += on_surface[k] * n[k];
    area_n += area[k] * n[k];
  }
  double shear_area = 0.0;
  for (std::size_t k = 0; k < D; ++k) {
    on_surface[k] -= normal_stress * n[k];  // now s
    shear_area += on_surface[k] * area[k];
  }
  for (std::size_t k = 0; k < D; ++k) force[k] -= on_surface[k] * area_n + n[k] * shear_area;
  return force;
}

/// Pressure beyond the hydrostatic reference on the surface, where it crosses the line from water cell i to
/// air cell a at the part theta: p0 - P(x_s) [Pa]. pure
template <int D>
double pressure_of_air(const Block<D>& block, const Fluid<D>& fluid, std::size_t i, std::size_t a,
                       double theta) {
  SpaceVector<D> x = between(block, i, a);
  for (std::size_t k = 0; k < D; ++k) x[k] = block.centre[k][i] + theta * x[k];
  return fluid.reference_pressure - fluid.hydrostatic(x);
}

/// 2 mu n.grad(u).n [Pa]. pure
template <int D>
double normal_stress(const SurfaceFlow<D>& flow, double mu) {
  return 2.0 * mu * dot(flow.normal, times(flow.gradient, flow.normal));
}

}  // namespace

template <int D>
std::array<double, D> surface_normal(const Block<D>& block, const Field& phi, std::ptrdiff_t c) {
  SpaceMatrix<D> along;  // [direction of the grid], over two cells
  SpaceVector<D> change;
  for (std::size_t d = 0; d < D; ++d) {
    const std::ptrdiff_t up = c + block.extent.stride[d], low = c - block.extent.stride[d];
    along[d] = between(block, low, up);
    change[d] = phi[static_cast<std::size_t>(up)] - phi[static_cast<std::size_t>(low)];
  }
  SpaceVector<D> n = times(inverse<D>(along), change);
  const double size = std::sqrt(std::max(dot(n, n), 1e-300));
  for (double& x : n) x /= size;
  return n;
}

template <int D>
std::size_t CutFaces<D>::row(std::size_t direction, const std::array<int, D>& index) const {
  std::size_t r = 0;
  for (std::size_t d = D - 1; d > 0; --d)
    r = r * static_cast<std::size_t>(n_[d] + (d == direction ? 1 : 0)) + static_cast<std::size_t>(index[d]);
  return r;
}

template <int D>
void CutFaces<D>::find(const Block<D>& block, const WetMask& wet) {
  n_ = block.extent.n;
  // faces of the block's sides whose windows have fluxes of their own
  std::array<std::array<std::vector<std::uint8_t>, 2>, D> own;
  for (const Window<D>& w : block.windows) {
    const auto d = static_cast<std::size_t>(w.direction);
    auto& face = own[d][static_cast<std::size_t>(w.side)];
    face.resize(static_cast<std::size_t>(block.extent.cells() / block.extent.n[d]), 0);
    if (!has_own_flux(w.condition)) continue;
    std::array<int, D> lower = w.lower, upper = w.upper;
    lower[d] = 0;
    upper[d] = 1;
    for_each_index<D>(lower, upper,
                      [&](const std::array<int, D>& index) { face[face_position<D>(block, d, index)] = 1; });
  }
  for (std::size_t d = 0; d < D; ++d) {
    Faces& f = faces_[d];
    f.cell.clear();
    f.place.clear();
    f.free.clear();
    f.row_begin.clear();
    const std::ptrdiff_t s = block.extent.stride[d];
    std::array<int, D> upper = block.extent.n;
    upper[d] += 1;
    const int faces_in_row = upper[0];
    upper[0] = 1;
    for_each_index<D>({}, upper, [&](std::array<int, D> index) {
      f.row_begin.push_back(static_cast<std::uint32_t>(f.cell.size()));
      const std::ptrdiff_t first = block.extent.at(index);
      const std::uint8_t* w = wet.data() + first;
      for (int i = 0; i < faces_in_row; ++i) {
        const int two = w[i - s] + w[i], four = two + w[i - 2 * s] + w[i + s];
        if (two == 0 || four == 4) continue;
        index[0] = i;
        if (index[d] == 0 || index[d] == n_[d]) {
          const auto& side = own[d][index[d] == 0 ? 0 : 1];
          if (!side.empty() && side[face_position<D>(block, d, index)] != 0) continue;
        }
        f.cell.push_back(first + i);
        f.place.push_back(i);
        f.free.push_back(two == 1 ? 1 : 0);
      }
    });
    f.row_begin.push_back(static_cast<std::uint32_t>(f.cell.size()));
    f.stencil.assign(f.cell.size(), {LineStencil::surface, LineStencil::surface});
    f.mass.resize(f.cell.size());
    for (auto& m : f.momentum) m.resize(f.cell.size());
  }
}

namespace {

/// The line through a face, seen from one of its cells: cell 0 is on this side, 1 behind it, -1 across.
template <int D>
struct LineCells {
  std::size_t near, behind, across;
};

/// What the fluxes of one block's cut faces are made of.
template <int D>
class CutFlux {
 public:
  CutFlux(const Block<D>& block, const Fluid<D>& fluid, const FluxConstants<D>& k, bool limited,
          const Field& phi, const WetMask& wet, bool settled, const double* p, const State<D>& q)
      : block_(block),
        fluid_(fluid),
        k_(k),
        limited_(limited),
        phi_(phi),
        wet_(wet),
        settled_(settled),
        p_(p),
        q_(q) {}

  /// Flux along +direction through the lower face of cell c.
  void operator()(std::size_t d, std::ptrdiff_t c, std::array<LineStencil, 2>& stencil, double& mass,
                  std::array<double, D>& momentum) const {
    const std::ptrdiff_t s = block_.extent.stride[d];
    const auto at = [](std::ptrdiff_t cell) { return static_cast<std::size_t>(cell); };
    const LineCells<D> low{at(c - s), at(c - 2 * s), at(c)}, high{at(c), at(c + s), at(c - s)};
    const bool wet_low = wet_[low.near] != 0, wet_high = wet_[high.near] != 0;
    std::array<double, D> area;
    for (std::size_t k = 0; k < D; ++k) area[k] = block_.area[d][k][at(c)];
    if (wet_low && wet_high)
      inner(low, high, area, stencil, mass, momentum);
    else
      free(wet_low ? low : high, area, stencil[wet_low ? 1 : 0], mass, momentum);
  }

 private:
  double value(double far, double near, double across, double smallest) const {
    return limited_ ? reconstruct_limited(far, near, across, smallest) : reconstruct(far, near, across);
  }
  double small_u() const { return 1e-12 * k_.c0 * k_.c0; }
  double small_p() const { return small_u() * k_.rho0 * k_.rho0 * k_.c0 * k_.c0; }
  std::array<double, D> velocity(const LineCells<D>& l) const {
    std::array<double, D> u;
    for (std::size_t k = 0; k < D; ++k)
      u[k] = value(q_.u[k][l.behind], q_.u[k][l.near], q_.u[k][l.across], small_u());
    return u;
  }
  /// nothing without friction
  std::optional<SurfaceFlow<D>> surface_flow(std::size_t i) const {
    if (k_.mu == 0.0) return std::nullopt;
    const auto c = static_cast<std::ptrdiff_t>(i);
    return SurfaceFlow<D>{velocity_gradient<D>(block_, q_, c), surface_normal<D>(block_, phi_, c)};
  }
  /// Pressure at `at` beyond cell i towards air cell a, j behind i; see line_weights. flow: of cell i
  double continued(std::size_t i, std::size_t a, std::size_t j, double reach, double at,
                   const std::optional<SurfaceFlow<D>>& flow, LineStencil& stencil) const {
    const double theta = crossing(phi_[i], phi_[a]);
    const double behind = length(between(block_, i, j)) / length(between(block_, i, a));
    // a stencil at rest lets the surface cross its limit by half, no further: theta is its denominator
    if (!settled_ || (stencil == LineStencil::own && theta < 0.5 * reach))
      stencil = line_stencil(theta, wet_[j] != 0, reach);
    const LineWeights w = line_weights(stencil, theta, behind, at);
    double on_surface = pressure_of_air<D>(block_, fluid_, i, a, theta);
    if (flow) on_surface += normal_stress<D>(*flow, k_.mu);
    return w.own * p_[i] + w.behind * p_[j] + w.surface * on_surface;
  }
  /// Part of the way from cell i to a at which their face lies.
  double face_at(std::size_t i, std::size_t a) const {
    return block_.volume[i] / (block_.volume[i] + block_.volume[a]);
  }
  double pressure_behind(const LineCells<D>& l, LineStencil& stencil) const {
    if (wet_[l.behind] != 0) return p_[l.behind];
    return continued(l.near, l.behind, l.across, face_at(l.near, l.behind), 1.0, surface_flow(l.near),
                     stencil);
  }

  void inner(const LineCells<D>& low, const LineCells<D>& high, const std::array<double, D>& area,
             std::array<LineStencil, 2>& stencil, double& mass, std::array<double, D>& momentum) const {
    const double p_l = value(pressure_behind(low, stencil[0]), p_[low.near], p_[low.across], small_p());
    const double p_r = value(pressure_behind(high, stencil[1]), p_[high.near], p_[high.across], small_p());
    const std::array<double, D> u_l = velocity(low), u_r = velocity(high);
    double through_l = 0.0, through_r = 0.0, s2 = 0.0;
    for (std::size_t k = 0; k < D; ++k) {
      through_l += u_l[k] * area[k];
      through_r += u_r[k] * area[k];
      s2 += area[k] * area[k];
    }
    const double measure = std::sqrt(s2);
    const double h = 0.5 * (block_.volume[low.near] + block_.volume[high.near]) / measure;
    const double flow =
        0.5 * (through_l + through_r) + 0.5 * measure * (p_l - p_r) / k_.rho0 * k_.speed.inverse(h);
    const double p_mean = 0.5 * (p_l + p_r);
    const double p_face = p_mean + 0.5 * k_.rho0 * k_.c0 * (through_l - through_r) / measure;
    const double reference =
        0.5 * (block_.reference_pressure[low.near] + block_.reference_pressure[high.near]);
    mass = fluid_.rho(p_mean + reference) * flow;
    const double from_l = 0.5 * mass + 0.5 * k_.upwinding * std::abs(mass), from_r = mass - from_l;
    for (std::size_t k = 0; k < D; ++k) momentum[k] = from_l * u_l[k] + from_r * u_r[k] + p_face * area[k];
  }

  /// l: the water's side
  void free(const LineCells<D>& l, const std::array<double, D>& area, LineStencil& stencil, double& mass,
            std::array<double, D>& momentum) const {
    const double at = face_at(l.near, l.across);
    const std::optional<SurfaceFlow<D>> surface = surface_flow(l.near);
    // all around a cell of water alone p = p0: it falls with g, whatever part of the cell it fills
    const double p_face = air_all_around<D>(block_, wet_, static_cast<std::ptrdiff_t>(l.near))
                              ? pressure_of_air<D>(block_, fluid_, l.near, l.across, at)
                              : continued(l.near, l.across, l.behind, at, at, surface, stencil);
    const std::array<double, D> u = velocity(l);
    double flow = 0.0;
    for (std::size_t k = 0; k < D; ++k) flow += u[k] * area[k];
    const double reference =
        (1.0 - at) * block_.reference_pressure[l.near] + at * block_.reference_pressure[l.across];
    mass = fluid_.rho(p_face + reference) * flow;
    for (std::size_t k = 0; k < D; ++k) momentum[k] = mass * u[k] + p_face * area[k];
    if (!surface) return;
    const SpaceVector<D> force = free_shear_force<D>(*surface, k_.mu, area);
    for (std::size_t k = 0; k < D; ++k) momentum[k] -= force[k];
  }

  const Block<D>& block_;
  const Fluid<D>& fluid_;
  const FluxConstants<D>& k_;
  bool limited_;
  const Field& phi_;
  const WetMask& wet_;
  bool settled_;
  const double* p_;
  const State<D>& q_;
};

}  // namespace

template <int D>
void CutFaces<D>::compute(const Block<D>& block, const Fluid<D>& fluid, const FluxConstants<D>& constants,
                          bool limited, const Field& phi, const WetMask& wet, bool settled, const double* p,
                          const State<D>& q) {
  const CutFlux<D> flux(block, fluid, constants, limited, phi, wet, settled, p, q);
  for (std::size_t d = 0; d < D; ++d) {
    Faces& f = faces_[d];
    const auto n = static_cast<std::ptrdiff_t>(f.cell.size());
    constexpr std::ptrdiff_t k_worth_threads = 512;
#pragma omp parallel for schedule(static) if (n > k_worth_threads)
    for (std::ptrdiff_t i = 0; i < n; ++i) {
      const auto at = static_cast<std::size_t>(i);
      std::array<double, D> momentum{};
      flux(d, f.cell[at], f.stencil[at], f.mass[at], momentum);
      for (std::size_t k = 0; k < D; ++k) f.momentum[k][at] = momentum[k];
    }
  }
}

template <int D>
void CutFaces<D>::put(std::size_t direction, const std::array<int, D>& index, std::ptrdiff_t n,
                      const FluxRow<D>& row_of_fluxes, bool after_friction) const {
  const Faces& f = faces_[direction];
  const std::size_t r = row(direction, index);
  for (std::size_t i = f.row_begin[r]; i < f.row_begin[r + 1]; ++i) {
    if (after_friction && f.free[i] == 0) continue;
    const std::ptrdiff_t to = f.place[i] - index[0];
    if (to < 0 || to >= n) continue;
    row_of_fluxes.mass[to] = f.mass[i];
    for (std::size_t k = 0; k < D; ++k) row_of_fluxes.momentum[k][to] = f.momentum[k][i];
  }
}

template std::array<double, 2> surface_normal<2>(const Block<2>&, const Field&, std::ptrdiff_t);
template std::array<double, 3> surface_normal<3>(const Block<3>&, const Field&, std::ptrdiff_t);
template class CutFaces<2>;
template class CutFaces<3>;

}  // namespace littoral::fv
