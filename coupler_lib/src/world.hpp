#pragma once

#include <mpi.h>

#include <string>

namespace littoral::coupler {

/// Ends all programs of the job with a non-zero status: shows `shown` (if not empty), tells the partner
/// `reason`, leaves both a moment to print, then aborts the world. Needs MPI running.
[[noreturn]] void end_world(MPI_Comm intercomm, const std::string& shown, const std::string& reason);

int world_rank();
int world_size();

}  // namespace littoral::coupler
