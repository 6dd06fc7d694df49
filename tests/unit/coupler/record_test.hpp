#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "littoral/coupler/analytic.hpp"
#include "littoral/coupler/record.hpp"
#include "littoral/error.hpp"

namespace littoral::coupler {

// Partners whose every word is their own, and programs that write down all they hear: what the tests of
// records share.

inline const Box k_needs = {{0, 0, 0}, {1, 0, 1}};
inline const Box k_covers = {{0.2, 0, 0.2}, {0.8, 0, 0.8}};

inline RunPlan plan_of(int windows) {
  RunPlan plan;
  plan.schedule = {Schedule::iterated, 2};
  plan.window.dt = 0.1;
  plan.end_time = 0.1 * windows;
  plan.with_phi = true;
  return plan;
}
inline Proposal stable(double dt) {
  Proposal proposal;
  proposal.dt_stable = dt;
  return proposal;
}

/// Numbers with every bit in use, so that a conversion to fewer digits would show.
struct Noise {
  std::uint64_t state = 88172645463325252ULL;
  double operator()() {
    state ^= state << 13, state ^= state >> 7, state ^= state << 17;
    return static_cast<double>(state) / 3.0e18 - 1.0;
  }
  void fill(std::vector<double>& values) {
    for (auto& value : values) value = (*this)();
  }
};

/// The grid of a run in several blocks whose region changes after the second window: geometry, epochs, flags,
/// reasons and values are all its own.
class ChangingFv final : public FvPartner {
 public:
  void announce(const Box&, const Box&) override {
    geometry_.patches.clear();
    for (int b = 0; b <= geometry_.epoch; ++b) {
      DonorPatch patch;
      patch.n = {3 + b, 1, 2};
      const auto n = static_cast<std::size_t>(6 + 2 * b);
      for (auto* x : {&patch.x, &patch.y, &patch.z}) x->resize(n), noise_.fill(*x);
      patch.usable.assign(n, 1);
      patch.usable[static_cast<std::size_t>(b)] = 0;
      geometry_.patches.push_back(patch);
    }
    targets_.epoch = ++geometry_.epoch;
    const auto n = static_cast<std::size_t>(2 + geometry_.epoch);
    for (auto* x : {&targets_.x, &targets_.y, &targets_.z}) x->resize(n), noise_.fill(*x);
    targets_.wants.assign(n, wants_phi);
  }
  const DonorGeometry& donor_geometry() const override { return geometry_; }
  const Targets& targets() const override { return targets_; }
  Agreement agree(const Proposal& mine) override {
    Agreement agreement = coupler::agree(mine, stable(0.1), plan_of(4).window, index_++, time_, 0.4);
    agreement.region_changed = agreement.window.index == 1;
    agreement.wants_particles = agreement.window.index == 2;
    time_ = agreement.window.t_end;
    return agreement;
  }
  void receive(const Window& window, DonorValues& donors) override {
    donors.resize(geometry_.size(), window.index % 2 == 0);
    donors.time = donors.horizon_begin = window.t_begin;
    donors.horizon_end = window.t_end;
    for (auto* column : {&donors.p, &donors.u, &donors.v, &donors.w, &donors.dp_dt, &donors.du_dt,
                         &donors.dv_dt, &donors.dw_dt, &donors.phi, &donors.dphi_dt})
      noise_.fill(*column);
    donors.p[0] = -0.0;  // keeps its sign, and a blanked cell its NaN
    donors.u[0] = std::numeric_limits<double>::quiet_NaN();
  }
  void send(const Window&, const Samples&) override {}
  void send_particles(const Window&, const ParticleStates&) override {}
  Ledger exchange(const Window&, const Ledger& mine) override {
    Ledger ledger = mine;
    ledger.fv_mass_flux = noise_();
    ledger.defect = noise_();
    return ledger;
  }
  void goodbye(const std::string&) override {}
  std::string description() const override { return "a grid that changes"; }

 private:
  Noise noise_;
  DonorGeometry geometry_;
  Targets targets_;
  std::int64_t index_ = 0;
  double time_ = 0.0;
};

/// Particles likewise.
class ChangingSph final : public SphPartner {
 public:
  void offer(const DonorGeometry&, const Targets& targets) override { n_ = targets.size(); }
  Agreement agree(const Proposal& mine) override {
    Agreement agreement = coupler::agree(stable(0.03), mine, plan_of(3).window, index_++, time_, 0.3);
    agreement.wants_particles = !agreement.stop;
    time_ = agreement.window.t_end;
    return agreement;
  }
  void send(const Window&, const DonorValues&) override {}
  void receive(const Window& window, Samples& samples) override {
    samples.resize(n_, true);
    samples.time = window.t_end;
    for (auto* column : {&samples.p, &samples.u, &samples.v, &samples.w, &samples.phi, &samples.coverage})
      noise_.fill(*column);
    samples.status[0] = SampleStatus::dry;
  }
  void receive_particles(const Window& window, ParticleStates& states) override {
    const auto n = static_cast<std::size_t>(window.index);  // none in the first window
    states.time = window.t_end;
    for (auto* c : {&states.x, &states.y, &states.z, &states.u, &states.v, &states.w, &states.p, &states.V,
                    &states.nx, &states.ny, &states.nz})
      c->resize(n), noise_.fill(*c);
    states.on_surface.assign(n, 1);
  }
  Ledger exchange(const Window&, const Ledger&) override {
    Ledger ledger;
    ledger.n_injected = noise_();
    return ledger;
  }
  void goodbye(const std::string&) override {}
  std::string description() const override { return "particles that change"; }

 private:
  Noise noise_;
  std::size_t n_ = 0;
  std::int64_t index_ = 0;
  double time_ = 0.0;
};

/// Everything a partner said, as bytes.
class Said {
 public:
  template <class T>
  Said& operator<<(const std::vector<T>& values) {
    *this << static_cast<std::int64_t>(values.size());
    for (const auto& value : values) *this << value;
    return *this;
  }
  template <class T>
  std::enable_if_t<std::is_trivially_copyable_v<T>, Said&> operator<<(const T& value) {
    const auto* begin = reinterpret_cast<const char*>(&value);
    bytes.append(begin, sizeof value);
    return *this;
  }
  Said& operator<<(const Agreement& a) {
    *this << a.window.index << a.window.t_begin << a.window.t_end << a.window.substeps;
    *this << a.write << a.checkpoint << a.stop << a.region_changed << a.wants_particles;
    bytes += a.reason;
    return *this;
  }
  Said& operator<<(const FvPartner& fv) {
    *this << fv.donor_geometry().epoch << fv.targets().epoch;
    for (const auto& patch : fv.donor_geometry().patches)
      *this << patch.n << patch.x << patch.y << patch.z << patch.usable;
    return *this << fv.targets().x << fv.targets().y << fv.targets().z << fv.targets().wants;
  }
  Said& operator<<(const DonorValues& d) {
    *this << d.time << d.horizon_begin << d.horizon_end << d.p << d.u << d.v << d.w;
    return *this << d.dp_dt << d.du_dt << d.dv_dt << d.dw_dt << d.phi << d.dphi_dt;
  }
  Said& operator<<(const Samples& s) {
    return *this << s.time << s.p << s.u << s.v << s.w << s.phi << s.coverage << s.status;
  }
  Said& operator<<(const ParticleStates& s) {
    *this << s.time << s.x << s.y << s.z << s.u << s.v << s.w << s.p << s.V;
    return *this << s.on_surface << s.nx << s.ny << s.nz;
  }
  std::string bytes;
};

/// What sph_solver would ask in a run, up to its goodbye or, before it, the end of `windows` windows.
inline std::string run(FvPartner& fv, int windows = 1000) {
  Said said;
  fv.announce(k_needs, k_covers);
  said << fv;
  DonorValues donors;
  for (int w = 0; w < windows; ++w) {
    const Agreement agreement = fv.agree(stable(0.03));
    said << agreement;
    if (agreement.stop) return fv.goodbye("the end"), said.bytes;
    for (int pass = 0; pass < 2; ++pass) {
      fv.receive(agreement.window, donors);
      Samples samples;
      samples.resize(fv.targets().size(), true);
      samples.time = agreement.window.t_end;
      fv.send(agreement.window, samples);
      said << donors;
    }
    if (agreement.wants_particles) fv.send_particles(agreement.window, {});
    Ledger ledger;
    ledger.mass_flux = 0.1 * w;
    said << fv.exchange(agreement.window, ledger);
    if (agreement.region_changed) fv.announce(k_needs, k_covers), said << fv;
  }
  return said.bytes;
}

inline Targets some_targets(double x = 0.25) {
  Targets targets;
  targets.x = {x, 0.5};
  targets.y = {0.0, 0.0};
  targets.z = {0.5, 0.5};
  targets.wants.assign(2, wants_state);
  return targets;
}

/// What fv_solver would ask.
inline std::string run(SphPartner& sph) {
  Said said;
  sph.offer({}, some_targets());
  Samples samples;
  ParticleStates states;
  for (;;) {
    const Agreement agreement = sph.agree(stable(0.1));
    said << agreement;
    if (agreement.stop) return sph.goodbye("the end"), said.bytes;
    sph.send(agreement.window, {});
    sph.receive(agreement.window, samples);
    sph.receive_particles(agreement.window, states);
    said << samples << states << sph.exchange(agreement.window, {});
  }
}

/// A folder for the files of one test.
class RecordTest : public ::testing::Test {
 protected:
  RecordTest() {
    std::string pattern = (std::filesystem::temp_directory_path() / "littoral_record_XXXXXX").string();
    folder_ = mkdtemp(pattern.data());
  }
  ~RecordTest() override { std::filesystem::remove_all(folder_); }
  std::string path(const std::string& name = "run.h5") const { return folder_ + "/" + name; }
  /// A record of an analytic grid, four windows and a goodbye.
  std::string recorded() const {
    run(*recording(analytic_fv_partner(uniform_stream({1, 0, 0}, 2.0), plan_of(4), 0.25, 2), path()));
    return path();
  }
  /// Runs `asks`, which must be refused with these words.
  template <class Exception = CouplingError, class Asks>
  static void expect_refused(const std::string& words, const Asks& asks) {
    try {
      asks();
      FAIL() << "not refused: " << words;
    } catch (const Exception& error) {
      EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
    }
  }

 private:
  std::string folder_;
};

}  // namespace littoral::coupler
