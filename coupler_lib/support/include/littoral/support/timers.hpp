#pragma once

#include <string>
#include <utility>
#include <vector>

namespace littoral::support {

/// Wall time by phase. Phases are declared once and counted by index; nested scopes count in both.
/// The phase "wait" (time spent waiting for the partner) is kept apart from work.
class Timers {
 public:
  using Phase = std::size_t;
  Phase declare(const std::string& name);
  void add(Phase phase, double seconds) { seconds_[phase] += seconds; }

  class Scope {
   public:
    Scope(Timers& timers, Phase phase) : timers_(timers), phase_(phase), begin_(now()) {}
    ~Scope() { timers_.add(phase_, now() - begin_); }
    Scope(const Scope&) = delete;
    Scope& operator=(const Scope&) = delete;

   private:
    Timers& timers_;
    Phase phase_;
    double begin_;
  };
  Scope scope(Phase phase) { return Scope(*this, phase); }

  double seconds(Phase phase) const { return seconds_[phase]; }
  std::vector<std::pair<std::string, double>> table() const;  ///< (name, seconds), as declared
  static double now();                                        ///< monotonic [s]

 private:
  std::vector<std::string> names_;
  std::vector<double> seconds_;
};

}  // namespace littoral::support
