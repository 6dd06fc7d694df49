#include "wire.hpp"

#include <cstddef>
#include <cstring>
#include <limits>

#include "littoral/error.hpp"
#include "validate.hpp"

namespace littoral::coupler {

namespace {

[[noreturn]] void refuse(const std::string& who, const std::string& what) {
  throw CouplingError(who + " sent " + what);
}

bool is_known(Kind kind) { return kind >= Kind::contract && kind <= Kind::abort; }

/// Size, magic, check: whatever the kind.
Header read_header(const char* message, std::size_t received, bool is_whole, const std::string& who,
                   const std::string& awaited) {
  Header header;
  const std::string instead = awaited.empty() ? "" : "; awaited: " + awaited;
  if (received < sizeof header)
    refuse(who, std::to_string(received) + " bytes, less than a header" + instead);
  std::memcpy(&header, message, sizeof header);
  if (header.magic != Header::k_magic) refuse(who, "bytes that are no message of this protocol" + instead);
  if (header.check != header_check(header) || !is_known(header.kind))
    refuse(who, "a damaged header" + instead);
  const std::size_t payload = received - sizeof header;
  if (is_whole && header.bytes != payload)
    refuse(who, std::string(header.bytes > payload ? "a truncated" : "an oversized") + " message (" +
                    name(header.kind) + "): it announces " + std::to_string(header.bytes) +
                    " bytes and holds " + std::to_string(payload));
  return header;
}

std::string place(Kind kind, std::int64_t window, std::uint32_t pass) {
  switch (kind) {
    case Kind::donors:
    case Kind::samples:
    case Kind::particles:
    case Kind::ledger:
    case Kind::proposal:
    case Kind::agreement:
      break;
    default:
      return "";
  }
  return " of window " + std::to_string(window) + (pass > 0 ? ", pass " + std::to_string(pass) : "");
}

}  // namespace

const char* name(Kind kind) {
  switch (kind) {
    case Kind::contract:
      return "contract";
    case Kind::boxes:
      return "boxes";
    case Kind::geometry:
      return "geometry";
    case Kind::targets:
      return "targets";
    case Kind::proposal:
      return "proposal";
    case Kind::agreement:
      return "agreement";
    case Kind::donors:
      return "donors";
    case Kind::samples:
      return "samples";
    case Kind::particles:
      return "particles";
    case Kind::ledger:
      return "ledger";
    case Kind::goodbye:
      return "goodbye";
    case Kind::leaving:
      return "leaving";
    case Kind::abort:
      return "abort";
  }
  return "unknown";
}

std::string describe(const Expected& expected) {
  return std::string("the ") + name(expected.kind) + place(expected.kind, expected.window, expected.pass);
}

std::uint64_t header_check(const Header& header) {
  std::array<unsigned char, offsetof(Header, check)> bytes;
  std::memcpy(bytes.data(), &header, bytes.size());
  std::uint64_t hash = 0xcbf2'9ce4'8422'2325;  // FNV-1a
  for (const auto byte : bytes) hash = (hash ^ byte) * 0x100'0000'01b3;
  return hash;
}

namespace {

void seal(Bytes& message, std::size_t bytes, const Expected& content, std::uint64_t count) {
  Header header;
  header.kind = content.kind;
  header.pass = content.pass;
  header.epoch = content.epoch;
  header.window = content.window;
  header.time = content.time;
  header.count = count;
  header.bytes = bytes;
  header.check = header_check(header);
  std::memcpy(message.data(), &header, sizeof header);
}

}  // namespace

void seal(Bytes& message, const Expected& content, std::uint64_t count) {
  seal(message, message.size() - sizeof(Header), content, count);
}

void seal(Outgoing& outgoing, const Expected& content, std::uint64_t count) {
  seal(outgoing.message, outgoing.size() - sizeof(Header), content, count);
}

namespace {

void compare(const Header& header, const Expected& expected, const std::string& who) {
  const std::string awaited = describe(expected);
  if (header.kind != expected.kind)
    refuse(who, std::string("the ") + name(header.kind) + place(header.kind, header.window, header.pass) +
                    "; awaited: " + awaited);
  if (header.window != expected.window || header.pass != expected.pass)
    refuse(who, std::string("the ") + name(header.kind) + place(header.kind, header.window, header.pass) +
                    "; awaited: " + awaited + " (one is late, repeated or lost)");
  if (header.epoch != expected.epoch)
    refuse(who, std::string("the ") + name(header.kind) + " of epoch " + std::to_string(header.epoch) +
                    " where epoch " + std::to_string(expected.epoch) + " is current");
  if (!(header.time == expected.time))  // both sides computed it by the same rule: equal to the bit
    refuse(who, awaited + " with time " + text_of(header.time) + " s where " + text_of(expected.time) +
                    " s is due");
  if (expected.count && header.count != *expected.count)
    refuse(who, awaited + " with " + std::to_string(header.count) + " entries where " +
                    std::to_string(*expected.count) + " are due");
}

}  // namespace

Header checked_header(const char* message, std::size_t received, const Expected& expected,
                      const std::string& who) {
  const Header header = read_header(message, received, true, who, describe(expected));
  compare(header, expected, who);
  return header;
}

Header checked_header_of_long_message(const char* message, const Expected& expected, const std::string& who) {
  const Header header = read_header(message, sizeof header, false, who, describe(expected));
  compare(header, expected, who);
  if (header.bytes > static_cast<std::uint64_t>(std::numeric_limits<int>::max()))
    refuse(who, describe(expected) + " with more bytes than MPI can count");
  return header;
}

Bytes pack(const Notice& notice) {
  Bytes message(sizeof(Header));
  message.insert(message.end(), notice.reason.begin(), notice.reason.end());
  Expected content;
  content.kind = notice.kind;
  seal(message, content, notice.reason.size());
  return message;
}

Notice unpack_notice(const char* message, std::size_t received, const std::string& who) {
  const Header header = read_header(message, received, true, who, "");
  if (header.kind < Kind::goodbye) refuse(who, std::string("the ") + name(header.kind) + " as a notice");
  return {header.kind, std::string(message + sizeof header, received - sizeof header)};
}

}  // namespace littoral::coupler
