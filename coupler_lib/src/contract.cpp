#include "littoral/coupler/contract.hpp"

#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "littoral/error.hpp"

namespace littoral::coupler {

namespace {

constexpr std::uint32_t k_magic = 0x4c43'4f4e;  // "LCON"
constexpr std::size_t k_max_entries = 100'000;

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

void append(std::vector<char>& bytes, const void* data, std::size_t count) {
  const auto* begin = static_cast<const char*>(data);
  bytes.insert(bytes.end(), begin, begin + count);
}

void append(std::vector<char>& bytes, const std::string& text) {
  const auto length = static_cast<std::uint32_t>(text.size());
  append(bytes, &length, sizeof length);
  append(bytes, text.data(), text.size());
}

/// Reads forward and never past the end.
class Reader {
 public:
  Reader(const char* bytes, std::size_t count) : at_(bytes), left_(count) {}
  void read(void* target, std::size_t count) {
    if (count > left_) throw CouplingError("contract: the message ends in the middle of an entry");
    if (count > 0) std::memcpy(target, at_, count);
    at_ += count;
    left_ -= count;
  }
  template <class T>
  T value() {
    T result{};
    read(&result, sizeof result);
    return result;
  }
  std::string text() {
    const auto length = value<std::uint32_t>();
    if (length > left_) throw CouplingError("contract: a text is longer than the message");
    std::string result(length, '\0');
    read(result.data(), length);
    return result;
  }
  std::size_t left() const { return left_; }

 private:
  const char* at_;
  std::size_t left_;
};

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

const Contract::Entry* Contract::find(const std::string& key) const {
  for (const auto& entry : entries_)
    if (entry.key == key) return &entry;
  return nullptr;
}

std::vector<Contract::Mismatch> Contract::compare(const Contract& theirs, double relative_tolerance) const {
  std::vector<Mismatch> result;
  for (const auto& entry : entries_) {
    const auto* other = theirs.find(entry.key);
    if (!other)
      result.push_back({entry.key, entry.text, "(absent)"});
    else if (!agree(entry, *other, relative_tolerance))
      result.push_back({entry.key, entry.text, other->text});
  }
  for (const auto& entry : theirs.entries_)
    if (!find(entry.key)) result.push_back({entry.key, "(absent)", entry.text});
  return result;
}

std::vector<char> Contract::pack() const {
  std::vector<char> bytes;
  const auto count = static_cast<std::uint32_t>(entries_.size());
  append(bytes, &k_magic, sizeof k_magic);
  append(bytes, &count, sizeof count);
  for (const auto& entry : entries_) {
    const std::uint8_t is_number = entry.is_number;
    append(bytes, &is_number, sizeof is_number);
    append(bytes, entry.key);
    append(bytes, entry.text);
    append(bytes, &entry.number, sizeof entry.number);
  }
  return bytes;
}

Contract Contract::unpack(const char* bytes, std::size_t count) {
  Reader reader(bytes, count);
  if (reader.value<std::uint32_t>() != k_magic) throw CouplingError("contract: the message is no contract");
  const auto n = reader.value<std::uint32_t>();
  if (n > k_max_entries) throw CouplingError("contract: absurd number of entries");
  Contract contract;
  for (std::uint32_t i = 0; i < n; ++i) {
    Entry entry;
    const auto is_number = reader.value<std::uint8_t>();
    if (is_number > 1) throw CouplingError("contract: an entry is neither text nor number");
    entry.is_number = is_number == 1;
    entry.key = reader.text();
    entry.text = reader.text();
    entry.number = reader.value<double>();
    contract.entries_.push_back(std::move(entry));
  }
  if (reader.left() != 0) throw CouplingError("contract: bytes follow the last entry");
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
