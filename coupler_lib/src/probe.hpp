#pragma once

#include <mpi.h>

#include <optional>

namespace littoral::coupler {

/// A message that has come and that only its finder can receive, by MPI_Mrecv or MPI_Imrecv.
struct Found {
  MPI_Message handle = MPI_MESSAGE_NULL;
  int rank = 0;
  int bytes = 0;
};

/// Looks, without waiting, for a message of `rank` (or MPI_ANY_SOURCE).
inline std::optional<Found> probe(int rank, int tag, MPI_Comm intercomm) {
  int yes = 0;
  Found found;
  MPI_Status status;
  MPI_Improbe(rank, tag, intercomm, &yes, &found.handle, &status);
  if (!yes) return std::nullopt;
  found.rank = status.MPI_SOURCE;
  MPI_Get_count(&status, MPI_CHAR, &found.bytes);
  return found;
}

}  // namespace littoral::coupler
