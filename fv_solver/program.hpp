#pragma once

#include "littoral/coupler/job.hpp"

namespace littoral::fv {

/// What the program does between MPI's start and end; returns the exit status.
int run(coupler::Job& job, int argc, char** argv);

}  // namespace littoral::fv
