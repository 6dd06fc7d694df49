#include "wire.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <functional>

#include "payload.hpp"

namespace littoral::coupler {
namespace {

Expected donors_of_window(std::int64_t window) {
  Expected expected;
  expected.kind = Kind::donors;
  expected.pass = 1;
  expected.epoch = 3;
  expected.window = window;
  expected.time = 0.25;
  expected.count = 4;
  return expected;
}

Bytes message_of(const Expected& content, const std::vector<char>& payload) {
  Bytes message(sizeof(Header));
  message.insert(message.end(), payload.begin(), payload.end());
  seal(message, content, content.count.value_or(0));
  return message;
}

bool accepts(const Bytes& message, const Expected& expected) {
  try {
    checked_header(message.data(), message.size(), expected, "partner");
    return true;
  } catch (const CouplingError&) {
    return false;
  }
}

TEST(WireTest, AcceptsWhatIsDue) {
  EXPECT_TRUE(rc::check([](std::int64_t window, const std::vector<char>& payload) {
    const Expected due = donors_of_window(window);
    const Bytes message = message_of(due, payload);
    const Header header = checked_header(message.data(), message.size(), due, "partner");
    RC_ASSERT(header.bytes == payload.size());
    RC_ASSERT(header.window == window);
  }));
}

TEST(WireTest, RefusesAnyOtherField) {
  const Expected due = donors_of_window(7);
  const std::vector<std::function<void(Expected&)>> changes{[](Expected& e) { e.kind = Kind::samples; },
                                                            [](Expected& e) { e.pass = 0; },
                                                            [](Expected& e) { e.epoch = 2; },
                                                            [](Expected& e) { e.window = 6; },
                                                            [](Expected& e) { e.time = 0.25000000001; },
                                                            [](Expected& e) { e.time = std::nan(""); },
                                                            [](Expected& e) { e.count = 5; }};
  for (const auto& change : changes) {
    Expected other = due;
    change(other);
    EXPECT_FALSE(accepts(message_of(other, {}), due)) << describe(other);
  }
}

TEST(WireTest, RefusesEveryTruncationAndEveryExcess) {
  EXPECT_TRUE(rc::check([](const std::vector<char>& payload) {
    const Expected due = donors_of_window(1);
    Bytes message = message_of(due, payload);
    const auto cut = *rc::gen::inRange<std::size_t>(0, message.size());
    Bytes shorter(message.begin(), message.begin() + static_cast<std::ptrdiff_t>(cut));
    RC_ASSERT(!accepts(shorter, due));
    message.resize(message.size() + *rc::gen::inRange<std::size_t>(1, 100), 'x');
    RC_ASSERT(!accepts(message, due));
  }));
}

TEST(WireTest, RefusesRandomBytes) {
  EXPECT_TRUE(rc::check([](const std::vector<char>& noise) {
    const Bytes message(noise.begin(), noise.end());
    RC_ASSERT(!accepts(message, donors_of_window(0)));
  }));
}

TEST(WireTest, RefusesAHeaderWithAnyByteChanged) {
  const Expected due = donors_of_window(1);
  const Bytes message = message_of(due, {'a', 'b'});
  for (std::size_t at = 0; at < sizeof(Header); ++at)
    for (int flip = 1; flip < 256; ++flip) {
      Bytes damaged = message;
      damaged[at] = static_cast<char>(damaged[at] ^ flip);
      ASSERT_FALSE(accepts(damaged, due)) << at;
    }
}

TEST(WireTest, NoticesSurvivePackingAndNothingElseIsANotice) {
  EXPECT_TRUE(rc::check([](const std::string& reason) {
    const Bytes message = pack(Notice{Kind::goodbye, reason});
    const Notice back = unpack_notice(message.data(), message.size(), "partner");
    RC_ASSERT(back.kind == Kind::goodbye && back.reason == reason);
  }));
  const Bytes donors = message_of(donors_of_window(0), {});
  EXPECT_THROW(unpack_notice(donors.data(), donors.size(), "partner"), CouplingError);
}

/// Whatever the bytes are: decoded, or refused with a CouplingError. The sanitizers watch the rest.
template <class Unpack>
void expect_decoded_or_refused(const std::vector<char>& bytes, const Unpack& unpack) {
  try {
    unpack(bytes.data(), bytes.size());
  } catch (const CouplingError&) {
  }
}

/// As the partners do it with a message that came in one piece.
void take_donors(const char* bytes, std::size_t count, const std::string& who,
                 const std::vector<std::uint8_t>& usable, std::size_t offset, DonorValues& values) {
  std::vector<Slot> slots;
  DonorPrelude prelude;
  place_donors(slots, prelude, values, offset, usable.size());
  scatter(bytes, count, slots, who, "the donors");
  accept_donors(slots, prelude, who, usable.data(), values);
}

void take_samples(const char* bytes, std::size_t count, const std::string& who,
                  const std::vector<std::size_t>& chosen, Samples& samples) {
  std::vector<Slot> slots;
  std::uint64_t with_phi = 0;
  Samples answers;
  answers.resize(chosen.size(), !samples.phi.empty());
  place_samples(slots, with_phi, answers);
  scatter(bytes, count, slots, who, "the samples");
  accept_samples(slots, with_phi, who, answers);
  merge(answers, chosen, samples);
}

void try_all(const std::vector<char>& bytes) {
  const std::string who = "partner";
  expect_decoded_or_refused(bytes, [&](const char* b, std::size_t n) { unpack_boxes(b, n, who); });
  expect_decoded_or_refused(bytes, [&](const char* b, std::size_t n) { unpack_geometry(b, n, who); });
  expect_decoded_or_refused(bytes, [&](const char* b, std::size_t n) { unpack_targets(b, n, who); });
  expect_decoded_or_refused(bytes, [&](const char* b, std::size_t n) { unpack_proposal(b, n, who); });
  expect_decoded_or_refused(bytes, [&](const char* b, std::size_t n) { unpack_agreement(b, n, who); });
  expect_decoded_or_refused(bytes, [&](const char* b, std::size_t n) { unpack_ledger(b, n, who); });
  expect_decoded_or_refused(bytes, [&](const char* b, std::size_t n) {
    ParticleStates states;
    unpack(b, n, who, n / 89, states);
  });
  expect_decoded_or_refused(bytes, [&](const char* b, std::size_t n) {
    DonorValues values;
    values.resize(5, true);
    const std::vector<std::uint8_t> usable(3, 1);
    take_donors(b, n, who, usable, 2, values);
  });
  expect_decoded_or_refused(bytes, [&](const char* b, std::size_t n) {
    Samples samples;
    samples.resize(5, true);
    take_samples(b, n, who, {0, 2, 4}, samples);
  });
}

TEST(PayloadTest, RandomBytesNeverCrash) {
  EXPECT_TRUE(rc::check([](const std::vector<char>& noise) { try_all(noise); }));
  for (std::size_t n = 0; n < 400; ++n) {
    try_all(std::vector<char>(n, '\0'));
    try_all(std::vector<char>(n, '\x7f'));
    try_all(std::vector<char>(n, '\xff'));
  }
}

DonorGeometry some_geometry() {
  DonorGeometry geometry;
  for (const auto& n : {std::array<int, 3>{4, 1, 3}, std::array<int, 3>{2, 1, 2}}) {
    DonorPatch patch;
    patch.n = n;
    for (int k = 0; k < n[2]; ++k)
      for (int i = 0; i < n[0]; ++i) {
        patch.x.push_back(i + 10.0 * static_cast<double>(geometry.patches.size()));
        patch.y.push_back(0.0);
        patch.z.push_back(k);
        patch.usable.push_back(static_cast<std::uint8_t>((i + k) % 3 != 0));
      }
    geometry.patches.push_back(patch);
  }
  return geometry;
}

std::vector<char> content(const Bytes& message) { return {message.begin() + sizeof(Header), message.end()}; }
std::vector<char> content(Outgoing& outgoing) {
  outgoing.join();
  return content(outgoing.message);
}

TEST(PayloadTest, DamagedMessagesNeverCrash) {
  Bytes message;
  pack(message, some_geometry());
  const auto geometry = content(message);
  Targets targets;
  targets.x = targets.y = targets.z = {1, 2, 3};
  targets.wants = {1, 2, 3};
  pack(message, targets, {0, 2});
  const auto two_targets = content(message);
  EXPECT_TRUE(rc::check([&](bool first) {
    auto damaged = first ? geometry : two_targets;
    const auto hits = *rc::gen::inRange(1, 8);
    for (int i = 0; i < hits; ++i)
      damaged[*rc::gen::inRange<std::size_t>(0, damaged.size())] = *rc::gen::arbitrary<char>();
    damaged.resize(*rc::gen::inRange<std::size_t>(0, damaged.size() + 9));
    try_all(damaged);
  }));
}

TEST(PayloadTest, GeometrySurvives) {
  Bytes message;
  const auto geometry = some_geometry();
  pack(message, geometry);
  const auto bytes = content(message);
  const auto back = unpack_geometry(bytes.data(), bytes.size(), "partner");
  ASSERT_EQ(back.patches.size(), 2u);
  for (std::size_t p = 0; p < 2; ++p) {
    EXPECT_EQ(back.patches[p].n, geometry.patches[p].n);
    EXPECT_EQ(back.patches[p].x, geometry.patches[p].x);
    EXPECT_EQ(back.patches[p].usable, geometry.patches[p].usable);
  }
}

TEST(PayloadTest, GeometryOfAnAbsurdSizeIsRefused) {
  for (const auto& n : {std::array<int, 3>{2147483647, 2147483647, 2147483647}, std::array<int, 3>{-1, 2, 2},
                        std::array<int, 3>{65536, 65536, 65536}, std::array<int, 3>{1, 1, 1000000}}) {
    std::vector<char> bytes;
    ByteWriter writer(bytes);
    writer.value(std::uint32_t{1});
    writer.value(n);
    bytes.resize(200);
    EXPECT_THROW(unpack_geometry(bytes.data(), bytes.size(), "partner"), CouplingError);
  }
}

TEST(PayloadTest, DonorsSurviveThroughRuns) {
  EXPECT_TRUE(rc::check([](bool with_phi) {
    const auto geometry = some_geometry();
    const std::vector<Clip> clips{{0, {1, 0, 0}, {2, 1, 3}}, {1, {0, 0, 1}, {2, 1, 1}}};
    DonorValues values;
    values.resize(geometry.size(), with_phi);
    values.time = 1.0;
    values.horizon_end = 2.0;
    const auto fill = [](std::vector<double>& column) {
      for (auto& v : column) v = *rc::gen::inRange(-1000, 1000);
    };
    for (auto* column : {&values.p, &values.w, &values.dv_dt, &values.dw_dt, &values.phi, &values.dphi_dt})
      fill(*column);
    Outgoing message;
    pack(message, values, runs(geometry, clips), with_phi);
    const auto bytes = content(message);
    DonorValues back;
    back.resize(10, with_phi);
    const std::vector<std::uint8_t> usable(8, 1);
    take_donors(bytes.data(), bytes.size(), "partner", usable, 2, back);
    const std::vector<std::size_t> cells{1, 2, 5, 6, 9, 10, 14, 15};
    for (std::size_t i = 0; i < cells.size(); ++i) {
      RC_ASSERT(back.p[i + 2] == values.p[cells[i]]);
      RC_ASSERT(back.dw_dt[i + 2] == values.dw_dt[cells[i]]);
      if (with_phi) RC_ASSERT(back.dphi_dt[i + 2] == values.dphi_dt[cells[i]]);
    }
    RC_ASSERT(back.time == 1.0 && back.horizon_end == 2.0);
  }));
}

TEST(PayloadTest, NotANumberIsRefusedWhereItMattersWithFieldAndCount) {
  DonorValues values, back;
  values.resize(4, false);
  back.resize(4, false);
  values.dv_dt[1] = values.dv_dt[2] = std::nan("");
  Outgoing message;
  pack(message, values, {{0, 4}}, false);
  const auto bytes = content(message);
  const std::vector<std::uint8_t> all{1, 1, 1, 1}, blanked{1, 0, 0, 1};
  EXPECT_NO_THROW(take_donors(bytes.data(), bytes.size(), "fv rank 1", blanked, 0, back));
  try {
    take_donors(bytes.data(), bytes.size(), "fv rank 1", all, 0, back);
    FAIL();
  } catch (const CouplingError& error) {
    EXPECT_STREQ(error.what(), "fv rank 1 sent donors with 2 of 4 values of dv_dt NaN or infinite");
  }
}

TEST(PayloadTest, TheBestAnswerWins) {
  const auto answer = [](SampleStatus status, double coverage, double p) {
    Samples samples;
    samples.resize(1, false);
    samples.status[0] = status;
    samples.coverage[0] = coverage;
    samples.p[0] = p;
    Outgoing message;
    pack(message, samples, 0, 1);
    return content(message);
  };
  Samples samples;
  samples.resize(3, false);
  const auto offer = [&](SampleStatus status, double coverage, double p) {
    const auto bytes = answer(status, coverage, p);
    take_samples(bytes.data(), bytes.size(), "partner", {1}, samples);
    return samples.p[1];
  };
  EXPECT_EQ(offer(SampleStatus::dry, 0.1, 1.0), 1.0);
  EXPECT_EQ(offer(SampleStatus::uncovered, 0.9, 2.0), 1.0);
  EXPECT_EQ(offer(SampleStatus::ok, 0.6, 3.0), 3.0);
  EXPECT_EQ(offer(SampleStatus::ok, 0.5, 4.0), 3.0);
  EXPECT_EQ(offer(SampleStatus::ok, 0.6, 5.0), 3.0);  // the earlier one
  EXPECT_EQ(offer(SampleStatus::ok, 1.0, 6.0), 6.0);
  EXPECT_EQ(samples.status[0], SampleStatus::uncovered);
}

TEST(PayloadTest, ControlMessagesSurvive) {
  EXPECT_TRUE(rc::check([](double dt, bool write, bool stop, bool wants, const std::string& reason) {
    Proposal proposal;
    proposal.dt_stable = dt;
    proposal.write = write;
    proposal.stop = stop;
    proposal.wants_particles = wants;
    proposal.reason = reason;
    Bytes message;
    pack(message, proposal);
    const auto bytes = content(message);
    const Proposal back = unpack_proposal(bytes.data(), bytes.size(), "partner");
    RC_ASSERT(back.dt_stable == dt && back.write == write && back.stop == stop && !back.checkpoint);
    RC_ASSERT(back.wants_particles == wants && back.reason == reason);
    Agreement agreement;
    agreement.window = {12, dt, dt + 1.0, 7};
    agreement.checkpoint = write;
    agreement.reason = reason;
    pack(message, agreement);
    const auto more = content(message);
    const Agreement again = unpack_agreement(more.data(), more.size(), "partner");
    RC_ASSERT(again.window.index == 12 && again.window.substeps == 7 && again.window.t_begin == dt);
    RC_ASSERT(again.checkpoint == write && again.reason == reason);
  }));
}

TEST(PayloadTest, ParticlesInTheBoxSurvive) {
  ParticleStates states;
  for (int i = 0; i < 6; ++i) {
    for (auto* column : {&states.x, &states.y, &states.z, &states.u, &states.v, &states.w, &states.p,
                         &states.V, &states.nx, &states.ny, &states.nz})
      column->push_back(i);
    states.on_surface.push_back(static_cast<std::uint8_t>(i % 2));
  }
  Bytes message;
  EXPECT_EQ(pack(message, states, {{1.5, 0, 0}, {4, 9, 9}}), 3u);
  const auto bytes = content(message);
  ParticleStates back;
  unpack(bytes.data(), bytes.size(), "partner", 3, back);
  EXPECT_EQ(back.V, (std::vector<double>{2, 3, 4}));
  EXPECT_EQ(back.on_surface, (std::vector<std::uint8_t>{0, 1, 0}));
  EXPECT_THROW(unpack(bytes.data(), bytes.size(), "partner", 2, back), CouplingError);
}

}  // namespace
}  // namespace littoral::coupler
