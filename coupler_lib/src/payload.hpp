#pragma once

#include <string>
#include <vector>

#include "clip.hpp"
#include "incoming.hpp"
#include "littoral/coupler/fields.hpp"
#include "littoral/coupler/window.hpp"
#include "outgoing.hpp"

namespace littoral::coupler {

// Contents of the messages. Each `pack` starts a message: room for the header, then the content; seal()
// closes it. Each `unpack` takes what follows the header and throws CouplingError where the bytes are not
// what they should be; `who` names the sender in the message.

/// Where a rank needs donors and covers targets (sph), or holds donors and wants targets (fv).
struct RankBoxes {
  Box donors = Box::nothing();
  Box targets = Box::nothing();
};
void pack(Bytes& message, const std::vector<RankBoxes>& boxes);
std::vector<RankBoxes> unpack_boxes(const char* bytes, std::size_t count, const std::string& who);

void pack(Bytes& message, const DonorGeometry& geometry);
DonorGeometry unpack_geometry(const char* bytes, std::size_t count, const std::string& who);

void pack(Bytes& message, const Targets& all, const std::vector<std::size_t>& chosen);
Targets unpack_targets(const char* bytes, std::size_t count, const std::string& who);

/// What stands before the columns of the donors.
struct DonorPrelude {
  std::uint64_t with_phi = 0;
  double time = 0.0, horizon_begin = 0.0, horizon_end = 0.0;
};
static_assert(sizeof(DonorPrelude) == 32);

/// Column by column: p, u, v, w, their derivatives, [phi and its derivative].
void pack(Outgoing& outgoing, const DonorValues& values, const std::vector<Run>& runs, bool with_phi);
/// Where they belong: values [offset, offset + n), which must have their final length.
void place_donors(std::vector<Slot>& slots, DonorPrelude& prelude, DonorValues& values, std::size_t offset,
                  std::size_t n);
/// Of what has come there. `usable`: of these n cells. Time and horizon become those of the message.
void accept_donors(const std::vector<Slot>& slots, const DonorPrelude& prelude, const std::string& who,
                   const std::uint8_t* usable, DonorValues& values);

/// Answers to some targets: coverage, p, u, v, w, [phi], status of samples [first, first + n).
void pack(Outgoing& outgoing, const Samples& samples, std::size_t first, std::size_t n);
/// Where they belong: all of `answers`, which must have their final length; the flag of phi stands before
/// them.
void place_samples(std::vector<Slot>& slots, std::uint64_t& with_phi, Samples& answers);
/// Of what has come there.
void accept_samples(const std::vector<Slot>& slots, std::uint64_t with_phi, const std::string& who,
                    const Samples& answers);
/// Merges the answers for targets `chosen`: better status first, then better coverage, then the earlier
/// answer.
void merge(const Samples& answers, const std::vector<std::size_t>& chosen, Samples& samples);

/// Particles inside `box`.
std::size_t pack(Bytes& message, const ParticleStates& states, const Box& box);
/// Appends.
void unpack(const char* bytes, std::size_t count, const std::string& who, std::size_t n,
            ParticleStates& states);

void pack(Bytes& message, const Proposal& proposal);
Proposal unpack_proposal(const char* bytes, std::size_t count, const std::string& who);
void pack(Bytes& message, const Agreement& agreement);
Agreement unpack_agreement(const char* bytes, std::size_t count, const std::string& who);
void pack(Bytes& message, const Ledger& ledger);
Ledger unpack_ledger(const char* bytes, std::size_t count, const std::string& who);

}  // namespace littoral::coupler
