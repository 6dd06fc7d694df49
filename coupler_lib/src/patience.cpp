#include "patience.hpp"

#include <algorithm>
#include <chrono>
#include <thread>

#include "littoral/error.hpp"
#include "validate.hpp"

namespace littoral::coupler {

namespace {

constexpr double k_spin = 1e-3;  // [s] what a partner needs to unpack and pack a hundred thousand points
constexpr double k_shortest_sleep = 20e-6;  // [s]
constexpr double k_longest_sleep = 1e-3;    // [s]

}  // namespace

double wall_time() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

Patience::Patience(double deadline) : begin_(wall_time()), deadline_(deadline) {}

double Patience::elapsed() const { return wall_time() - begin_; }

bool Patience::expired() const { return elapsed() > deadline_; }

void Patience::pause() {
  const double waited = elapsed();
  if (waited < k_spin) {
    std::this_thread::yield();  // the partner may need this very core
    return;
  }
  std::this_thread::sleep_for(
      std::chrono::duration<double>(std::clamp(waited / 20.0, k_shortest_sleep, k_longest_sleep)));
}

void wait_politely(MPI_Request& request, double deadline, const std::string& what) {
  Patience patience(deadline);
  for (;;) {
    int done = 0;
    MPI_Test(&request, &done, MPI_STATUS_IGNORE);
    if (done) return;
    if (patience.expired())
      throw CouplingError("the other ranks of this program did not reach " + what + " within " +
                          text_of(deadline) + " s");
    patience.pause();
  }
}

}  // namespace littoral::coupler
