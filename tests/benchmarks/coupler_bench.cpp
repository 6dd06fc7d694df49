// One window's exchange between two programs of one rank each, beside the raw transfer of the same bytes in
// the same run, and the processor time a waiting program burns.
//   mpirun -n 2 coupler_bench      or      mpirun -n 1 coupler_bench sph : -n 1 coupler_bench fv
#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <thread>
#include <vector>

#include "littoral/coupler/job.hpp"

namespace {

using namespace littoral::coupler;

double now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

double processor_time() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2),
                   values.end());
  return values[values.size() / 2];
}

/// n x n x n centres at 0, 1, ... and `margin` more on each side.
DonorPatch cube(int n, int margin) {
  DonorPatch patch;
  const int first = -margin, end = n + margin;
  patch.n = {end - first, end - first, end - first};
  for (int k = first; k < end; ++k)
    for (int j = first; j < end; ++j)
      for (int i = first; i < end; ++i) {
        patch.x.push_back(i);
        patch.y.push_back(j);
        patch.z.push_back(k);
      }
  patch.usable.assign(patch.x.size(), 1);
  return patch;
}

RunPlan plan() {
  RunPlan p;
  p.window.dt = 1.0;
  p.end_time = 1e9;
  p.deadline = 60.0;
  return p;
}

Proposal proposal(bool region_changed, bool stop) {
  Proposal p;
  p.dt_stable = 1.0;
  p.region_changed = region_changed;
  p.stop = stop;
  return p;
}

struct Figures {
  double exchange = 0, control = 0, sendrecv = 0, ping_pong = 0;
  std::size_t bytes_down = 0, bytes_up = 0;
};

/// `exchange` is one window's work, `control` its agreement and ledger.
template <class Exchange, class Control>
Figures measure(const Job& job, bool starts, std::size_t n, const Exchange& exchange,
                const Control& control) {
  Figures f;
  f.bytes_down = 64 + 32 + n * 8 * sizeof(double);     // header, time and horizon, eight columns
  f.bytes_up = 64 + 8 + n * (5 * sizeof(double) + 1);  // header, flag, five columns, status
  const std::size_t out = starts ? f.bytes_down : f.bytes_up, in = starts ? f.bytes_up : f.bytes_down;
  std::vector<char> send(out, 'x'), receive(in);
  const auto count = [](std::size_t c) { return static_cast<int>(c); };
  const int repetitions = n > 50'000 ? 101 : 301;
  std::vector<double> t_exchange, t_control, t_sendrecv, t_ping_pong;
  for (int r = 0; r < repetitions; ++r) {
    double begin = now();
    const Window window = control();
    t_control.push_back(now() - begin);
    begin = now();
    exchange(window);
    t_exchange.push_back(now() - begin);
    std::fill(send.begin(), send.end(), static_cast<char>(r));  // as packing leaves it: in the sender's cache
    control();
    begin = now();
    MPI_Sendrecv(send.data(), count(out), MPI_CHAR, 0, 5, receive.data(), count(in), MPI_CHAR, 0, 5,
                 job.intercomm(), MPI_STATUS_IGNORE);
    t_sendrecv.push_back(now() - begin);
    std::fill(send.begin(), send.end(), static_cast<char>(r + 1));
    control();
    begin = now();
    if (starts) MPI_Send(send.data(), count(out), MPI_CHAR, 0, 5, job.intercomm());
    MPI_Recv(receive.data(), count(in), MPI_CHAR, 0, 5, job.intercomm(), MPI_STATUS_IGNORE);
    if (!starts) MPI_Send(send.data(), count(out), MPI_CHAR, 0, 5, job.intercomm());
    t_ping_pong.push_back(now() - begin);
  }
  f.exchange = median(t_exchange);
  f.control = median(t_control);
  f.sendrecv = median(t_sendrecv);
  f.ping_pong = median(t_ping_pong);
  return f;
}

void print(std::size_t n, int margin, const Figures& f) {
  std::printf("%8zu %6s %10zu %10.1f %10.1f %10.1f %8.2f %8.2f %10.1f\n", n, margin > 0 ? "rows" : "all",
              f.bytes_down + f.bytes_up, 1e6 * f.exchange, 1e6 * f.sendrecv, 1e6 * f.ping_pong,
              f.exchange / f.sendrecv, f.exchange / f.ping_pong, 1e6 * f.control);
}

// About 10^3, 10^4, 10^5 cells, all of a patch (a column is one run of memory) or rows of a larger one.
struct Case {
  int n, margin;
};
const std::vector<Case> k_cases{{10, 0}, {22, 0}, {46, 0}, {46, 2}};
constexpr double k_work = 3.0;  // [s] that the other one waits for

int run_fv(Job& job) {
  auto partner = job.sph_partner(plan());
  std::printf(
      "one window's exchange, donors with derivatives one way, samples back; medians in microseconds\n"
      "%8s %6s %10s %10s %10s %10s %8s %8s %10s\n",
      "points", "of", "bytes", "exchange", "sendrecv", "ping-pong", "ratio", "ratio", "control");
  DonorValues donors;
  Samples samples;
  for (const auto& [n, margin] : k_cases) {
    DonorGeometry geometry;
    geometry.patches.push_back(cube(n, margin));
    const DonorPatch patch = cube(n, 0);
    Targets targets;
    targets.x = patch.x;
    targets.y = patch.y;
    targets.z = patch.z;
    targets.wants.assign(patch.size(), wants_state);
    partner->offer(geometry, targets);
    donors.resize(geometry.size(), false);
    for (auto* column : {&donors.p, &donors.u, &donors.v, &donors.w, &donors.dp_dt})
      std::fill(column->begin(), column->end(), 1.5);
    print(patch.size(), margin,
          measure(
              job, true, patch.size(),
              [&](const Window& window) {
                donors.time = donors.horizon_begin = window.t_begin;
                donors.horizon_end = window.t_end;
                partner->send(window, donors);
                partner->receive(window, samples);
              },
              [&] {
                const Window window = partner->agree(proposal(false, false)).window;
                partner->exchange(window, {});
                return window;
              }));
    partner->agree(proposal(true, false));
  }
  partner->offer({}, {});
  std::this_thread::sleep_for(std::chrono::duration<double>(k_work));
  partner->agree(proposal(false, true));
  partner->goodbye("measured");
  return 0;
}

int run_sph(Job& job) {
  auto partner = job.fv_partner(plan());
  DonorValues donors;
  Samples samples;
  for (const auto& [n_edge, margin] : k_cases) {
    const double end = n_edge - 1;
    const Box cells{{0.1, 0.1, 0.1}, {end - 0.1, end - 0.1, end - 0.1}},
        points{{-1, -1, -1}, {end + 1, end + 1, end + 1}};
    partner->announce(cells, points);
    const std::size_t n = partner->targets().size();
    samples.resize(n, false);
    std::fill(samples.p.begin(), samples.p.end(), 2.5);
    std::fill(samples.coverage.begin(), samples.coverage.end(), 1.0);
    std::fill(samples.status.begin(), samples.status.end(), SampleStatus::ok);
    measure(
        job, false, n,
        [&](const Window& window) {
          partner->receive(window, donors);
          samples.time = window.t_end;
          partner->send(window, samples);
        },
        [&] {
          const Window window = partner->agree(proposal(false, false)).window;
          partner->exchange(window, {});
          return window;
        });
    partner->agree(proposal(true, false));
  }
  partner->announce(Box::nothing(), Box::nothing());
  const double processor = processor_time(), wall = now();
  partner->agree(proposal(false, true));
  std::printf("waiting %.2f s for the partner took %.2f%% of a core\n", now() - wall,
              100.0 * (processor_time() - processor) / (now() - wall));
  partner->goodbye("measured");
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  Role role = argc > 1 && std::strcmp(argv[1], "fv") == 0 ? Role::fv : Role::sph;
  if (argc == 1) {  // one program on two ranks: the second plays the grid
    int rank = 0, provided = 0;
    MPI_Init_thread(&argc, &argv, MPI_THREAD_FUNNELED, &provided);
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    role = rank == 1 ? Role::fv : Role::sph;
  }
  return run_program(argc, argv, role, "benchmark",
                     [role](Job& job, int, char**) { return role == Role::fv ? run_fv(job) : run_sph(job); });
}
