#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include "outgoing.hpp"

namespace littoral::coupler {

inline constexpr std::uint32_t k_protocol_version = 2;  // 2: donors and samples column by column

/// What every rank says first, in one allgather over all programs of the job. Plain data.
struct Greeting {
  static constexpr std::uint64_t k_magic = 0x4c49'5454'4f52'414c;  // "LITTORAL"
  std::uint64_t magic = k_magic;
  std::uint32_t protocol_version = k_protocol_version;
  std::uint32_t reserved = 0;
  std::array<char, 16> role{};     // zero-terminated
  std::array<char, 48> program{};  // name
  std::array<char, 48> version{};
};

enum class Kind : std::uint32_t {
  contract = 1,
  boxes,
  geometry,
  targets,
  proposal,
  agreement,
  donors,
  samples,
  particles,
  ledger,
  goodbye,  // notices, on a tag of their own: they may come at any time
  leaving,
  abort
};
const char* name(Kind kind);

/// Tags on the intercommunicator.
inline constexpr int k_tag_message = 1;
inline constexpr int k_tag_notice = 2;
inline constexpr int k_tag_request = 3;  // empty: the receiver of a long message's header asks for the rest
inline constexpr int k_tag_rest = 4;

/// Longer messages go in pieces: the header, and on request the rest (of donors and samples: what stands
/// before the columns, then column by column).
inline constexpr std::size_t k_one_piece = 4096;  // [bytes]

/// Stands in front of every message.
struct Header {
  static constexpr std::uint64_t k_magic = 0x4c54'4c4d'4553'5347;  // "LTLMESSG"
  std::uint64_t magic = k_magic;
  Kind kind = Kind::contract;
  std::uint32_t pass = 0;  // of the window, where SPH runs through it more than once
  std::int64_t epoch = 0;  // of geometry and targets
  std::int64_t window = 0;
  double time = 0.0;        // [s] what the content is valid at
  std::uint64_t count = 0;  // cells, points, particles, entries
  std::uint64_t bytes = 0;  // after the header
  std::uint64_t check = 0;  // of the fields above
};
static_assert(sizeof(Header) == 64);

/// What the receiver knows about the message it awaits.
struct Expected {
  Kind kind = Kind::contract;
  std::uint32_t pass = 0;
  std::int64_t epoch = 0;
  std::int64_t window = 0;
  double time = 0.0;
  std::optional<std::uint64_t> count;  // absent: the message decides
};

/// "the donors of window 12", "the contract"
std::string describe(const Expected& expected);

/// Writes the header (check included) into the first bytes of a message whose payload is complete.
void seal(Bytes& message, const Expected& content, std::uint64_t count);
void seal(Outgoing& outgoing, const Expected& content, std::uint64_t count);
std::uint64_t header_check(const Header& header);

/// The header of a received message, after every field has been compared with what is due.
/// throws CouplingError: "<who> sent ..."
Header checked_header(const char* message, std::size_t received, const Expected& expected,
                      const std::string& who);

/// The header alone, where the rest of the message is still to be asked for: everything but the number of
/// bytes that follow is compared.
Header checked_header_of_long_message(const char* message, const Expected& expected, const std::string& who);

/// A notice: kind goodbye, leaving or abort, and a reason.
struct Notice {
  Kind kind = Kind::abort;
  std::string reason;
};
Bytes pack(const Notice& notice);
Notice unpack_notice(const char* message, std::size_t received, const std::string& who);

}  // namespace littoral::coupler
