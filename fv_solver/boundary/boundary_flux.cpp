#include "boundary/boundary_flux.hpp"

#include <cmath>

#include "boundary/ghosts.hpp"
#include "boundary/line.hpp"
#include "grid/loops.hpp"
#include "physics/equations.hpp"

namespace littoral::fv {

double pressure_on_face(Condition condition, double p0, double p1, double d0, double slope) {
  // the mirrored field through the ordinary reconstruction
  if (condition == Condition::symmetry) return p0 + (p0 - p1) / 6.0;
  return p0 + d0 * slope;
}

namespace {

template <int D>
struct FaceState {
  double p;
  std::array<double, D> u;
};

/// One face's flux along its outward area vector.
template <int D>
struct Flux {
  double mass = 0.0;
  std::array<double, D> momentum{};
};

template <int D>
double through(const std::array<double, D>& u, const std::array<double, D>& area) {
  double flow = 0.0;
  for (std::size_t k = 0; k < D; ++k) flow += u[k] * area[k];
  return flow;
}

template <int D>
Flux<D> flux_of(double mass, const std::array<double, D>& u, double p, const std::array<double, D>& area) {
  Flux<D> f;
  f.mass = mass;
  for (std::size_t k = 0; k < D; ++k) f.momentum[k] = mass * u[k] + p * area[k];
  return f;
}

}  // namespace

template <int D>
double far_field_speed(const Window<D>& window, std::size_t given, const WaveSpeeds& speeds) {
  if (window.wave_speed > 0.0) return window.wave_speed;
  double speed2 = 0.0;
  for (const auto& u : window.given_u[0]) speed2 += u[given] * u[given];
  return std::max(std::sqrt(speed2), speeds.least_far());
}

template <int D>
void compute_boundary_fluxes(const Block<D>& block, const Fluid<D>& fluid, const WaveSpeeds& speeds,
                             double dt, const double* p, const State<D>& q, BoundaryFluxes<D>& fluxes) {
  const MassSpeed speed = speeds.mass(dt, fluid.viscosity);
  for (std::size_t d = 0; d < D; ++d)
    for (auto& face : fluxes[d]) {
      const auto n = static_cast<std::size_t>(block.extent.cells() / block.extent.n[d]);
      face.any = false;
      face.given.assign(n, 0);
      face.mass.resize(n);
      for (auto& m : face.momentum) m.resize(n);
    }
  for (const Window<D>& w : block.windows) {
    if (w.condition == Condition::periodic || w.condition == Condition::state ||
        w.condition == Condition::fringe || w.condition == Condition::join ||
        w.condition == Condition::overset || w.condition == Condition::convective)
      continue;
    const auto d = static_cast<std::size_t>(w.direction);
    FaceFlux<D>& face = fluxes[d][static_cast<std::size_t>(w.side)];
    face.any = true;
    const double outward = w.side == 0 ? -1.0 : 1.0;  // of +direction
    std::array<int, D> lower, upper;
    grown_box<D>(block, w, lower, upper);
    std::size_t flat = 0;
    for_each_index<D>(lower, upper, [&](const std::array<int, D>& index) {
      const std::size_t given = flat++;
      for (std::size_t k = 0; k < D; ++k)
        if (index[k] < 0 || index[k] >= block.extent.n[k]) return;
      const Line<D> line(block, w, block.extent.at(index));
      const FaceFrame<D> frame(block, w, line);
      const std::size_t i0 = line.inner[0], i1 = line.inner[1], g0 = line.ghost[0];
      const double slope = frame.outward_slope(p[i0], p[i1]);
      const double reference = 0.5 * (block.reference_pressure[i0] + block.reference_pressure[g0]);
      std::array<double, D> area;
      for (std::size_t k = 0; k < D; ++k) area[k] = -frame.normal[k] * frame.measure;
      FaceState<D> in;  // the inner state at the face
      in.p = pressure_on_face(w.condition, p[i0], p[i1], frame.d0, slope);
      Flux<D> f;
      switch (w.condition) {
        case Condition::inflow: {
          for (std::size_t k = 0; k < D; ++k) in.u[k] = w.given_u[0][k][given];
          const double rho = fluid.rho(in.p + reference);
          f = flux_of<D>(rho * through<D>(in.u, area), in.u, in.p, area);
          break;
        }
        case Condition::outflow: {
          // one-sided Riemann problem: the wave from inside meets the given pressure. Where the flow turns
          // back, the cell's own velocity comes in.
          const double p_out = w.given_p[0][given];
          for (std::size_t k = 0; k < D; ++k) in.u[k] = 1.5 * q.u[k][i0] - 0.5 * q.u[k][i1];
          const double flow = through<D>(in.u, area) + frame.measure * (in.p - p_out) / fluid.density *
                                                           speed.inverse(block.volume[i0] / frame.measure);
          if (flow < 0.0)
            for (std::size_t k = 0; k < D; ++k) in.u[k] = q.u[k][i0];
          f = flux_of<D>(fluid.rho(p_out + reference) * flow, in.u, p_out, area);
          break;
        }
        case Condition::far_field: {
          FaceState<D> far;
          far.p = w.given_p[0][given];
          for (std::size_t k = 0; k < D; ++k) {
            far.u[k] = w.given_u[0][k][given];
            in.u[k] = q.u[k][i0];
          }
          in.p = p[i0];
          const double c = far_field_speed(w, given, speeds);
          const double flow_in = through<D>(in.u, area), flow_far = through<D>(far.u, area);
          const double flow =
              0.5 * (flow_in + flow_far) + 0.5 * frame.measure * (in.p - far.p) / (fluid.density * c);
          const double p_face =
              0.5 * (in.p + far.p) + 0.5 * fluid.density * c * (flow_in - flow_far) / frame.measure;
          f = flux_of<D>(fluid.rho(p_face + reference) * flow, flow > 0.0 ? in.u : far.u, p_face, area);
          break;
        }
        default:
          f = flux_of<D>(0.0, {}, in.p, area);
          break;  // wall, slip, symmetry
      }
      const std::size_t position = face_position<D>(block, d, index);
      face.given[position] = 1;
      face.mass[position] = outward * f.mass;
      for (std::size_t k = 0; k < D; ++k) face.momentum[k][position] = outward * f.momentum[k];
    });
  }
}

template double far_field_speed(const Window<2>&, std::size_t, const WaveSpeeds&);
template double far_field_speed(const Window<3>&, std::size_t, const WaveSpeeds&);
template void compute_boundary_fluxes<2>(const Block<2>&, const Fluid<2>&, const WaveSpeeds&, double,
                                         const double*, const State<2>&, BoundaryFluxes<2>&);
template void compute_boundary_fluxes<3>(const Block<3>&, const Fluid<3>&, const WaveSpeeds&, double,
                                         const double*, const State<3>&, BoundaryFluxes<3>&);

}  // namespace littoral::fv
