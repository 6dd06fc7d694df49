#include "littoral/coupler/contract.hpp"

#include <charconv>
#include <cmath>
#include <cstdint>

#include "bytes.hpp"

namespace littoral::coupler {

namespace {

constexpr std::uint32_t k_magic = 0x4c43'4f4e;  // "LCON"

std::string shortest_decimal(double number) {
  char text[32];
  const auto end = std::to_chars(text, text + sizeof text, number).ptr;
  return std::string(text, end);
}

bool agree(const Contract::Entry& a, const Contract::Entry& b, double tolerance) {
  if (a.is_number != b.is_number) return false;
  if (!a.is_number) return a.text == b.text;
  if (a.number == b.number) return true;  // also both infinite
  return std::isfinite(a.number) && std::isfinite(b.number) &&
         std::abs(a.number - b.number) <= tolerance * std::max(std::abs(a.number), std::abs(b.number));
}

}  // namespace

Contract& Contract::set(const std::string& key, const std::string& text) {
  Entry entry{key, text, 0.0, false};
  for (auto& known : entries_)
    if (known.key == key) return known = entry, *this;
  entries_.push_back(std::move(entry));
  return *this;
}

Contract& Contract::set(const std::string& key, double number) {
  set(key, shortest_decimal(number));
  for (auto& entry : entries_)
    if (entry.key == key) {
      entry.number = number;
      entry.is_number = true;
    }
  return *this;
}

Contract& Contract::make_optional(const std::string& key) {
  for (auto& entry : entries_)
    if (entry.key == key) entry.is_optional = true;
  return *this;
}

const Contract::Entry* Contract::find(const std::string& key) const {
  for (const auto& entry : entries_)
    if (entry.key == key) return &entry;
  return nullptr;
}

std::vector<Contract::Mismatch> Contract::compare(const Contract& theirs, double relative_tolerance) const {
  std::vector<Mismatch> result;
  for (const auto& entry : entries_) {
    const auto* other = theirs.find(entry.key);
    if (!other && !entry.is_optional)
      result.push_back({entry.key, entry.text, "(absent)"});
    else if (other && !agree(entry, *other, relative_tolerance))
      result.push_back({entry.key, entry.text, other->text});
  }
  for (const auto& entry : theirs.entries_)
    if (!entry.is_optional && !find(entry.key)) result.push_back({entry.key, "(absent)", entry.text});
  return result;
}

std::vector<char> Contract::pack() const {
  std::vector<char> bytes;
  ByteWriter writer(bytes);
  writer.value(k_magic);
  writer.value(static_cast<std::uint32_t>(entries_.size()));
  for (const auto& entry : entries_) {
    writer.value(static_cast<std::uint8_t>(entry.is_number));
    writer.value(static_cast<std::uint8_t>(entry.is_optional));
    writer.text(entry.key);
    writer.text(entry.text);
    writer.value(entry.number);
  }
  return bytes;
}

Contract Contract::unpack(const char* bytes, std::size_t count) {
  ByteReader reader(bytes, count, "contract");
  if (reader.value<std::uint32_t>() != k_magic) reader.refuse("the message is no contract");
  const auto n = reader.value<std::uint32_t>();
  Contract contract;
  for (std::uint32_t i = 0; i < n; ++i) {  // a wrong n meets the end of the bytes
    Entry entry;
    const auto is_number = reader.value<std::uint8_t>();
    if (is_number > 1) reader.refuse("an entry is neither text nor number");
    entry.is_number = is_number == 1;
    const auto is_optional = reader.value<std::uint8_t>();
    if (is_optional > 1) reader.refuse("an entry is neither required nor optional");
    entry.is_optional = is_optional == 1;
    entry.key = reader.text();
    entry.text = reader.text();
    entry.number = reader.value<double>();
    contract.entries_.push_back(std::move(entry));
  }
  reader.expect_end();
  return contract;
}

std::string describe(const std::vector<Contract::Mismatch>& mismatches, const std::string& mine,
                     const std::string& theirs) {
  std::string text;
  for (const auto& mismatch : mismatches)
    text += "  " + mismatch.key + ": " + mine + " has " + mismatch.mine + ", " + theirs + " has " +
            mismatch.theirs + "\n";
  return text;
}

}  // namespace littoral::coupler
