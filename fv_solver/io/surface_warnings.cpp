#include "io/surface_warnings.hpp"

#include <cmath>
#include <cstdio>

#include "grid/space.hpp"

namespace littoral::fv {
namespace {

template <class... Values>
std::string format(const char* pattern, Values... values) {
  char text[400];
  std::snprintf(text, sizeof text, pattern, values...);
  return text;
}

}  // namespace

template <int D>
std::vector<std::string> SurfaceWarnings::of_start(const FreeSurface<D>& surface, double sound_speed) {
  if (surface.budget().volume == 0.0)
    return {"warning: initial.surface (< 0 in water) leaves no water in any cell of the grid"};
  const StartPressure& start = surface.start_pressure();
  if (start.misfit <= StartPressure::k_far) return {};
  if (start.replaced)
    return {
        format("initial.p is %.0f%% off the pressure of water at rest below initial.surface; with an "
               "infinite sound speed it is only a first guess, and that of water at rest is taken",
               100.0 * start.misfit)};
  return {format(
      "warning: initial.p is %.0f%% off the pressure of water at rest below initial.surface: at a sound "
      "speed of %.4g m/s the run begins with the sound that this makes",
      100.0 * start.misfit, sound_speed)};
}

template <int D>
std::vector<std::string> SurfaceWarnings::after(long step, const FreeSurface<D>& surface) {
  std::vector<std::string> warnings;
  const ThinWater<D>& thin = surface.thin_water();
  if (thin.cells > 4.0 * thin_told_) {
    thin_told_ = thin.cells;
    const coupler::Vec3 x = vector_in_space<D>(thin.place);
    warnings.push_back(
        format("step %ld: %.0f cells of water are threads, sheets or drops no thicker than a cell, as at "
               "(%.4g, %.4g, "
               "%.4g) m: the level set carries them, but cannot be trusted there; finer cells, or particles, "
               "resolve "
               "them (column thin_water_cells)",
               step, thin.cells, x[0], x[1], x[2]));
  }
  const double error = surface.budget().relative_error();
  if (std::abs(error) > volume_told_) {
    volume_told_ = 2.0 * std::abs(error);
    warnings.push_back(format(
        "step %ld: %+.1f%% of the water has come from nowhere (column volume_error): look at the surface; "
        "finer cells, a smaller step or level_set.volume_correction: local keep more of it",
        step, 100.0 * error));
  }
  return warnings;
}

template std::vector<std::string> SurfaceWarnings::of_start(const FreeSurface<2>&, double);
template std::vector<std::string> SurfaceWarnings::of_start(const FreeSurface<3>&, double);
template std::vector<std::string> SurfaceWarnings::after(long, const FreeSurface<2>&);
template std::vector<std::string> SurfaceWarnings::after(long, const FreeSurface<3>&);

}  // namespace littoral::fv
