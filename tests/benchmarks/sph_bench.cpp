// The particle solver on disordered clouds of 125 000 particles: its two pair loops beside a bare pair kernel
// timed in the same run, whole steps (classical Runge-Kutta with lists, surface detection and shifting) with
// the share of each phase and the memory, and steps with terms taken away and added. Tables, no verdict.
//   sph_bench [edge of the 3-D cloud in particles]        default 50
// Times are the shortest of several passes, by the wall and by the processors (all threads together): on a
// machine that computes something else as well only the latter means much, and for one thread only.
#include <malloc.h>
#include <omp.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <random>
#include <string>

#include "bare_pairs.hpp"
#include "physics/dynamics.hpp"
#include "physics/riemann_fluxes.hpp"

namespace {

using namespace littoral::sph;

constexpr double k_jitter = 0.3;  // of dx, each way
constexpr int k_passes = 4, k_steps = 4;

struct Seconds {
  double wall = 1e30, processor = 1e30;
};

Seconds now() {
  timespec processor{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &processor);
  return {std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(),
          static_cast<double>(processor.tv_sec) + 1e-9 * static_cast<double>(processor.tv_nsec)};
}

/// Shortest of several passes of `work`.
template <class Work>
Seconds shortest(int passes, const Work& work) {
  Seconds best;
  for (int k = 0; k < passes; ++k) {
    const Seconds begin = now();
    work();
    const Seconds end = now();
    best.wall = std::min(best.wall, end.wall - begin.wall);
    best.processor = std::min(best.processor, end.processor - begin.processor);
  }
  return best;
}

double allocated() {
  const auto info = mallinfo2();
  return static_cast<double>(info.uordblks + info.hblkhd);
}

/// What performance figures of others are quoted for: about 78 neighbours, dx = 1, U = c/10.
template <int D>
Numerics<D> setup(Precision precision) {
  Numerics<D> numerics;
  numerics.eos = {1000.0, 10.0, 0.0};
  numerics.spacing = 1.0;
  numerics.kernel_radius = D == 2 ? 4.98 : 2.65;
  numerics.skin = 0.5;
  numerics.reference_velocity = 1.0;
  numerics.free_surface = true;
  numerics.precision = precision;
  return numerics;
}

/// A block of water with free sides, stirred by vortices of speed U, every particle off its place at random.
template <int D>
Particles<D> cloud(int edge, const LinearEos& eos) {
  std::array<int, D> cells;
  cells.fill(D == 3 ? edge : static_cast<int>(std::lround(std::pow(edge, 1.5))));
  const double k = 4.0 * std::acos(-1.0) / cells[0];
  std::mt19937 random(7);
  std::uniform_real_distribution<double> jitter(-k_jitter, k_jitter);
  Particles<D> particles;
  long total = 1;
  for (const int n : cells) total *= n;
  for (long c = 0; c < total; ++c) {
    NewParticle<D> born;
    long rest = c;
    for (std::size_t d = D; d-- > 0;) {
      const auto n = static_cast<long>(cells[d]);
      born.x[d] = static_cast<double>(rest % n) + 0.5 + jitter(random);
      rest /= n;
    }
    const double x = k * born.x[0], z = k * born.x[D - 1];
    born.u[0] = std::sin(x) * std::cos(z);
    born.u[D - 1] = -std::cos(x) * std::sin(z);
    born.p = 250.0 * (std::cos(2.0 * x) + std::cos(2.0 * z));
    born.V = 1.0;
    born.m = eos.density(born.p);
    particles.append(born);
  }
  return particles;
}

/// Open on all sides and far larger than the cloud.
template <int D>
DomainBox<D> nowhere() {
  DomainBox<D> box;
  box.lower.fill(-1e4);
  box.upper.fill(1e4);
  return box;
}

const char* name_of(Precision precision) { return precision == Precision::mixed ? "mixed" : "double"; }

template <int D, class Real>
void pair_row(int edge, Precision precision, int threads) {
  omp_set_num_threads(threads);
  const auto numerics = setup<D>(precision);
  auto particles = cloud<D>(edge, numerics.eos);
  Dynamics<D> dynamics(numerics, nowhere<D>());
  dynamics.prepare(particles, 0.0, nullptr);
  const auto& neighbors = dynamics.neighbors();
  const Kernel<D> kernel(numerics.kernel_radius);
  Gradients<D> gradients;
  PairRows<D, Real> rows;
  Rate<D> rate;
  const Seconds loop1 = shortest(k_passes, [&] {
    rows.pack_states(particles, kernel, 0.0);
    compute_gradients(rows, neighbors);
  });
  const Seconds loop2 = shortest(k_passes, [&] {
    riemann_fluxes(particles, rows, neighbors, numerics.eos, Reconstruction::unlimited,
                   RiemannSolver::linearised, rate);
  });
  double result = 0.0;
  compute_gradients(particles, neighbors, gradients);
  const Seconds bare =
      shortest(k_passes, [&] { result += bare_pairs(particles, neighbors, gradients, numerics.eos); });
  if (!std::isfinite(result)) std::abort();
  const double pairs = 1e-6 * static_cast<double>(neighbors.n_pairs());
  const double n = static_cast<double>(particles.n_owned);
  const double both = loop1.processor + loop2.processor;
  std::printf("%d-D %-7s %7d %8.1f %8.1f %8.1f %8.1f %8.1f %8.1f %8.1f %8.2f %8.2f\n", D, name_of(precision),
              threads, 1e6 * pairs / n, pairs / (loop1.wall + loop2.wall), pairs / bare.wall,
              threads * pairs / loop1.processor, threads * pairs / loop2.processor, threads * pairs / both,
              threads * pairs / bare.processor, bare.processor / both, bare.processor / loop2.processor);
}

struct Steps {
  double wall, processor, bytes;  // us a particle-step; B a particle
  std::array<double, k_phase_names.size()> share;
  double builds;
};

template <int D>
Steps steps(int edge, const Numerics<D>& numerics, int threads) {
  omp_set_num_threads(threads);
  const double before = allocated();
  auto particles = cloud<D>(edge, numerics.eos);
  Dynamics<D> dynamics(numerics, nowhere<D>());
  const double dt = dynamics.stable_time_step();
  int done = 0;
  const auto step = [&] { dynamics.step(particles, dt * done, dt, nullptr), ++done; };
  step();
  const PhaseSeconds first = dynamics.seconds();
  const Seconds best = shortest(k_steps, step);
  Steps figures;
  const auto n = static_cast<double>(particles.n_owned);
  figures.wall = 1e6 * best.wall / n;
  figures.processor = 1e6 * best.processor / n;
  figures.bytes = (allocated() - before) / n;
  for (std::size_t p = 0; p < figures.share.size(); ++p)
    figures.share[p] =
        100.0 * (dynamics.seconds()[p] - first[p]) / (dynamics.seconds().total() - first.total());
  figures.builds = static_cast<double>(dynamics.work().list_builds) / done;
  return figures;
}

void print_step_header(const char* what) {
  std::printf("%-24s %7s %9s %9s %9s %7s %7s ", what, "threads", "steps/s", "us wall", "us proc", "B",
              "builds");
  for (const char* phase : k_phase_names) std::printf(" %9s", phase);
  std::printf("\n%-24s %7s %9s %9s %9s %7s %7s  %%\n", "", "", "k, proc", "/step", "/step", "/part", "/step");
}

void print(const std::string& what, int threads, const Steps& s) {
  std::printf("%-24s %7d %9.1f %9.2f %9.2f %7.0f %7.2f ", what.c_str(), threads, 1e3 * threads / s.processor,
              s.wall, s.processor, s.bytes, s.builds);
  for (const double share : s.share) std::printf(" %9.1f", share);
  std::printf("\n");
}

template <int D>
void step_rows(int edge) {
  for (const Precision precision : {Precision::all_double, Precision::mixed})
    for (const int threads : {1, 2})
      print(std::to_string(D) + "-D " + name_of(precision), threads,
            steps<D>(edge, setup<D>(precision), threads));
}

/// What each term adds, and that one which is not held adds nothing.
void term_rows(int edge) {
  auto numerics = setup<3>(Precision::all_double);
  numerics.free_surface = numerics.shifting = false;
  print("no term besides pressure", 1, steps<3>(edge, numerics, 1));
  numerics.shifting = true;
  print("+ shifting", 1, steps<3>(edge, numerics, 1));
  numerics.free_surface = true;
  print("+ surface detection", 1, steps<3>(edge, numerics, 1));
  numerics.gravity[2] = -0.01;
  print("+ gravity", 1, steps<3>(edge, numerics, 1));
  numerics.viscosity = 1e-3;
  print("+ viscosity", 1, steps<3>(edge, numerics, 1));
  numerics.viscosity = numerics.gravity[2] = 0.0;
  numerics.reconstruction = Reconstruction::first_order;
  print("first order instead", 1, steps<3>(edge, numerics, 1));
  numerics.reconstruction = Reconstruction::van_leer;
  print("van Leer instead", 1, steps<3>(edge, numerics, 1));
  numerics.reconstruction = Reconstruction::unlimited;
  numerics.integrator = Integrator::midpoint;
  numerics.cfl = default_cfl(numerics.integrator);
  print("midpoint instead of rk4", 1, steps<3>(edge, numerics, 1));
}

}  // namespace

int main(int argc, char** argv) {
  const int edge = argc > 1 ? std::atoi(argv[1]) : 50;
  if (edge < 4) {
    std::fprintf(stderr,
                 "sph_bench [edge of the 3-D cloud in particles]: found '%s', wanted a number from 4\n",
                 argv[1]);
    return 1;
  }
  std::setvbuf(stdout, nullptr, _IOLBF, 0);
  double load[1] = {0.0};
  if (getloadavg(load, 1) != 1) load[0] = std::nan("");
  std::printf("load of the machine before: %.1f on %d cores\n\n", load[0], omp_get_num_procs());
  std::printf(
      "pair loops, million directed pairs a second (those of the skin included); bare: flux loop alone, "
      "columns "
      "gathered\n%-11s %7s %8s %8s %8s %8s %8s %8s %8s %8s %8s\n%-11s %7s %8s %8s %8s %8s %8s %8s %8s %8s "
      "%8s\n",
      "cloud", "threads", "pairs", "both", "bare", "grads", "fluxes", "both", "bare", "both", "fluxes", "",
      "", "/part", "wall", "wall", "proc", "proc", "proc", "proc", "/bare", "/bare");
  for (const int threads : {1, 2}) {
    pair_row<3, double>(edge, Precision::all_double, threads);
    pair_row<3, float>(edge, Precision::mixed, threads);
    pair_row<2, double>(edge, Precision::all_double, threads);
    pair_row<2, float>(edge, Precision::mixed, threads);
  }
  std::printf("\n");
  print_step_header("whole steps");
  step_rows<3>(edge);
  step_rows<2>(edge);
  std::printf("\n");
  print_step_header("terms, 3-D double");
  term_rows(edge);
  return 0;
}
