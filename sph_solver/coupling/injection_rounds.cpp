#include "coupling/injection_rounds.hpp"

#include <algorithm>
#include <cmath>

namespace littoral::sph {

template <int D>
std::vector<std::size_t> injection_rounds(const FaceElements<D>& elements,
                                          const std::vector<std::size_t>& due,
                                          const std::vector<std::size_t>& owner, double near) {
  std::vector<std::size_t> round(due.size(), 0);
  for (std::size_t k = 0; k < due.size(); ++k)
    for (std::size_t j = 0; j < k; ++j) {
      if (elements[due[j]].box != elements[due[k]].box) continue;
      if (elements.distance(due[j], due[k]) >= near) continue;
      round[k] = std::max(round[k], round[j] + (owner[j] == owner[k] ? 0 : 1));
    }
  return round;
}

template std::vector<std::size_t> injection_rounds<2>(const FaceElements<2>&, const std::vector<std::size_t>&,
                                                      const std::vector<std::size_t>&, double);
template std::vector<std::size_t> injection_rounds<3>(const FaceElements<3>&, const std::vector<std::size_t>&,
                                                      const std::vector<std::size_t>&, double);

}  // namespace littoral::sph
