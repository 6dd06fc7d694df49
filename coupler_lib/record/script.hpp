#pragma once

#include <optional>
#include <string>

#include "question.hpp"
#include "tape.hpp"

namespace littoral::coupler {

/// A record read from its beginning, and the watch over whether the same is asked as then.
class Script {
 public:
  Script(const std::string& path, Role speaker, const std::string& scene) : tape_(path, speaker, scene) {}

  TapeReader& tape() { return tape_; }
  std::string description() const {
    return "replayed from " + tape_.path() + " (" + tape_.description() + ")";
  }

  /// Steps over the record's next call, which must be of this kind, for this window and with so many values
  /// (absent: any number). throws CouplingError: another call is due, the record is exhausted, the run is
  /// over
  void expect(CallKind kind, const Window& window, std::optional<std::size_t> count = {});

  void announce(const Question& asked);
  Agreement agree(const Proposal& mine, Role asking);
  Ledger exchange(const Window& window);
  void goodbye();

 private:
  const Call& due(CallKind kind) const;  ///< the next call, checked for its kind
  [[noreturn]] void refuse(const std::string& what) const;
  std::string reason(const Call& call);

  TapeReader tape_;
  std::size_t at_ = 0;    // calls answered
  bool stopped_ = false;  // by the run's own wish, before the record's end
  bool said_goodbye_ = false;
};

}  // namespace littoral::coupler
