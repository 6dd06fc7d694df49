#pragma once

#include <array>
#include <chrono>
#include <cstddef>

namespace littoral::sph {

/// Wall time of the parts of a step.
enum class Phase : std::size_t {
  lists,
  surface,
  shift,
  gradients,
  fluxes,
  walls,
  terms,
  update,
  hooks,
  count
};
constexpr std::array<const char*, static_cast<std::size_t>(Phase::count)> k_phase_names = {
    "lists", "surface", "shift", "gradients", "fluxes", "walls", "terms", "update", "coupling"};

class PhaseSeconds {
 public:
  class Scope {
   public:
    Scope(PhaseSeconds& all, Phase phase) : all_(all), phase_(phase), begin_(Clock::now()) {}
    ~Scope() {
      all_.seconds_[static_cast<std::size_t>(phase_)] +=
          std::chrono::duration<double>(Clock::now() - begin_).count();
    }
    Scope(const Scope&) = delete;
    Scope& operator=(const Scope&) = delete;

   private:
    using Clock = std::chrono::steady_clock;
    PhaseSeconds& all_;
    Phase phase_;
    Clock::time_point begin_;
  };
  double operator[](std::size_t phase) const { return seconds_[phase]; }
  double operator[](Phase phase) const { return seconds_[static_cast<std::size_t>(phase)]; }
  double total() const {
    double sum = 0.0;
    for (double s : seconds_) sum += s;
    return sum;
  }

 private:
  std::array<double, static_cast<std::size_t>(Phase::count)> seconds_{};
};

}  // namespace littoral::sph
