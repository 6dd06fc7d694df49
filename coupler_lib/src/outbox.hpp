#pragma once

#include <mpi.h>

#include <vector>

#include "bytes.hpp"

namespace littoral::coupler {

/// Messages under way to the partner's ranks. A short one goes in one piece. Of a long one the header goes
/// first; the rest follows when the receiver has asked for it. So a sender whose partner still computes may
/// sleep, and once bytes move both sides look after them (MPI moves long messages only inside its calls).
class Outbox {
 public:
  explicit Outbox(MPI_Comm intercomm) : intercomm_(intercomm) {}

  /// The bytes must stay until they are gone.
  void start(int rank, const Bytes& message);
  /// Does what can be done now; true when everything is gone.
  bool progress();
  bool empty() const { return parcels_.empty(); }
  bool moving() const;             ///< bytes of a long message are on their way
  std::vector<int> ranks() const;  ///< of those not yet gone

 private:
  struct Parcel {
    int rank = 0;
    const Bytes* message = nullptr;
    bool asked = true;  // short, or the receiver wants the rest
    bool gone = false;
    MPI_Request request = MPI_REQUEST_NULL;
  };
  MPI_Comm intercomm_;
  std::vector<Parcel> parcels_;
};

}  // namespace littoral::coupler
