#pragma once

#include <string>
#include <vector>

#include "bytes.hpp"
#include "clip.hpp"
#include "littoral/coupler/fields.hpp"
#include "littoral/coupler/window.hpp"

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

/// Column by column: p, u, v, w, their derivatives, [phi and its derivative].
void pack(Bytes& message, const DonorValues& values, const std::vector<Run>& runs, bool with_phi);
/// Fills values [offset, offset + n); `usable`: of these n cells. Time and horizon become those of the
/// message.
void unpack(const char* bytes, std::size_t count, const std::string& who, const std::uint8_t* usable,
            std::size_t n, DonorValues& values, std::size_t offset);

/// Samples [first, first + n).
void pack(Bytes& message, const Samples& samples, std::size_t first, std::size_t n);
/// Merges the answers for targets `chosen`: better status first, then better coverage, then the earlier
/// answer.
void merge(const char* bytes, std::size_t count, const std::string& who,
           const std::vector<std::size_t>& chosen, Samples& samples);

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
