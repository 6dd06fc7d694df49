#include "littoral/coupler/types.hpp"

namespace littoral::coupler {

const char* name(Role role) { return role == Role::sph ? "sph" : "fv"; }

Box Box::grown(double skin) const {
  if (empty()) return *this;
  Box box = *this;
  for (std::size_t d = 0; d < 3; ++d) {
    box.lower[d] -= skin;
    box.upper[d] += skin;
  }
  return box;
}

}  // namespace littoral::coupler
