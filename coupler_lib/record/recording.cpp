#include <utility>

#include "littoral/coupler/record.hpp"
#include "question.hpp"
#include "tape.hpp"

namespace littoral::coupler {

namespace {

void put(TapeWriter& tape, const Question& asked) {
  tape.put("announce/edges", asked.edges.data(), asked.edges.size());
  tape.put("announce/counts", asked.counts.data(), asked.counts.size());
  tape.put(Call{CallKind::announce, {}, asked.counts[0]});
}

void put(TapeWriter& tape, const DonorGeometry& geometry, const Targets& targets) {
  const std::array<std::int64_t, 3> head = {geometry.epoch, targets.epoch,
                                            static_cast<std::int64_t>(geometry.patches.size())};
  tape.put("geometry/epoch_target_epoch_patches", head.data(), head.size());
  for (const auto& patch : geometry.patches) {
    const std::array<std::int64_t, 3> n = {patch.n[0], patch.n[1], patch.n[2]};
    tape.put("geometry/n", n.data(), n.size());
    tape.put_columns(
        "geometry", [](const auto& p, auto visit) { each_patch_column(p, visit); }, patch);
  }
  tape.put_columns(
      "targets", [](const auto& t, auto visit) { each_target_column(t, visit); }, targets);
}

void put(TapeWriter& tape, CallKind kind, const Window& window, const std::string& reason) {
  const auto* letters = reinterpret_cast<const std::uint8_t*>(reason.data());
  tape.put(std::string(name(kind)) + "/reason", letters, reason.size());
  tape.put(Call{kind, window, static_cast<std::int64_t>(reason.size())});
}

void put(TapeWriter& tape, const Agreement& agreement) {
  std::array<std::uint8_t, k_agreement_flags.size()> flags;
  for (std::size_t i = 0; i < flags.size(); ++i) flags[i] = agreement.*k_agreement_flags[i];
  tape.put("agree/flags", flags.data(), flags.size());
  put(tape, CallKind::agree, agreement.window, agreement.reason);
  if (agreement.stop) tape.commit();
}

void put(TapeWriter& tape, const Window& window, const Ledger& ledger) {
  std::array<double, k_ledger_members.size()> values;
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = ledger.*k_ledger_members[i];
  tape.put("exchange/ledger", values.data(), values.size());
  tape.put(Call{CallKind::exchange, window, 0});
  tape.commit();  // the window is over
}

void put(TapeWriter& tape, CallKind kind, const Window& window, std::size_t count) {
  tape.put(Call{kind, window, static_cast<std::int64_t>(count)});
}

/// What both sides answer alike.
template <class Partner>
class Recording : public Partner {
 public:
  Agreement agree(const Proposal& mine) override {
    const Agreement agreement = real_->agree(mine);
    put(tape_, agreement);
    return agreement;
  }
  Ledger exchange(const Window& window, const Ledger& mine) override {
    const Ledger ledger = real_->exchange(window, mine);
    put(tape_, window, ledger);
    return ledger;
  }
  void goodbye(const std::string& reason) override {
    real_->goodbye(reason);
    put(tape_, CallKind::goodbye, {}, reason);
    tape_.commit();
  }
  double waited() const override { return real_->waited(); }
  std::string description() const override { return real_->description() + ", recorded"; }

 protected:
  Recording(std::unique_ptr<Partner> real, const std::string& path, Role speaker, const std::string& scene)
      : real_(std::move(real)), tape_(path, speaker, real_->description(), scene) {}

  std::unique_ptr<Partner> real_;
  TapeWriter tape_;
};

class RecordingFv final : public Recording<FvPartner> {
 public:
  RecordingFv(std::unique_ptr<FvPartner> real, const std::string& path, const std::string& scene)
      : Recording(std::move(real), path, Role::fv, scene) {}

  void announce(const Box& needs, const Box& covers) override {
    real_->announce(needs, covers);
    put(tape_, real_->donor_geometry(), real_->targets());
    put(tape_, Question::of(needs, covers));
  }
  const DonorGeometry& donor_geometry() const override { return real_->donor_geometry(); }
  const Targets& targets() const override { return real_->targets(); }
  void receive(const Window& window, DonorValues& donors) override {
    real_->receive(window, donors);
    const std::array<double, 3> times = {donors.time, donors.horizon_begin, donors.horizon_end};
    tape_.put("donors/time_horizon_begin_end", times.data(), times.size());
    tape_.put_columns(
        "donors", [](const auto& d, auto visit) { each_donor_column(d, visit); }, donors);
    put(tape_, CallKind::receive, window, donors.p.size());
  }
  void send(const Window& window, const Samples& samples) override {
    real_->send(window, samples);
    put(tape_, CallKind::send, window, samples.p.size());
  }
  void send_particles(const Window& window, const ParticleStates& states) override {
    real_->send_particles(window, states);
    put(tape_, CallKind::particles, window, states.size());
  }
};

class RecordingSph final : public Recording<SphPartner> {
 public:
  RecordingSph(std::unique_ptr<SphPartner> real, const std::string& path, const std::string& scene)
      : Recording(std::move(real), path, Role::sph, scene) {}

  void offer(const DonorGeometry& donors, const Targets& targets) override {
    real_->offer(donors, targets);
    put(tape_, Question::of(donors, targets));
  }
  void send(const Window& window, const DonorValues& donors) override {
    real_->send(window, donors);
    put(tape_, CallKind::send, window, donors.p.size());
  }
  void receive(const Window& window, Samples& samples) override {
    real_->receive(window, samples);
    tape_.put("samples/time", &samples.time, 1);
    tape_.put_columns(
        "samples", [](const auto& s, auto visit) { each_sample_column(s, visit); }, samples);
    put(tape_, CallKind::receive, window, samples.p.size());
  }
  void receive_particles(const Window& window, ParticleStates& states) override {
    real_->receive_particles(window, states);
    tape_.put("particles/time", &states.time, 1);
    tape_.put_columns(
        "particles", [](const auto& s, auto visit) { each_particle_column(s, visit); }, states);
    put(tape_, CallKind::particles, window, states.size());
  }
};

}  // namespace

std::unique_ptr<FvPartner> recording(std::unique_ptr<FvPartner> real, const std::string& path,
                                     const std::string& scene) {
  return std::make_unique<RecordingFv>(std::move(real), path, scene);
}

std::unique_ptr<SphPartner> recording(std::unique_ptr<SphPartner> real, const std::string& path,
                                      const std::string& scene) {
  return std::make_unique<RecordingSph>(std::move(real), path, scene);
}

}  // namespace littoral::coupler
