#pragma once

#include <mpi.h>

#include <string>

namespace littoral::coupler {

/// How to wait without burning a core: a spin of a millisecond for a partner that is about to answer, then
/// sleeps that grow with the time already waited (a twentieth of it, so that the answer is seen at most 5%
/// late), up to a millisecond.
class Patience {
 public:
  explicit Patience(double deadline);
  void pause();          ///< spins or sleeps
  bool expired() const;  ///< the deadline has passed
  double elapsed() const;

 private:
  double begin_, deadline_;
};

/// Waits for a request within this program (a nonblocking collective). throws CouplingError past the deadline
void wait_politely(MPI_Request& request, double deadline, const std::string& what);

double wall_time();  ///< monotonic [s]

}  // namespace littoral::coupler
