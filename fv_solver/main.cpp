#include "littoral/coupler/job.hpp"
#include "program.hpp"
#include "version.hpp"

int main(int argc, char** argv) {
  using namespace littoral;
  return coupler::run_program(argc, argv, coupler::Role::fv, fv::k_version, fv::run);
}
