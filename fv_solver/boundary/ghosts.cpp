#include "boundary/ghosts.hpp"

#include <cmath>

#include "boundary/line.hpp"
#include "boundary/still_level.hpp"
#include "grid/between.hpp"
#include "grid/loops.hpp"
#include "grid/small_matrix.hpp"
#include "grid/space.hpp"
#include "littoral/error.hpp"

namespace littoral::fv {

const char* name(Condition condition) {
  switch (condition) {
    case Condition::wall:
      return "wall";
    case Condition::slip:
      return "slip";
    case Condition::symmetry:
      return "symmetry";
    case Condition::inflow:
      return "inflow";
    case Condition::outflow:
      return "outflow";
    case Condition::far_field:
      return "far_field";
    case Condition::state:
      return "state";
    case Condition::periodic:
      return "periodic";
    case Condition::fringe:
      return "fringe";
    case Condition::convective:
      return "convective";
    case Condition::join:
      return "join";
    case Condition::overset:
      return "overset";
  }
  return "?";
}

template <int D>
void grown_box(const Block<D>& block, const Window<D>& window, std::array<int, D>& lower,
               std::array<int, D>& upper) {
  lower = window.lower;
  upper = window.upper;
  for (std::size_t d = 0; d < D; ++d) {
    if (static_cast<int>(d) == window.direction) {
      lower[d] = window.side == 0 ? 0 : block.extent.n[d] - 1;
      upper[d] = lower[d] + 1;
    } else if (static_cast<int>(d) < window.direction) {
      if (lower[d] == 0) lower[d] = -k_ghost;
      if (upper[d] == block.extent.n[d]) upper[d] += k_ghost;
    }
  }
}

namespace {

/// Centre of the face between two cells whose ghost is the inner one's mirror image.
template <int D>
std::array<double, D> point_between(const Block<D>& block, std::ptrdiff_t a, std::ptrdiff_t b) {
  std::array<double, D> x;
  for (std::size_t d = 0; d < D; ++d)
    x[d] =
        0.5 * (block.centre[d][static_cast<std::size_t>(a)] + block.centre[d][static_cast<std::size_t>(b)]);
  return x;
}

}  // namespace

template <int D>
void evaluate_windows(Block<D>& block, const Equations<D>& equations, double t) {
  for (Window<D>& w : block.windows) {
    const bool uses_u = w.condition == Condition::wall || w.condition == Condition::inflow ||
                        w.condition == Condition::far_field || w.condition == Condition::state;
    const bool uses_p = w.condition == Condition::outflow || w.condition == Condition::far_field ||
                        w.condition == Condition::state || w.condition == Condition::convective;
    if (!uses_u && !uses_p) continue;
    const std::size_t layers = w.condition == Condition::state ? 2 : 1;
    for (std::size_t layer = 0; layer < layers; ++layer) {
      w.given_p[layer].clear();
      for (auto& u : w.given_u[layer]) u.clear();
      std::array<int, D> lower, upper;
      grown_box<D>(block, w, lower, upper);
      for_each_index<D>(lower, upper, [&](const std::array<int, D>& index) {
        const Line<D> line(block, w, block.extent.at(index));
        const auto at_layer = static_cast<std::ptrdiff_t>(line.ghost[layer]);
        const auto x = point_between<D>(
            block, w.condition == Condition::state ? at_layer : static_cast<std::ptrdiff_t>(line.inner[0]),
            at_layer);
        if (uses_u)
          for (std::size_t k = 0; k < D; ++k)
            w.given_u[layer][k].push_back(w.velocity[k] ? w.velocity[k](vector_in_space<D>(x), t) : 0.0);
        if (uses_p)
          w.given_p[layer].push_back(
              w.pressure ? w.pressure(vector_in_space<D>(x), t) - equations.fluid.hydrostatic(x)
                         : pressure_at_rest<D>(w.surface, equations.fluid, x, t,
                                               length(between(block, line.inner[0], line.ghost[0]))));
      });
    }
  }
}

template <int D>
void carry_windows(Block<D>& block, const Equations<D>& equations, const BackwardDifference& scheme,
                   const State<D>& now, const State<D>& before) {
  for (Window<D>& w : block.windows) {
    if (w.condition != Condition::convective) continue;
    w.carried_a0 = scheme.a0;
    w.carried_speed = w.wave_speed > 0.0 ? w.wave_speed : equations.speeds.c0;
    w.carried_p.clear();
    for (auto& u : w.carried_u) u.clear();
    std::array<int, D> lower, upper;
    grown_box<D>(block, w, lower, upper);
    for_each_index<D>(lower, upper, [&](const std::array<int, D>& index) {
      const std::size_t g = Line<D>(block, w, block.extent.at(index)).ghost[0];
      const double reference = block.reference_pressure[g];
      w.carried_p.push_back(-scheme.a1 * (now.p[g] - reference) - scheme.a2 * (before.p[g] - reference));
      for (std::size_t k = 0; k < D; ++k)
        w.carried_u[k].push_back(-scheme.a1 * now.u[k][g] - scheme.a2 * before.u[k][g]);
    });
  }
}

namespace {

/// Between the centres of the first and last cell of a line [m].
template <int D>
double block_length(const Block<D>& block, const Line<D>& line) {
  double length2 = 0.0;
  for (std::size_t k = 0; k < D; ++k) {
    const double x = block.centre[k][line.inner[0]] - block.centre[k][line.opposite[0]];
    length2 += x * x;
  }
  return std::sqrt(length2);
}

}  // namespace

template <int D>
void set_outlet_lengths(Block<D>& block) {
  for (Window<D>& w : block.windows) {
    if (w.condition != Condition::convective) continue;
    std::array<int, D> lower = w.lower, upper = w.upper;
    const auto d = static_cast<std::size_t>(w.direction);
    lower[d] = w.side == 0 ? 0 : block.extent.n[d] - 1;
    upper[d] = lower[d] + 1;
    double sum = 0.0, n = 0.0;
    for_each_index<D>(lower, upper, [&](const std::array<int, D>& index) {
      sum += block_length<D>(block, Line<D>(block, w, block.extent.at(index)));
      n += 1.0;
    });
    w.outlet_length = sum / n;
  }
}

namespace {

/// d q/dt + U dq/dn = 0 at the first ghost, upwind from the cell inside and in the step's own backward
/// difference; p also + (p - given)/T, T = L/(.27 U) with the block's length L (Rudy & Strikwerda 1980), so
/// that its level does not drift. The second ghost continues linearly.
template <int D>
void carry_out(const Block<D>& block, const Window<D>& w, const Line<D>& line, double d0, std::size_t flat,
               State<D>& q) {
  if (w.carried_a0 == 0.0) return;
  constexpr double k_return = 0.27;
  const std::size_t i0 = line.inner[0], g0 = line.ghost[0], g1 = line.ghost[1];
  const double length = w.outlet_length > 0.0 ? w.outlet_length : block_length<D>(block, line);
  const double out = w.carried_speed / (2.0 * d0);
  const double back = k_return * w.carried_speed / (length + 2.0 * d0);
  const double* reference = block.reference_pressure.data();
  const double p0 = q.p[i0] - reference[i0];
  const double p = (w.carried_p[flat] + out * p0 + back * w.given_p[0][flat]) / (w.carried_a0 + out + back);
  q.p[g0] = reference[g0] + p;
  q.p[g1] = reference[g1] + 2.0 * p - p0;
  for (std::size_t k = 0; k < D; ++k) {
    double* u = q.u[k].data();
    u[g0] = (w.carried_u[k][flat] + out * u[i0]) / (w.carried_a0 + out);
    u[g1] = 2.0 * u[g0] - u[i0];
  }
}

template <int D>
void fill_window(const Block<D>& block, const Window<D>& w, State<D>& q) {
  std::array<int, D> lower, upper;
  grown_box<D>(block, w, lower, upper);
  const double* reference = block.reference_pressure.data();
  double* p = q.p.data();
  std::size_t flat = 0;
  for_each_index<D>(lower, upper, [&](const std::array<int, D>& index) {
    const Line<D> line(block, w, block.extent.at(index));
    const std::size_t i0 = line.inner[0], i1 = line.inner[1], g0 = line.ghost[0], g1 = line.ghost[1];
    const double p0 = p[i0] - reference[i0], p1 = p[i1] - reference[i1];
    const FaceFrame<D> frame(block, w, line);
    const auto& n = frame.normal;
    const double d0 = frame.d0, d1 = frame.d1;
    const bool single = line.single();
    const double slope = frame.outward_slope(p0, p1);
    switch (w.condition) {
      case Condition::wall:
      case Condition::inflow: {
        // quadratic through the face's value and two cells: the wall's friction is exact for a parabola
        const double w_face = single ? 2.0 : 2.0 * (d0 + d1) / d1;
        const double w_0 = single ? -1.0 : (d0 + d1) / (d0 - d1);
        const double w_1 = single ? 0.0 : 2.0 * d0 * d0 / (d1 * (d1 - d0));
        for (std::size_t k = 0; k < D; ++k) {
          double* u = q.u[k].data();
          const double u_face = w.given_u[0][k][flat];
          u[g0] = w_face * u_face + w_0 * u[i0] + w_1 * u[i1];
          u[g1] = 2.0 * u_face - u[i1];
        }
        p[g0] = reference[g0] + p0 + 2.0 * d0 * slope;
        p[g1] = reference[g1] + p0 + (d0 + d1) * slope;
        break;
      }
      case Condition::slip:
      case Condition::symmetry: {
        for (std::size_t layer = 0; layer < 2; ++layer) {
          const std::size_t i = line.inner[layer], g = line.ghost[layer];
          double u_n = 0.0;
          for (std::size_t k = 0; k < D; ++k) u_n += n[k] * q.u[k][i];
          for (std::size_t k = 0; k < D; ++k) q.u[k][g] = q.u[k][i] - 2.0 * u_n * n[k];
        }
        const bool mirror = w.condition == Condition::symmetry;
        p[g0] = reference[g0] + (mirror ? p0 : p0 + 2.0 * d0 * slope);
        p[g1] = reference[g1] + (mirror ? p1 : p0 + (d0 + d1) * slope);
        break;
      }
      case Condition::outflow: {
        for (std::size_t k = 0; k < D; ++k) {
          double* u = q.u[k].data();
          u[g0] = u[i0];
          u[g1] = u[i0];
        }
        const double p_face = w.given_p[0][flat];
        p[g0] = reference[g0] + 2.0 * p_face - p0;
        p[g1] = reference[g1] + 2.0 * p_face - p1;
        break;
      }
      case Condition::far_field:
        for (const std::size_t g : {g0, g1}) {
          for (std::size_t k = 0; k < D; ++k) q.u[k][g] = w.given_u[0][k][flat];
          p[g] = reference[g] + w.given_p[0][flat];
        }
        break;
      case Condition::convective:
        carry_out<D>(block, w, line, d0, flat, q);
        break;
      case Condition::state:
        for (std::size_t layer = 0; layer < 2; ++layer) {
          const std::size_t g = line.ghost[layer];
          for (std::size_t k = 0; k < D; ++k) q.u[k][g] = w.given_u[layer][k][flat];
          p[g] = reference[g] + w.given_p[layer][flat];
        }
        break;
      case Condition::periodic:
        for (std::size_t layer = 0; layer < 2; ++layer) {
          const std::size_t g = line.ghost[layer], o = line.opposite[layer];
          for (std::size_t k = 0; k < D; ++k) q.u[k][g] = q.u[k][o];
          p[g] = reference[g] + p[o] - reference[o];
        }
        break;
      case Condition::overset:  // read by gradients for output only: the interpolated cells go on linearly
        for (const auto& [g, ahead] : {std::pair{g0, 1.0}, std::pair{g1, 2.0}}) {
          for (std::size_t k = 0; k < D; ++k) q.u[k][g] = q.u[k][i0] + ahead * (q.u[k][i0] - q.u[k][i1]);
          p[g] = reference[g] + p0 + ahead * (p0 - p1);
        }
        break;
      case Condition::fringe:
      case Condition::join:
        break;
    }
    ++flat;
  });
}

}  // namespace

template <int D>
void fill_ghosts(const Block<D>& block, State<D>& q) {
  for (int d = 0; d < D; ++d)
    for (const Window<D>& w : block.windows)
      if (w.direction == d && w.condition != Condition::join) fill_window(block, w, q);
}

template <int D>
void check_windows(const Block<D>& block) {
  for (int d = 0; d < D; ++d)
    for (int side = 0; side < 2; ++side) {
      std::array<int, D> lower{}, upper = block.extent.n;
      lower[static_cast<std::size_t>(d)] = 0;
      upper[static_cast<std::size_t>(d)] = 1;
      for_each_index<D>(lower, upper, [&](const std::array<int, D>& index) {
        int count = 0;
        for (const Window<D>& w : block.windows) {
          if (w.direction != d || w.side != side) continue;
          bool inside = true;
          for (std::size_t k = 0; k < D; ++k)
            if (static_cast<int>(k) != d) inside = inside && index[k] >= w.lower[k] && index[k] < w.upper[k];
          count += inside ? 1 : 0;
        }
        if (count == 1) return;
        std::string cell;
        for (std::size_t k = 0; k < D; ++k)
          if (static_cast<int>(k) != d) cell += (cell.empty() ? "" : ", ") + std::to_string(index[k]);
        throw ConfigError("block '" + block.name + "', " + (side == 0 ? "lower" : "upper") +
                          " face of direction " + std::to_string(d) + ", cell (" + cell + ") has " +
                          std::to_string(count) +
                          " conditions; the windows of a face must cover it exactly once");
      });
    }
}

template void grown_box<2>(const Block<2>&, const Window<2>&, std::array<int, 2>&, std::array<int, 2>&);
template void grown_box<3>(const Block<3>&, const Window<3>&, std::array<int, 3>&, std::array<int, 3>&);
template void evaluate_windows(Block<2>&, const Equations<2>&, double);
template void evaluate_windows(Block<3>&, const Equations<3>&, double);
template void carry_windows(Block<2>&, const Equations<2>&, const BackwardDifference&, const State<2>&,
                            const State<2>&);
template void carry_windows(Block<3>&, const Equations<3>&, const BackwardDifference&, const State<3>&,
                            const State<3>&);
template void set_outlet_lengths(Block<2>&);
template void set_outlet_lengths(Block<3>&);
template void fill_ghosts(const Block<2>&, State<2>&);
template void fill_ghosts(const Block<3>&, State<3>&);
template void check_windows(const Block<2>&);
template void check_windows(const Block<3>&);

}  // namespace littoral::fv
