// The grid solver's speed: residuals alone, and whole steps to three orders, beside a bare residual kernel
// and the STREAM triad of the same run; one thread, then as many as the machine has cores.
//   fv_bench            everything
//   fv_bench NAME ...   only rows whose name contains one of the words (triad and kernel are always run)
#include <omp.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <string>
#include <vector>

#include "bare_residual.hpp"
#include "boundary/ghosts.hpp"
#include "dual_time/stepper.hpp"
#include "grid/metrics.hpp"
#include "implicit/multigrid_solver.hpp"

namespace {

using namespace littoral::fv;

double now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// Shortest of several runs of `work`, at least `seconds` in all: what the machine can do undisturbed.
template <class Work>
double shortest(double seconds, Work&& work) {
  double best = 1e30;
  const double begin = now();
  do {
    const double start = now();
    work();
    best = std::min(best, now() - start);
  } while (now() - begin < seconds);
  return best;
}

double triad_gb_per_s() {
  constexpr std::ptrdiff_t n = 20'000'000;  // 480 MB in all: beyond the caches
  static std::vector<double> a(n, 0.0), b(n, 1.0), c(n, 2.0);
  double* __restrict x = a.data();
  const double* __restrict y = b.data();
  const double* __restrict z = c.data();
  const double t = shortest(0.5, [&] {
#pragma omp parallel for simd schedule(static)
    for (std::ptrdiff_t i = 0; i < n; ++i) x[i] = y[i] + 3.0 * z[i];
  });
  return 3.0 * 8.0 * static_cast<double>(n) / t * 1e-9;
}

/// Unit box of equal cells; `lid`: walls, of which the upper one of the last direction slides; else periodic.
template <int D>
Block<D> box(const std::array<int, D>& cells, bool lid) {
  std::array<bool, D> periodic;
  periodic.fill(!lid);
  Block<D> block = make_block<D>("box", cells, periodic, [&](const std::array<int, D>& index) {
    std::array<double, D> x;
    for (std::size_t d = 0; d < D; ++d) x[d] = static_cast<double>(index[d]) / cells[d];
    return x;
  });
  for (int d = 0; d < D; ++d)
    for (int side = 0; side < 2; ++side) {
      Window<D> w;
      w.condition = lid ? Condition::wall : Condition::periodic;
      w.direction = d;
      w.side = side;
      w.upper = cells;
      if (lid && d == D - 1 && side == 1)
        w.velocity[0] = [](const std::array<double, 3>&, double) { return 1.0; };
      block.windows.push_back(w);
    }
  return block;
}

/// Vortices that fit the periodic box, of speed 1.
template <int D>
PointState<D> vortices(const std::array<double, D>& x, double) {
  const double k = 2.0 * M_PI;
  PointState<D> s;
  s.u[0] = std::sin(k * x[0]) * std::cos(k * x[D - 1]);
  s.u[D - 1] = -std::cos(k * x[0]) * std::sin(k * x[D - 1]);
  if (D == 3) s.u[1] = 0.3 * std::sin(k * x[0]);
  s.p = 250.0 * (std::cos(2.0 * k * x[0]) + std::cos(2.0 * k * x[D - 1]));
  return s;
}

struct Options {
  std::vector<std::string> only;
  bool wants(const std::string& name) const {
    if (only.empty()) return true;
    return std::any_of(only.begin(), only.end(),
                       [&](const std::string& word) { return name.find(word) != std::string::npos; });
  }
};

template <int D>
void residual_row(const Options& options, const std::string& name, int n, Limiter limiter, double nu,
                  double kernel) {
  if (!options.wants(name)) return;
  std::array<int, D> cells;
  cells.fill(n);
  Equations<D> equations;
  equations.limiter = limiter;
  equations.fluid.viscosity = nu;
  std::vector<Block<D>> blocks = {box<D>(cells, false)};
  Stepper<D> stepper(blocks, equations, std::make_unique<MultigridSolver<D>>(), {});
  stepper.initialise(vortices<D>, 0.0);
  const Block<D>& block = stepper.blocks()[0];
  Residual<D> r;
  History<D> history;
  history.resize(block.extent.size);
  const auto time = BackwardDifference::second_order(0.01, 0.01);
  const double t =
      shortest(1.0, [&] { equations.residual(block, stepper.state()[0], time, history, Forcing<D>{}, r); });
  const double rate = static_cast<double>(block.extent.cells()) / t * 1e-6;
  std::printf("  %-34s %8.1f M cells/s", name.c_str(), rate);
  if (D == 3) std::printf("   %.2f of the bare kernel", rate / kernel);
  std::printf("\n");
  std::fflush(stdout);
}

template <int D>
void measure_steps(const std::string& name, Stepper<D>& stepper, double dt) {
  for (int step = 0; step < 3; ++step) stepper.advance(dt);  // the start is not what is measured
  constexpr int k_steps = 5;
  const auto surface_seconds = [&] {
    for (const auto& [phase, spent] : stepper.phases().table())
      if (phase == "surface") return spent;
    return 0.0;
  };
  int cycles = 0;
  const double start = now(), surface_start = surface_seconds();
  double seconds = 1e30, processor = 1e30;  // of the shortest step
  for (int step = 0; step < k_steps; ++step) {
    const double begin = now();
    const std::clock_t busy = std::clock();
    cycles += stepper.advance(dt).cycles;
    seconds = std::min(seconds, now() - begin);
    processor = std::min(processor, static_cast<double>(std::clock() - busy) / CLOCKS_PER_SEC);
  }
  const double all_seconds = now() - start;
  const double n = static_cast<double>(stepper.blocks()[0].extent.cells());
  std::printf("  %-34s %8.0f cells   %4.1f cycles   %6.3f s a step and million cells (processor %.3f s)\n",
              name.c_str(), n, cycles / static_cast<double>(k_steps), seconds / n * 1e6, processor / n * 1e6);
  if (stepper.surface() != nullptr)
    std::printf("    of which the surface %.0f%%\n",
                100.0 * (surface_seconds() - surface_start) / all_seconds);
  std::fflush(stdout);
}

template <int D>
void step_row(const Options& options, const std::string& name, const std::array<int, D>& cells, bool lid,
              double dt) {
  if (!options.wants(name)) return;
  Equations<D> equations;
  equations.fluid.viscosity = 1e-3;
  InnerTolerance tolerance;
  tolerance.drop = 1e-3;
  Stepper<D> stepper({box<D>(cells, lid)}, equations, std::make_unique<MultigridSolver<D>>(), tolerance);
  const auto rest = [](const std::array<double, D>&, double) { return PointState<D>{}; };
  stepper.initialise(lid ? FlowFunction<D>(rest) : FlowFunction<D>(vortices<D>), 0.0);
  measure_steps(name, stepper, dt);
}

/// A linear standing wave of length 1 m as its surface passes the level at rest, in a periodic tank .75 m
/// high, water .5 m deep, n cells a wavelength, the Courant number of 170 steps a period at 128 cells; or the
/// same tank full of water under a lid, with a vortex of that speed.
void tank_row(const Options& options, const std::string& name, int n, bool surface) {
  if (!options.wants(name)) return;
  constexpr double gravity = 9.81, amplitude = 0.01, depth = 0.5, height = 0.75;
  const double steps = 170.0 * n / 128.0;
  const double k = 2.0 * M_PI, m = M_PI / height, omega = std::sqrt(gravity * k * std::tanh(k * depth));
  Block<2> block = make_block<2>("tank", {n, 3 * n / 4}, {true, false}, [&](const std::array<int, 2>& i) {
    return std::array<double, 2>{i[0] / double(n), i[1] / double(n) - depth};
  });
  for (int d = 0; d < 2; ++d)
    for (int side = 0; side < 2; ++side) {
      Window<2> w;
      w.condition = d == 0 ? Condition::periodic : Condition::slip;
      w.direction = d;
      w.side = side;
      w.upper = block.extent.n;
      block.windows.push_back(w);
    }
  Equations<2> equations;
  equations.fluid.gravity = {0.0, -gravity};
  Stepper<2> stepper({block}, equations, std::make_unique<MultigridSolver<2>>(), {});
  stepper.initialise(
      [&](const std::array<double, 2>& x, double) {
        const double above = x[1] + depth, w = amplitude * omega, s = std::sin(k * x[0]),
                     c = std::cos(k * x[0]);
        PointState<2> q;
        q.p = -equations.fluid.density * gravity * x[1];
        q.u = surface
                  ? std::array<double, 2>{-w * s * std::cosh(k * above) / std::sinh(k * depth),
                                          w * c * std::sinh(k * above) / std::sinh(k * depth)}
                  : std::array<double, 2>{-w * m / k * s * std::cos(m * above), w * c * std::sin(m * above)};
        return q;
      },
      0.0);
  if (surface) stepper.set_surface([](const std::array<double, 3>& x, double) { return x[2]; });
  measure_steps(name, stepper, 2.0 * M_PI / omega / steps);
}

void all(const Options& options, int threads) {
  omp_set_num_threads(threads);
  std::printf("%d thread%s\n", threads, threads > 1 ? "s" : "");
  std::printf("  %-34s %8.1f GB/s\n", "STREAM triad", triad_gb_per_s());
  const double plain = bare_residual_rate(64, false), limited = bare_residual_rate(64, true);
  std::printf("  %-34s %8.1f M cells/s; %.1f with limiter\n", "bare residual kernel, 64^3", plain, limited);
  residual_row<3>(options, "residual 64^3", 64, Limiter::none, 0.0, plain);
  residual_row<3>(options, "residual 64^3, limiter", 64, Limiter::van_albada, 0.0, limited);
  residual_row<3>(options, "residual 64^3, friction", 64, Limiter::none, 1e-3, plain);
  residual_row<2>(options, "residual 400^2", 400, Limiter::none, 0.0, plain);
  residual_row<2>(options, "residual 400^2, limiter", 400, Limiter::van_albada, 0.0, limited);
  residual_row<2>(options, "residual 400^2, friction", 400, Limiter::none, 1e-3, plain);
  step_row<2>(options, "steps 2-D lid cavity", {400, 400}, true, 0.01);
  step_row<2>(options, "steps 2-D vortices", {400, 400}, false, 0.01);
  step_row<3>(options, "steps 3-D lid cavity", {64, 64, 72}, true, 0.01);
  step_row<3>(options, "steps 3-D vortices", {64, 64, 72}, false, 0.01);
  tank_row(options, "steps 2-D tank, free surface", 512, true);
  tank_row(options, "steps 2-D tank 256, free surface", 256, true);
  tank_row(options, "steps 2-D tank 128, free surface", 128, true);
  tank_row(options, "steps 2-D tank, full", 512, false);
}

}  // namespace

int main(int argc, char** argv) {
  const Options options{std::vector<std::string>(argv + 1, argv + argc)};
  std::printf(
      "three orders of the unsteady residual a step; dt = .01 L/U, Re = 1000, c infinite; tanks without "
      "friction\n");
  all(options, 1);
  const int cores = omp_get_num_procs();
  if (cores > 1) all(options, cores);
  return 0;
}
