#include <algorithm>
#include <array>
#include <cmath>
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

}  // namespace

void pack(Bytes& message, const DonorValues& values, const std::vector<Run>& runs, bool with_phi) {
  begin(message);
  ByteWriter writer(message);
  writer.value(static_cast<std::uint64_t>(with_phi));
  for (const double t : {values.time, values.horizon_begin, values.horizon_end}) writer.value(t);
  std::size_t n = 0;
  for (const auto& run : runs) n += run.n;
  const auto column = [&](const std::vector<double>& field) {
    char* at = writer.reserve(n * sizeof(double));
    for (const auto& run : runs) {
      std::memcpy(at, field.data() + run.first, run.n * sizeof(double));
      at += run.n * sizeof(double);
    }
  };
  for (const auto& [field, member] : k_donor_columns) column(values.*member);
  if (with_phi)
    for (const auto& [field, member] : k_phi_columns) column(values.*member);
}

void unpack(const char* bytes, std::size_t count, const std::string& who, const std::uint8_t* usable,
            std::size_t n, DonorValues& values, std::size_t offset) {
  ByteReader reader(bytes, count, "donors");
  const auto with_phi = reader.value<std::uint64_t>();
  if (with_phi > 1) reader.refuse("the flag of phi is neither 0 nor 1");
  if (n > 0 && (with_phi == 1) == values.phi.empty())
    throw CouplingError(who + (with_phi ? " sent" : " did not send") +
                        " phi with the donors, against the scene");
  values.time = reader.value<double>();
  values.horizon_begin = reader.value<double>();
  values.horizon_end = reader.value<double>();
  const auto column = [&](const char* field, std::vector<double>& target) {
    if (n > reader.left() / sizeof(double)) reader.refuse("a column is longer than the message");
    double* to = target.data() + offset;
    if (!copy_finite(reader.take(n * sizeof(double)), to, n))
      refuse_if_not_finite(to, n, usable, field, "donors", who);
  };
  for (const auto& [field, member] : k_donor_columns) column(field, values.*member);
  if (with_phi)
    for (const auto& [field, member] : k_phi_columns) column(field, values.*member);
  reader.expect_end();
}

void pack(Bytes& message, const Samples& samples, std::size_t first, std::size_t n) {
  begin(message);
  ByteWriter writer(message);
  writer.value(static_cast<std::uint64_t>(!samples.phi.empty()));
  for (const auto& [field, member] : k_sample_columns) writer.column((samples.*member).data() + first, n);
  writer.column(samples.coverage.data() + first, n);
  if (!samples.phi.empty()) writer.column(samples.phi.data() + first, n);
  writer.column(samples.status.data() + first, n);
}

void merge(const char* bytes, std::size_t count, const std::string& who,
           const std::vector<std::size_t>& chosen, Samples& samples) {
  ByteReader reader(bytes, count, "samples");
  const std::size_t n = chosen.size();
  const auto with_phi = reader.value<std::uint64_t>();
  if (with_phi > 1) reader.refuse("the flag of phi is neither 0 nor 1");
  // columns lie in the message as they are; it was allocated for doubles
  std::array<const char*, 6> column{};
  const std::size_t n_columns = with_phi ? 6 : 5;
  for (std::size_t c = 0; c < n_columns; ++c) {
    if (n > reader.left() / sizeof(double)) reader.refuse("a column is longer than the message");
    column[c] = reader.take(n * sizeof(double));
  }
  const char* statuses = reader.take(n);
  reader.expect_end();
  const auto value = [](const char* from, std::size_t i) {
    double v;
    std::memcpy(&v, from + i * sizeof v, sizeof v);
    return v;
  };
  const bool take_phi = with_phi && !samples.phi.empty();
  unsigned char worst = 0;
  for (std::size_t i = 0; i < n; ++i) worst = std::max(worst, static_cast<unsigned char>(statuses[i]));
  if (worst > static_cast<unsigned char>(SampleStatus::uncovered))
    throw CouplingError(who + " sent a sample with the unknown status " + std::to_string(worst));

  bool all_finite = true;
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t at = chosen[i];
    const auto status = static_cast<SampleStatus>(statuses[i]);
    const double coverage = value(column[4], i);
    const double p = value(column[0], i), u = value(column[1], i), v = value(column[2], i),
                 w = value(column[3], i);
    all_finite = all_finite && std::isfinite(p * 0.0 + u * 0.0 + v * 0.0 + w * 0.0 + coverage * 0.0);
    const bool better =
        status < samples.status[at] || (status == samples.status[at] && coverage > samples.coverage[at]);
    if (!better) continue;
    samples.status[at] = status;
    samples.p[at] = p;
    samples.u[at] = u;
    samples.v[at] = v;
    samples.w[at] = w;
    samples.coverage[at] = coverage;
    if (take_phi) samples.phi[at] = value(column[5], i);
  }
  if (take_phi) all_finite = all_finite && coupler::all_finite(column[5], n);
  if (all_finite) return;

  // which ones, and do they matter? a state where it is ok, phi where there is any answer, coverage always
  constexpr std::array<const char*, 6> k_names{"p", "u", "v", "w", "coverage", "phi"};
  for (std::size_t c = 0; c < n_columns; ++c) {
    const auto matters = [&](std::size_t i) {
      const auto status = static_cast<SampleStatus>(statuses[i]);
      return c == 4 || (c == 5 ? take_phi && status != SampleStatus::uncovered : status == SampleStatus::ok);
    };
    std::size_t bad = 0;
    for (std::size_t i = 0; i < n; ++i) bad += matters(i) && !std::isfinite(value(column[c], i));
    if (bad > 0)
      throw CouplingError(who + " sent samples with " + std::to_string(bad) + " of " + std::to_string(n) +
                          " values of " + k_names[c] + " NaN or infinite");
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
  ByteReader reader(bytes, count, "particles");
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
