#include "littoral/coupler/record.hpp"
#include "script.hpp"

namespace littoral::coupler {

namespace {

void get(TapeReader& tape, DonorGeometry& geometry, Targets& targets) {
  std::array<std::int64_t, 3> head{};
  tape.get("geometry/epoch_target_epoch_patches", head.data(), head.size());
  geometry.epoch = head[0];
  targets.epoch = head[1];
  geometry.patches.assign(tape.checked_length("geometry/n", 3 * head[2]) / 3, {});
  for (auto& patch : geometry.patches) {
    std::array<std::int64_t, 3> n{};
    tape.get("geometry/n", n.data(), n.size());
    for (std::size_t d = 0; d < 3; ++d) patch.n[d] = static_cast<int>(n[d]);
    tape.get_columns(
        "geometry", [](auto& p, auto visit) { each_patch_column(p, visit); }, patch);
  }
  tape.get_columns(
      "targets", [](auto& t, auto visit) { each_target_column(t, visit); }, targets);
}

class ReplayedFv final : public FvPartner {
 public:
  ReplayedFv(const std::string& path, const std::string& scene) : script_(path, Role::fv, scene) {}

  void announce(const Box& needs, const Box& covers) override {
    script_.announce(Question::of(needs, covers));
    get(script_.tape(), geometry_, targets_);
  }
  const DonorGeometry& donor_geometry() const override { return geometry_; }
  const Targets& targets() const override { return targets_; }
  Agreement agree(const Proposal& mine) override { return script_.agree(mine, Role::sph); }
  void receive(const Window& window, DonorValues& donors) override {
    script_.expect(CallKind::receive, window);
    std::array<double, 3> times{};
    script_.tape().get("donors/time_horizon_begin_end", times.data(), times.size());
    donors.time = times[0];
    donors.horizon_begin = times[1];
    donors.horizon_end = times[2];
    script_.tape().get_columns(
        "donors", [](auto& d, auto visit) { each_donor_column(d, visit); }, donors);
  }
  void send(const Window& window, const Samples& samples) override {
    script_.expect(CallKind::send, window, samples.p.size());
  }
  // How many particles there are hangs on round-off, and no answer hangs on it.
  void send_particles(const Window& window, const ParticleStates&) override {
    script_.expect(CallKind::particles, window);
  }
  Ledger exchange(const Window& window, const Ledger&) override { return script_.exchange(window); }
  void goodbye(const std::string&) override { script_.goodbye(); }
  std::string description() const override { return script_.description(); }

 private:
  Script script_;
  DonorGeometry geometry_;
  Targets targets_;
};

class ReplayedSph final : public SphPartner {
 public:
  ReplayedSph(const std::string& path, const std::string& scene) : script_(path, Role::sph, scene) {}

  void offer(const DonorGeometry& donors, const Targets& targets) override {
    script_.announce(Question::of(donors, targets));
  }
  Agreement agree(const Proposal& mine) override { return script_.agree(mine, Role::fv); }
  void send(const Window& window, const DonorValues& donors) override {
    script_.expect(CallKind::send, window, donors.p.size());
  }
  void receive(const Window& window, Samples& samples) override {
    script_.expect(CallKind::receive, window);
    script_.tape().get("samples/time", &samples.time, 1);
    script_.tape().get_columns(
        "samples", [](auto& s, auto visit) { each_sample_column(s, visit); }, samples);
  }
  void receive_particles(const Window& window, ParticleStates& states) override {
    script_.expect(CallKind::particles, window);
    script_.tape().get("particles/time", &states.time, 1);
    script_.tape().get_columns(
        "particles", [](auto& s, auto visit) { each_particle_column(s, visit); }, states);
  }
  Ledger exchange(const Window& window, const Ledger&) override { return script_.exchange(window); }
  void goodbye(const std::string&) override { script_.goodbye(); }
  std::string description() const override { return script_.description(); }

 private:
  Script script_;
};

}  // namespace

std::unique_ptr<FvPartner> replayed_fv_partner(const std::string& path, const std::string& scene) {
  return std::make_unique<ReplayedFv>(path, scene);
}

std::unique_ptr<SphPartner> replayed_sph_partner(const std::string& path, const std::string& scene) {
  return std::make_unique<ReplayedSph>(path, scene);
}

}  // namespace littoral::coupler
