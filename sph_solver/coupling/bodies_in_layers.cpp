#include "coupling/bodies_in_layers.hpp"

#include <sstream>

#include "coupling/axes.hpp"

namespace littoral::sph {
namespace {

std::string fault(const std::string& body, const coupler::Vec3& x) {
  std::ostringstream text;
  text << "body '" << body << "' reaches into the coupling layers of the region, point (" << x[0] << ", "
       << x[1] << ", " << x[2]
       << ") m, where the partner moves the water and it comes and goes. Let the region hold the body whole, "
          "layers outside of it, or end short of it; for a flat floor or wall along the region take a "
          "symmetry side of the domain.";
  return text.str();
}

}  // namespace

template <int D>
std::string body_in_the_layers(const Walls<D>& walls, const Layers<D>& layers,
                               const FaceElements<D>& elements) {
  const auto& dummies = walls.dummies();
  for (std::size_t e = 0; e < dummies.size(); ++e) {
    const auto& x = dummies[e].x;
    if (layers.inside_outer(x) && layers.excess(x) > 0.0)
      return fault(walls.bodies()[static_cast<std::size_t>(dummies[e].body)].name(), to_vec3<D>(x));
  }
  for (std::size_t e = 0; e < elements.size(); ++e)  // far inside a body there are no dummies
    if (const Body* body = walls.holder(elements[e].centre))
      return fault(body->name(), to_vec3<D>(elements[e].centre));
  return "";
}

template std::string body_in_the_layers<2>(const Walls<2>&, const Layers<2>&, const FaceElements<2>&);
template std::string body_in_the_layers<3>(const Walls<3>&, const Layers<3>&, const FaceElements<3>&);

}  // namespace littoral::sph
