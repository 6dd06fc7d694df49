#include "littoral/coupler/analytic.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "program.hpp"
#include "validate.hpp"

namespace littoral::coupler {

namespace {

Proposal no_limit() {
  Proposal proposal;
  proposal.dt_stable = std::numeric_limits<double>::infinity();
  return proposal;
}

/// Lattice of spacing h through (h/2, h/2, h/2), the same for every rank; y = 0 in the plane.
class Lattice {
 public:
  Lattice(double spacing, int dimension) : h_(spacing), planar_(dimension == 2) {}

  /// Centres in `box`, grown by `skin` layers; nothing for an empty box.
  DonorPatch patch(const Box& box, int skin) const {
    DonorPatch patch;
    if (box.empty()) return patch;
    std::array<int, 3> first{};
    for (std::size_t d = 0; d < 3; ++d) {
      const bool flat = planar_ && d == 1;
      first[d] = flat ? 0 : static_cast<int>(std::ceil(box.lower[d] / h_ - 0.5)) - skin;
      const int last = flat ? 0 : static_cast<int>(std::floor(box.upper[d] / h_ - 0.5)) + skin;
      patch.n[d] = std::max(0, last - first[d] + 1);
    }
    for (int k = 0; k < patch.n[2]; ++k)
      for (int j = 0; j < patch.n[1]; ++j)
        for (int i = 0; i < patch.n[0]; ++i) {
          patch.x.push_back((first[0] + i + 0.5) * h_);
          patch.y.push_back(planar_ ? 0.0 : (first[1] + j + 0.5) * h_);
          patch.z.push_back((first[2] + k + 0.5) * h_);
        }
    patch.usable.assign(patch.x.size(), 1);
    return patch;
  }

  /// The two outermost layers of centres in `box`, as the fringe of a grid would ask for.
  Targets fringe(const Box& box, bool with_phi) const {
    constexpr int k_layers = 2;
    const DonorPatch all = patch(box, 0);
    Targets targets;
    std::size_t c = 0;
    for (int k = 0; k < all.n[2]; ++k)
      for (int j = 0; j < all.n[1]; ++j)
        for (int i = 0; i < all.n[0]; ++i, ++c) {
          const auto outer = [](int index, int n) {
            return n > 1 && std::min(index, n - 1 - index) < k_layers;
          };
          if (!outer(i, all.n[0]) && !outer(j, all.n[1]) && !outer(k, all.n[2])) continue;
          targets.x.push_back(all.x[c]);
          targets.y.push_back(all.y[c]);
          targets.z.push_back(all.z[c]);
          targets.wants.push_back(
              static_cast<std::uint8_t>(with_phi ? wants_state | wants_phi : wants_state));
        }
    return targets;
  }

 private:
  double h_;
  bool planar_;
};

class AnalyticFv final : public FvPartner {
 public:
  AnalyticFv(Flow flow, const RunPlan& plan, double spacing, int dimension, MPI_Comm program)
      : flow_(std::move(flow)),
        plan_(plan),
        lattice_(spacing, dimension),
        sequence_(plan),
        program_(program) {}

  void announce(const Box& needs, const Box& covers) override {
    geometry_.patches.clear();
    auto patch = lattice_.patch(needs, 2);
    if (patch.size() > 0) geometry_.patches.push_back(std::move(patch));
    targets_ = lattice_.fringe(covers, plan_.with_phi);
    targets_.epoch = ++geometry_.epoch;
  }
  const DonorGeometry& donor_geometry() const override { return geometry_; }
  const Targets& targets() const override { return targets_; }

  Agreement agree(const Proposal& mine) override {
    return sequence_.advance(join(sequence_.limited(mine), program_), no_limit());
  }

  void receive(const Window& window, DonorValues& donors) override {
    donors.resize(geometry_.size(), plan_.with_phi);
    donors.time = donors.horizon_begin = window.t_begin;
    donors.horizon_end = window.t_end;
    // Schedules that interpolate towards t^n+1 use the secant; those that extrapolate the derivative at t^n,
    // by central differences so short that (24) alone decides the error.
    const bool interpolates =
        plan_.schedule.schedule == Schedule::predicted || plan_.schedule.schedule == Schedule::iterated;
    const double step = 0.01 * window.dt();
    const double before = interpolates ? window.t_begin : window.t_begin - step;
    const double after = interpolates ? window.t_end : window.t_begin + step;
    const double over = 1.0 / (after - before);
    std::size_t c = 0;
    for (const auto& patch : geometry_.patches)
      for (std::size_t i = 0; i < patch.size(); ++i, ++c) {
        const Vec3 x{patch.x[i], patch.y[i], patch.z[i]};
        const FlowState now = flow_(x, window.t_begin), a = flow_(x, before), b = flow_(x, after);
        donors.p[c] = now.p;
        donors.u[c] = now.u[0];
        donors.v[c] = now.u[1];
        donors.w[c] = now.u[2];
        donors.dp_dt[c] = (b.p - a.p) * over;
        donors.du_dt[c] = (b.u[0] - a.u[0]) * over;
        donors.dv_dt[c] = (b.u[1] - a.u[1]) * over;
        donors.dw_dt[c] = (b.u[2] - a.u[2]) * over;
        if (plan_.with_phi) {
          donors.phi[c] = now.phi;
          donors.dphi_dt[c] = (b.phi - a.phi) * over;
        }
      }
  }
  void send(const Window& window, const Samples& samples) override {
    validate(samples, targets_, window, "sph_solver");
  }
  void send_particles(const Window&, const ParticleStates&) override {}
  Ledger exchange(const Window&, const Ledger& mine) override { return sum(mine, program_); }
  void goodbye(const std::string&) override {}
  std::string description() const override { return "analytic flow on a lattice of centres"; }

 private:
  Flow flow_;
  RunPlan plan_;
  Lattice lattice_;
  Sequence sequence_;
  MPI_Comm program_;
  DonorGeometry geometry_;
  Targets targets_;
};

class AnalyticSph final : public SphPartner {
 public:
  AnalyticSph(Flow flow, const RunPlan& plan, MPI_Comm program)
      : flow_(std::move(flow)), plan_(plan), sequence_(plan), program_(program) {}

  void offer(const DonorGeometry& donors, const Targets& targets) override {
    validate(donors, "fv_solver");
    validate(targets, "fv_solver");
    geometry_ = donors;
    targets_ = targets;
  }
  Agreement agree(const Proposal& mine) override {
    return sequence_.advance(no_limit(), join(sequence_.limited(mine), program_));
  }
  void send(const Window& window, const DonorValues& donors) override {
    validate(donors, geometry_, window, "fv_solver");
  }
  void receive(const Window& window, Samples& samples) override {
    samples.resize(targets_.size(), plan_.with_phi);
    samples.time = window.t_end;
    for (std::size_t i = 0; i < targets_.size(); ++i) {
      const FlowState state = flow_({targets_.x[i], targets_.y[i], targets_.z[i]}, window.t_end);
      const bool dry = state.phi > 0.0;
      samples.p[i] = state.p;
      samples.u[i] = state.u[0];
      samples.v[i] = state.u[1];
      samples.w[i] = state.u[2];
      samples.coverage[i] = dry ? 0.0 : 1.0;
      samples.status[i] = dry ? SampleStatus::dry : SampleStatus::ok;
      if (plan_.with_phi) samples.phi[i] = state.phi;
    }
  }
  void receive_particles(const Window& window, ParticleStates& states) override {
    states = ParticleStates{};  // a formula has no particles
    states.time = window.t_end;
  }
  Ledger exchange(const Window&, const Ledger& mine) override { return sum(mine, program_); }
  void goodbye(const std::string&) override {}
  std::string description() const override { return "analytic flow"; }

 private:
  Flow flow_;
  RunPlan plan_;
  Sequence sequence_;
  MPI_Comm program_;
  DonorGeometry geometry_;
  Targets targets_;
};

}  // namespace

std::unique_ptr<FvPartner> analytic_fv_partner(const Flow& flow, const RunPlan& plan, double spacing,
                                               int dimension, MPI_Comm program) {
  return std::make_unique<AnalyticFv>(flow, plan, spacing, dimension, program);
}

std::unique_ptr<SphPartner> analytic_sph_partner(const Flow& flow, const RunPlan& plan, MPI_Comm program) {
  return std::make_unique<AnalyticSph>(flow, plan, program);
}

}  // namespace littoral::coupler
