#pragma once

#include <mpi.h>

#include <vector>

#include "outgoing.hpp"

namespace littoral::coupler {

/// Messages under way to the partner's ranks. A short one goes in one piece. Of a long one the header goes
/// first; the rest follows when the receiver has asked for it. So a sender whose partner still computes may
/// sleep, and once bytes move both sides look after them (MPI moves long messages only inside its calls).
class Outbox {
 public:
  explicit Outbox(MPI_Comm intercomm) : intercomm_(intercomm) {}

  /// The bytes must stay until they are gone.
  void start(int rank, const Bytes& message, const std::vector<Piece>& columns = {});
  /// Does what can be done now; true when everything is gone.
  bool progress();
  bool empty() const { return parcels_.empty(); }
  /// Before an error leaves: true when MPI no longer reads from our memory. Starts nothing.
  bool settled();
  bool moving() const;             ///< bytes of a long message are on their way
  std::vector<int> ranks() const;  ///< of those not yet gone

 private:
  struct Parcel {
    int rank = 0;
    std::vector<Piece> rest;  // of a long one, until the receiver asks for it
    bool gone = false;
    std::vector<MPI_Request> requests;
  };
  void send(Parcel& parcel, const Piece& piece, int tag);

  MPI_Comm intercomm_;
  std::vector<Parcel> parcels_;
};

}  // namespace littoral::coupler
