// Speaks the protocol as the sph side and misbehaves on demand; see mock.hpp for what it can be told.
#include <cstring>

#include "mock.hpp"

int main(int argc, char** argv) {
  using namespace littoral;
  for (int i = 1; i < argc; ++i)
    if (std::strcmp(argv[i], "wrong-version") == 0)
      return mock::play_wrong_version(argc, argv, coupler::Role::sph);
  return coupler::run_program(argc, argv, coupler::Role::sph, "mock",
                              [](coupler::Job& job, int n, char** arguments) {
                                if (n > 1 && std::strcmp(arguments[1], "--help") == 0) return 0;
                                return mock::play_sph(job, mock::parse(n, arguments));
                              });
}
