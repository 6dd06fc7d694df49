#pragma once

namespace littoral::coupler {
class Job;
}

namespace littoral::sph {

/// What sph_solver does with its command line: reads, checks, runs. returns the exit status
/// comm: collective over the program. throws ConfigError, IoError, CouplingError, StabilityError
int run_program(coupler::Job& job, int argc, char** argv);

}  // namespace littoral::sph
