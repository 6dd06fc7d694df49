#include "coupling/check_ledger.hpp"

#include <cmath>
#include <sstream>

#include "littoral/error.hpp"

namespace littoral::sph {

void check_ledger(const coupler::Ledger& total, double time) {
  // Each particle's mass is rounded once, each element's sum is compensated: 1e-12 of the mass at stake is a
  // thousand times what is measured, and a millionth of a particle in a region of a million.
  const double stake = std::fabs(total.mass_inside) + std::fabs(total.mass_on_faces) +
                       std::fabs(total.mass_injected) + std::fabs(total.mass_removed) +
                       std::fabs(total.mass_flux);
  if (std::fabs(total.defect) <= 1e-12 * stake) return;
  std::ostringstream text;
  text.precision(17);
  text << "t = " << time << " s: the mass ledger of the SPH region does not close: defect " << total.defect
       << " kg; in particles " << total.mass_inside << ", on the faces " << total.mass_on_faces
       << ", flux since start " << total.mass_flux << ", injected " << total.mass_injected << ", removed "
       << total.mass_removed << ". Particles were lost or masses changed outside the exchange.";
  throw StabilityError(text.str());
}

}  // namespace littoral::sph
