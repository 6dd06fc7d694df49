#include <algorithm>
#include <array>
#include <utility>

#include "payload.hpp"
#include "validate.hpp"
#include "wire.hpp"

namespace littoral::coupler {

namespace {

template <class Values>
using Columns = std::array<std::pair<const char*, std::vector<double> Values::*>, 8>;

constexpr Columns<DonorValues> k_donor_columns{{{"p", &DonorValues::p},
                                                {"u", &DonorValues::u},
                                                {"v", &DonorValues::v},
                                                {"w", &DonorValues::w},
                                                {"dp_dt", &DonorValues::dp_dt},
                                                {"du_dt", &DonorValues::du_dt},
                                                {"dv_dt", &DonorValues::dv_dt},
                                                {"dw_dt", &DonorValues::dw_dt}}};
constexpr std::array<std::pair<const char*, std::vector<double> DonorValues::*>, 2> k_phi_columns{
    {{"phi", &DonorValues::phi}, {"dphi_dt", &DonorValues::dphi_dt}}};
constexpr std::array<std::pair<const char*, std::vector<double> Samples::*>, 4> k_sample_columns{
    {{"p", &Samples::p}, {"u", &Samples::u}, {"v", &Samples::v}, {"w", &Samples::w}}};
constexpr Columns<ParticleStates> k_particle_columns{{{"x", &ParticleStates::x},
                                                      {"y", &ParticleStates::y},
                                                      {"z", &ParticleStates::z},
                                                      {"u", &ParticleStates::u},
                                                      {"v", &ParticleStates::v},
                                                      {"w", &ParticleStates::w},
                                                      {"p", &ParticleStates::p},
                                                      {"V", &ParticleStates::V}}};
constexpr std::array<std::pair<const char*, std::vector<double> ParticleStates::*>, 3> k_normal_columns{
    {{"nx", &ParticleStates::nx}, {"ny", &ParticleStates::ny}, {"nz", &ParticleStates::nz}}};

void begin(Bytes& message) { message.resize(sizeof(Header)); }

void refuse_if_not_finite(const double* values, std::size_t n, const std::uint8_t* matters, const char* field,
                          const char* of, const std::string& who) {
  const std::size_t bad = count_not_finite(values, n, matters);
  if (bad > 0)
    throw CouplingError(who + " sent " + of + " with " + std::to_string(bad) + " of " + std::to_string(n) +
                        " values of " + field + " NaN or infinite");
}

template <class T>
Piece piece(const std::vector<T>& column, std::size_t first, std::size_t n) {
  return {reinterpret_cast<const char*>(column.data() + first), n * sizeof(T)};
}

}  // namespace

void pack(Outgoing& outgoing, const DonorValues& values, const std::vector<Run>& runs, bool with_phi) {
  begin(outgoing.message);
  outgoing.columns.clear();
  outgoing.gathered.clear();
  ByteWriter(outgoing.message)
      .value(DonorPrelude{with_phi ? 1U : 0U, values.time, values.horizon_begin, values.horizon_end});
  std::size_t n = 0;
  for (const auto& run : runs) n += run.n;
  const std::size_t n_columns = k_donor_columns.size() + (with_phi ? k_phi_columns.size() : 0);
  // one run is sent from where it lies; more are brought together
  if (runs.size() > 1) outgoing.gathered.resize(n_columns * n * sizeof(double));
  char* at = outgoing.gathered.data();
  const auto column = [&](const std::vector<double>& field) {
    if (runs.size() == 1) {
      outgoing.columns.push_back(piece(field, runs[0].first, n));
      return;
    }
    outgoing.columns.emplace_back(at, n * sizeof(double), runs, field.data());
    at += n * sizeof(double);
  };
  for (const auto& [field, member] : k_donor_columns) column(values.*member);
  if (with_phi)
    for (const auto& [field, member] : k_phi_columns) column(values.*member);
  if (outgoing.size() <= k_one_piece) outgoing.join();
}

void place_donors(std::vector<Slot>& slots, DonorPrelude& prelude, DonorValues& values, std::size_t offset,
                  std::size_t n) {
  slots.assign(1, {reinterpret_cast<char*>(&prelude), sizeof prelude, false, true});
  const auto column = [&](std::vector<double>& field) {
    slots.push_back({reinterpret_cast<char*>(field.data() + offset), n * sizeof(double), true, true});
  };
  for (const auto& [field, member] : k_donor_columns) column(values.*member);
  if (!values.phi.empty())
    for (const auto& [field, member] : k_phi_columns) column(values.*member);
}

void accept_donors(const std::vector<Slot>& slots, const DonorPrelude& prelude, const std::string& who,
                   const std::uint8_t* usable, DonorValues& values) {
  const bool with_phi = slots.size() > 1 + k_donor_columns.size();
  if (prelude.with_phi > 1) throw CouplingError(who + " sent donors whose flag of phi is neither 0 nor 1");
  if ((prelude.with_phi == 1) != with_phi)
    throw CouplingError(who + (with_phi ? " did not send" : " sent") +
                        " phi with the donors, against the scene");
  values.time = prelude.time;
  values.horizon_begin = prelude.horizon_begin;
  values.horizon_end = prelude.horizon_end;
  auto slot = slots.begin() + 1;
  const auto check = [&](const char* field) {
    if (!slot->all_finite)
      refuse_if_not_finite(reinterpret_cast<const double*>(slot->at), slot->bytes / sizeof(double), usable,
                           field, "donors", who);
    ++slot;
  };
  for (const auto& [field, member] : k_donor_columns) check(field);
  if (with_phi)
    for (const auto& [field, member] : k_phi_columns) check(field);
}

void pack(Outgoing& outgoing, const Samples& samples, std::size_t first, std::size_t n) {
  begin(outgoing.message);
  outgoing.columns.clear();
  ByteWriter(outgoing.message).value(static_cast<std::uint64_t>(!samples.phi.empty()));
  outgoing.columns.push_back(piece(samples.coverage, first, n));
  for (const auto& [field, member] : k_sample_columns)
    outgoing.columns.push_back(piece(samples.*member, first, n));
  if (!samples.phi.empty()) outgoing.columns.push_back(piece(samples.phi, first, n));
  outgoing.columns.push_back(piece(samples.status, first, n));
  if (outgoing.size() <= k_one_piece) outgoing.join();
}

void place_samples(std::vector<Slot>& slots, std::uint64_t& with_phi, Samples& answers) {
  slots.assign(1, {reinterpret_cast<char*>(&with_phi), sizeof with_phi, false, true});
  const auto column = [&](std::vector<double>& field) {
    slots.push_back({reinterpret_cast<char*>(field.data()), field.size() * sizeof(double), true, true});
  };
  column(answers.coverage);
  for (const auto& [field, member] : k_sample_columns) column(answers.*member);
  if (!answers.phi.empty()) column(answers.phi);
  slots.push_back({reinterpret_cast<char*>(answers.status.data()), answers.status.size(), false, true});
}

void accept_samples(const std::vector<Slot>& slots, std::uint64_t with_phi, const std::string& who,
                    const Samples& answers) {
  const bool due = !answers.phi.empty();
  if (with_phi > 1) throw CouplingError(who + " sent samples whose flag of phi is neither 0 nor 1");
  if ((with_phi == 1) != due)
    throw CouplingError(who + (due ? " did not send" : " sent") + " phi with the samples, against the scene");
  const std::size_t n = answers.status.size();
  const auto* statuses = reinterpret_cast<const unsigned char*>(answers.status.data());
  unsigned char worst = 0;
  for (std::size_t i = 0; i < n; ++i) worst = std::max(worst, statuses[i]);
  if (worst > static_cast<unsigned char>(SampleStatus::uncovered))
    throw CouplingError(who + " sent a sample with the unknown status " + std::to_string(worst));

  // coverage matters always, a state where it is ok, phi where there is any answer
  auto slot = slots.begin() + 1;
  const auto check = [&](const char* field, const std::vector<double>& values, SampleStatus up_to) {
    if ((slot++)->all_finite) return;
    std::vector<std::uint8_t> matters(n);
    for (std::size_t i = 0; i < n; ++i) matters[i] = answers.status[i] <= up_to;
    refuse_if_not_finite(values.data(), n, matters.data(), field, "samples", who);
  };
  check("coverage", answers.coverage, SampleStatus::uncovered);
  for (const auto& [field, member] : k_sample_columns) check(field, answers.*member, SampleStatus::ok);
  if (due) check("phi", answers.phi, SampleStatus::dry);
}

void merge(const Samples& answers, const std::vector<std::size_t>& chosen, Samples& samples) {
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    const std::size_t at = chosen[i];
    const SampleStatus status = answers.status[i];
    const bool better = status < samples.status[at] ||
                        (status == samples.status[at] && answers.coverage[i] > samples.coverage[at]);
    if (!better) continue;
    samples.status[at] = status;
    samples.coverage[at] = answers.coverage[i];
    samples.p[at] = answers.p[i];
    samples.u[at] = answers.u[i];
    samples.v[at] = answers.v[i];
    samples.w[at] = answers.w[i];
    if (!samples.phi.empty()) samples.phi[at] = answers.phi[i];
  }
}

std::size_t pack(Bytes& message, const ParticleStates& states, const Box& box) {
  begin(message);
  std::vector<std::size_t> inside;
  for (std::size_t i = 0; i < states.size(); ++i)
    if (box.contains({states.x[i], states.y[i], states.z[i]})) inside.push_back(i);
  ByteWriter writer(message);
  const auto column = [&](const std::vector<double>& field) {
    for (const std::size_t i : inside) writer.value(field[i]);
  };
  for (const auto& [field, member] : k_particle_columns) column(states.*member);
  for (const auto& [field, member] : k_normal_columns) column(states.*member);
  for (const std::size_t i : inside) writer.value(states.on_surface[i]);
  return inside.size();
}

void unpack(const char* bytes, std::size_t count, const std::string& who, std::size_t n,
            ParticleStates& states) {
  const std::string what = who + " sent particles";
  ByteReader reader(bytes, count, what.c_str());
  if (n > count) reader.refuse("more particles announced than sent");
  const auto column = [&](const char* field, std::vector<double>& target) {
    const std::size_t offset = target.size();
    target.resize(offset + n);
    reader.column(target.data() + offset, n);
    refuse_if_not_finite(target.data() + offset, n, nullptr, field, "particles", who);
  };
  for (const auto& [field, member] : k_particle_columns) column(field, states.*member);
  for (const auto& [field, member] : k_normal_columns) column(field, states.*member);
  const std::size_t offset = states.on_surface.size();
  states.on_surface.resize(offset + n);
  reader.column(states.on_surface.data() + offset, n);
  reader.expect_end();
}

}  // namespace littoral::coupler
