#include <cmath>

#include "payload.hpp"
#include "validate.hpp"
#include "wire.hpp"

namespace littoral::coupler {

namespace {

void begin(Bytes& message) { message.resize(sizeof(Header)); }

bool flag(ByteReader& reader) {
  const auto value = reader.value<std::uint8_t>();
  if (value > 1) reader.refuse("a flag is neither 0 nor 1");
  return value == 1;
}

void write(ByteWriter<Bytes>& writer, const Box& box) {
  writer.value(box.lower);
  writer.value(box.upper);
}

Box read_box(ByteReader& reader) {
  Box box;
  box.lower = reader.value<Vec3>();
  box.upper = reader.value<Vec3>();
  for (std::size_t d = 0; d < 3; ++d)
    if (std::isnan(box.lower[d]) || std::isnan(box.upper[d])) reader.refuse("a box has a corner that is NaN");
  return box;
}

}  // namespace

void pack(Bytes& message, const std::vector<RankBoxes>& boxes) {
  begin(message);
  ByteWriter writer(message);
  for (const auto& rank : boxes) {
    write(writer, rank.donors);
    write(writer, rank.targets);
  }
}

std::vector<RankBoxes> unpack_boxes(const char* bytes, std::size_t count, const std::string& who) {
  const std::string what = who + " sent boxes";
  ByteReader reader(bytes, count, what.c_str());
  std::vector<RankBoxes> boxes;
  while (reader.left() > 0) {
    RankBoxes rank;
    rank.donors = read_box(reader);
    rank.targets = read_box(reader);
    boxes.push_back(rank);
  }
  return boxes;
}

void pack(Bytes& message, const DonorGeometry& geometry) {
  begin(message);
  ByteWriter writer(message);
  writer.value(static_cast<std::uint32_t>(geometry.patches.size()));
  for (const auto& patch : geometry.patches) {
    writer.value(patch.n);
    writer.column(patch.x);
    writer.column(patch.y);
    writer.column(patch.z);
    writer.column(patch.usable);
  }
}

DonorGeometry unpack_geometry(const char* bytes, std::size_t count, const std::string& who) {
  const std::string what = who + " sent the geometry";
  ByteReader reader(bytes, count, what.c_str());
  DonorGeometry geometry;
  const auto n_patches = reader.value<std::uint32_t>();
  for (std::uint32_t p = 0; p < n_patches; ++p) {
    DonorPatch patch;
    patch.n = reader.value<std::array<int, 3>>();
    std::size_t n = 1;
    for (const int cells : patch.n) {
      // each direction is at most as long as the message, so the product of two cannot overflow
      if (cells < 0 || static_cast<std::size_t>(cells) > count || n > count)
        reader.refuse("a patch has no such size");
      n *= static_cast<std::size_t>(cells);
    }
    reader.column(patch.x, n);
    reader.column(patch.y, n);
    reader.column(patch.z, n);
    reader.column(patch.usable, n);
    geometry.patches.push_back(std::move(patch));
  }
  reader.expect_end();
  validate(geometry, who);
  return geometry;
}

void pack(Bytes& message, const Targets& all, const std::vector<std::size_t>& chosen) {
  begin(message);
  ByteWriter writer(message);
  writer.value(static_cast<std::uint64_t>(chosen.size()));
  for (const auto* column : {&all.x, &all.y, &all.z})
    for (const std::size_t i : chosen) writer.value((*column)[i]);
  for (const std::size_t i : chosen) writer.value(all.wants[i]);
}

Targets unpack_targets(const char* bytes, std::size_t count, const std::string& who) {
  const std::string what = who + " sent the targets";
  ByteReader reader(bytes, count, what.c_str());
  Targets targets;
  const auto n = reader.value<std::uint64_t>();
  reader.column(targets.x, n);
  reader.column(targets.y, n);
  reader.column(targets.z, n);
  reader.column(targets.wants, n);
  reader.expect_end();
  validate(targets, who);
  return targets;
}

void pack(Bytes& message, const Proposal& proposal) {
  begin(message);
  ByteWriter writer(message);
  writer.value(proposal.dt_stable);
  for (const bool on : {proposal.write, proposal.checkpoint, proposal.stop, proposal.region_changed,
                        proposal.wants_particles})
    writer.value(static_cast<std::uint8_t>(on));
  writer.text(proposal.reason);
}

Proposal unpack_proposal(const char* bytes, std::size_t count, const std::string& who) {
  const std::string what = who + " sent a proposal";
  ByteReader reader(bytes, count, what.c_str());
  Proposal proposal;
  proposal.dt_stable = reader.value<double>();
  for (bool* on : {&proposal.write, &proposal.checkpoint, &proposal.stop, &proposal.region_changed,
                   &proposal.wants_particles})
    *on = flag(reader);
  proposal.reason = reader.text();
  reader.expect_end();
  return proposal;
}

void pack(Bytes& message, const Agreement& agreement) {
  begin(message);
  ByteWriter writer(message);
  const Window& w = agreement.window;
  writer.value(w.index);
  writer.value(w.t_begin);
  writer.value(w.t_end);
  writer.value(w.substeps);
  for (const bool on : {agreement.write, agreement.checkpoint, agreement.stop, agreement.region_changed,
                        agreement.wants_particles})
    writer.value(static_cast<std::uint8_t>(on));
  writer.text(agreement.reason);
}

Agreement unpack_agreement(const char* bytes, std::size_t count, const std::string& who) {
  const std::string what = who + " sent an agreement";
  ByteReader reader(bytes, count, what.c_str());
  Agreement agreement;
  agreement.window.index = reader.value<std::int64_t>();
  agreement.window.t_begin = reader.value<double>();
  agreement.window.t_end = reader.value<double>();
  agreement.window.substeps = reader.value<int>();
  for (bool* on : {&agreement.write, &agreement.checkpoint, &agreement.stop, &agreement.region_changed,
                   &agreement.wants_particles})
    *on = flag(reader);
  agreement.reason = reader.text();
  reader.expect_end();
  return agreement;
}

void pack(Bytes& message, const Ledger& ledger) {
  begin(message);
  ByteWriter writer(message);
  writer.value(ledger);
}

Ledger unpack_ledger(const char* bytes, std::size_t count, const std::string& who) {
  const std::string what = who + " sent a ledger";
  ByteReader reader(bytes, count, what.c_str());
  const auto ledger = reader.value<Ledger>();
  reader.expect_end();
  constexpr std::size_t n = sizeof(Ledger) / sizeof(double);
  static_assert(n * sizeof(double) == sizeof(Ledger), "a ledger is made of numbers only");
  std::array<double, n> values;
  std::memcpy(values.data(), &ledger, sizeof ledger);
  const std::size_t bad = count_not_finite(values.data(), n);
  if (bad > 0)
    throw CouplingError(who + " sent a ledger with " + std::to_string(bad) + " of " + std::to_string(n) +
                        " entries NaN or infinite");
  return ledger;
}

}  // namespace littoral::coupler
