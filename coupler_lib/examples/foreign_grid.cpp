// A grid solver of one's own that couples with sph_solver: still water that it knows by formula. Whatever a
// real solver would compute stands in still_water(); the rest is all that coupling takes.
#include <littoral/coupler/job.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

using namespace littoral::coupler;

// What scene.yaml of the run says. The handshake lists every entry in which the two programs differ.
constexpr double k_density = 1000.0, k_gravity = 10.0, k_sound_speed = 30.0, k_dt = 0.01, k_end = 0.1;
constexpr Vec3 k_region_lower = {0.0, 0.0, -0.5}, k_region_upper = {1.0, 0.0, 0.2};

Contract contract() {
  Contract c;
  c.set("dimension", 2.0).set("axes", "x right, z up, plane (x, z)").set("sign of phi", "negative in water");
  c.set("fluid.density", k_density).set("fluid.sound_speed", k_sound_speed);
  c.set("fluid.reference_pressure", 0.0).set("fluid.viscosity", 0.0);
  c.set("gravity.x", 0.0).set("gravity.y", 0.0).set("gravity.z", -k_gravity).set("free surface", "yes");
  c.set("phi crosses", "no").set("regions", 1.0);
  const char* axes[] = {"x", "y", "z"};
  for (std::size_t d = 0; d < 3; ++d) {
    c.set(std::string("regions[0].lower.") + axes[d], k_region_lower[d]);
    c.set(std::string("regions[0].upper.") + axes[d], k_region_upper[d]);
  }
  c.set("coupling.kind", "imposed").set("coupling.schedule", "serial").set("coupling.passes", 1.0);
  return c.set("coupling.dt", k_dt).set("time.end", k_end), c;
}

double still_water(double z) { return -k_density * k_gravity * z; }

// Columns of cells of size h from x = -1 to 2 and z = -1 to 0.4, divided among the ranks. Each rank adds a
// column of its neighbours': particles between two ranks then find all their donors on one of them.
constexpr double k_h = 0.05;
constexpr int k_columns = 60, k_rows = 28;
double centre(int cell) { return -1.0 + (cell + 0.5) * k_h; }

int run(Job& job, int, char**) {
  if (!job.has_partner()) return std::puts("foreign_grid: start me with sph_solver in one mpirun"), 1;
  job.compare(contract());

  RunPlan plan;
  plan.schedule.schedule = Schedule::serial;
  plan.window.dt = k_dt;
  plan.end_time = k_end;
  plan.with_phi = false;  // the interface lies under water: phi is the particles' own affair
  const auto sph = job.sph_partner(plan);

  const int begin = k_columns * job.rank() / job.size(), end = k_columns * (job.rank() + 1) / job.size();
  DonorGeometry cells;
  DonorPatch patch;
  patch.n = {std::min(end + 1, k_columns) - std::max(begin - 1, 0), 1, k_rows};
  Targets wanted;  // SPH values where particles and this grid overlap
  for (int k = 0; k < k_rows; ++k)
    for (int i = std::max(begin - 1, 0); i < std::min(end + 1, k_columns); ++i) {
      const double x = centre(i), z = centre(k);
      patch.x.push_back(x), patch.y.push_back(0.0), patch.z.push_back(z), patch.usable.push_back(1);
      const bool in_region = x > k_region_lower[0] && x < k_region_upper[0] && z > k_region_lower[2];
      if (i < begin || i >= end || !in_region || z > -k_h) continue;
      wanted.x.push_back(x), wanted.y.push_back(0.0), wanted.z.push_back(z);
      wanted.wants.push_back(wants_state);
    }
  cells.patches.push_back(patch);
  sph->offer(cells, wanted);

  DonorValues donors;
  donors.resize(cells.size(), plan.with_phi);  // all rates and velocities are zero: the water is still
  for (std::size_t c = 0; c < cells.size(); ++c) donors.p[c] = still_water(patch.z[c]);
  Samples samples;
  Proposal proposal;
  proposal.dt_stable = std::numeric_limits<double>::infinity();
  for (;;) {
    const Agreement agreement = sph->agree(proposal);
    if (agreement.stop) return sph->goodbye(agreement.reason), 0;
    const Window& window = agreement.window;
    set_place(window.index, window.t_begin);
    if (agreement.region_changed) sph->offer(cells, wanted);
    donors.time = donors.horizon_begin = window.t_begin;
    donors.horizon_end = window.t_end;
    sph->send(window, donors);      // here a solver would advance ...
    sph->receive(window, samples);  // ... or here, with the samples as its boundary values
    double worst = 0.0;
    int ok = 0;
    for (std::size_t i = 0; i < wanted.size(); ++i) {
      if (samples.status[i] != SampleStatus::ok) continue;
      ++ok;
      worst = std::max(worst, std::abs(samples.p[i] - still_water(wanted.z[i])));
    }
    sph->exchange(window, Ledger{});
    std::printf("foreign_grid %d: t = %g s, %d of %zu samples, pressure off by %.1e Pa at most\n", job.rank(),
                window.t_end, ok, wanted.size(), worst);
  }
}

int main(int argc, char** argv) { return run_program(argc, argv, Role::fv, "example", run); }
