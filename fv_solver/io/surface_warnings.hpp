#pragma once

#include <string>
#include <vector>

#include "free_surface/free_surface.hpp"

namespace littoral::fv {

/// What a user has to hear of a free surface while a run goes on: each thing once, and again when it has
/// become much worse.
class SurfaceWarnings {
 public:
  /// Of the start: a pressure that does not fit the surface.
  template <int D>
  static std::vector<std::string> of_start(const FreeSurface<D>& surface, double sound_speed);
  /// After step `step`: water too thin to be trusted; water lost or gained.
  template <int D>
  std::vector<std::string> after(long step, const FreeSurface<D>& surface);

 private:
  double thin_told_ = 0.0;               // cells in the last warning
  double volume_told_ = k_volume_limit;  // relative error beyond which there is another
  /// A level set on few cells loses and gains that much; a run that does is on its way to be useless.
  static constexpr double k_volume_limit = 0.01;
};

}  // namespace littoral::fv
