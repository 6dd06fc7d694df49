#include "littoral/coupler/job.hpp"
#include "program.hpp"

/// Everything that can go wrong ends in run_program's one catch.
int main(int argc, char** argv) {
  using namespace littoral;
  return coupler::run_program(
      argc, argv, coupler::Role::sph, LITTORAL_VERSION,
      [](coupler::Job& job, int count, char** values) { return sph::run_program(job, count, values); });
}
