#include "script.hpp"

#include <cmath>
#include <cstdio>

namespace littoral::coupler {

namespace {

// Times are sums of window lengths: closer than this (relative to the window) they are the same.
constexpr double k_round_off = 1e-9;

std::string text_of(const Window& w) {
  std::array<char, 96> text;
  std::snprintf(text.data(), text.size(), "window %lld (%.9g to %.9g s, %d substeps)",
                static_cast<long long>(w.index), w.t_begin, w.t_end, w.substeps);
  return text.data();
}

std::string text_of(const Box& b) {
  if (b.empty()) return "nothing";
  std::array<char, 192> text;
  std::snprintf(text.data(), text.size(), "(%.9g, %.9g, %.9g) to (%.9g, %.9g, %.9g)", b.lower[0], b.lower[1],
                b.lower[2], b.upper[0], b.upper[1], b.upper[2]);
  return text.data();
}

bool same(const Window& a, const Window& b) {
  const double tolerance = k_round_off * std::abs(a.dt());
  return a.index == b.index && a.substeps == b.substeps && std::abs(a.t_begin - b.t_begin) <= tolerance &&
         std::abs(a.t_end - b.t_end) <= tolerance;
}

bool has_window(CallKind kind) { return kind != CallKind::announce && kind != CallKind::goodbye; }

}  // namespace

void Script::refuse(const std::string& what) const {
  throw CouplingError(tape_.path() + ", call " + std::to_string(at_ + 1) + " of " +
                      std::to_string(tape_.calls().size()) + ": " + what);
}

const Call& Script::due(CallKind kind) const {
  const std::string asked = std::string("'") + name(kind) + "'";
  if (said_goodbye_) refuse(asked + " is asked after the goodbye");
  if (stopped_) refuse(asked + " is asked after a stop that this run itself wished");
  if (at_ >= tape_.calls().size())
    refuse("the record is exhausted and " + asked +
           " is asked; it ends without a goodbye, so its run was cut off there");
  const Call& due = tape_.calls()[at_];
  if (due.kind != kind)
    refuse(asked + " is asked where the recorded run asked '" + name(due.kind) + "'" +
           (has_window(due.kind) ? " for " + text_of(due.window) : ""));
  return due;
}

void Script::expect(CallKind kind, const Window& window, std::optional<std::size_t> count) {
  const Call& due = this->due(kind);
  const std::string asked = std::string("'") + name(kind) + "' is asked ";
  if (!same(due.window, window))
    refuse(asked + "for " + text_of(window) + ", recorded is " + text_of(due.window));
  if (count && static_cast<std::int64_t>(*count) != due.count)
    refuse(asked + "with " + std::to_string(*count) + " values in window " + std::to_string(window.index) +
           ", recorded are " + std::to_string(due.count));
  ++at_;
}

void Script::announce(const Question& asked) {
  due(CallKind::announce);
  Question recorded;
  tape_.get("announce/edges", recorded.edges.data(), recorded.edges.size());
  tape_.get("announce/counts", recorded.counts.data(), recorded.counts.size());
  for (std::size_t i = 0; i < 2; ++i) {
    if (asked.counts[i] != recorded.counts[i])
      refuse(std::to_string(asked.counts[i]) + (i == 0 ? " donors" : " targets") +
             " are offered, recorded are " + std::to_string(recorded.counts[i]));
    if (!coupler::same(recorded.box(i), asked.box(i)))
      refuse("the region announced is " + text_of(asked.box(i)) + ", recorded is " +
             text_of(recorded.box(i)));
  }
  ++at_;
}

std::string Script::reason(const Call& call) {
  const std::string track = std::string(name(call.kind)) + "/reason";
  std::string text(tape_.checked_length(track, call.count), '\0');
  tape_.get(track, reinterpret_cast<std::uint8_t*>(text.data()), text.size());
  return text;
}

Agreement Script::agree(const Proposal& mine, Role asking) {
  const Call& due = this->due(CallKind::agree);
  Agreement agreement;
  std::array<std::uint8_t, k_agreement_flags.size()> flags;
  tape_.get("agree/flags", flags.data(), flags.size());
  for (std::size_t i = 0; i < flags.size(); ++i) agreement.*k_agreement_flags[i] = flags[i] != 0;
  agreement.window = due.window;
  agreement.reason = reason(due);
  // Writing changes nothing that the partner says, and a run may end before the record does.
  agreement.write = agreement.write || mine.write;
  agreement.checkpoint = agreement.checkpoint || mine.checkpoint;
  if (agreement.stop) return ++at_, agreement;
  if (mine.stop) {
    stopped_ = agreement.stop = true;
    agreement.reason = mine.reason;
    agreement.window.t_end = agreement.window.t_begin;
    agreement.window.substeps = 1;
    return agreement;
  }
  if (mine.region_changed && !agreement.region_changed)
    refuse("a change of the region is proposed that the recorded run did not make");
  if (mine.wants_particles && !agreement.wants_particles)
    refuse("particles are wanted that the recorded run did not ask for");
  const double step = asking == Role::sph ? due.window.substep_dt() : due.window.dt();
  if (!(step <= mine.dt_stable * (1.0 + 2.0 * k_round_off))) {
    std::array<char, 64> text;
    std::snprintf(text.data(), text.size(), "%.9g s, recorded are %.9g s", mine.dt_stable, step);
    refuse("the longest step proposed for " + text_of(due.window) + " is " + text.data());
  }
  ++at_;
  return agreement;
}

Ledger Script::exchange(const Window& window) {
  expect(CallKind::exchange, window);
  std::array<double, k_ledger_members.size()> values;
  tape_.get("exchange/ledger", values.data(), values.size());
  Ledger ledger;
  for (std::size_t i = 0; i < values.size(); ++i) ledger.*k_ledger_members[i] = values[i];
  return ledger;
}

void Script::goodbye() {
  if (!stopped_ || said_goodbye_) due(CallKind::goodbye);
  said_goodbye_ = true;
}

}  // namespace littoral::coupler
