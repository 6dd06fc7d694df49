#pragma once

#include <string>
#include <vector>

namespace littoral::coupler {

/// What both programs must agree on before the first window: named entries, texts or numbers.
/// Numbers agree within a relative tolerance (both sides read the same file, so it is round-off of a
/// conversion). Both sides must give a required entry. An optional one is compared where both give it: it is
/// what the exchange could do without, or what only programs that read the same file can know.
class Contract {
 public:
  struct Entry {
    std::string key;
    std::string text;  // for a number: its shortest exact decimal form
    double number = 0.0;
    bool is_number = false;
    bool is_optional = false;
  };
  struct Mismatch {
    std::string key;
    std::string mine;  // "(absent)" where a side has no such key
    std::string theirs;
  };

  Contract& set(const std::string& key, const std::string& text);
  Contract& set(const std::string& key, const char* text) { return set(key, std::string(text)); }
  Contract& set(const std::string& key, double number);
  Contract& make_optional(const std::string& key);  ///< pre: the key is set
  const std::vector<Entry>& entries() const { return entries_; }
  const Entry* find(const std::string& key) const;

  /// All differences, in my order, then theirs. pure
  std::vector<Mismatch> compare(const Contract& theirs, double relative_tolerance = 1e-12) const;

  std::vector<char> pack() const;
  static Contract unpack(const char* bytes, std::size_t count);  ///< throws CouplingError if not a contract

 private:
  std::vector<Entry> entries_;
};

/// "key: mine, theirs" lines for both programs' screens.
std::string describe(const std::vector<Contract::Mismatch>& mismatches, const std::string& mine,
                     const std::string& theirs);

}  // namespace littoral::coupler
