#include "prediction.hpp"

#include <cmath>
#include <sstream>
#include <vector>

#include "littoral/error.hpp"
#include "littoral/support/run_plan.hpp"
#include "physics/dynamics.hpp"

namespace littoral::sph {

template <int D>
Layers<D> region_of(const RunConfig& config, bool coupled) {
  support::Scene scene = config.scene;
  if (!coupled) scene.coupling.kind = support::Scene::CouplingKind::none;
  return Layers<D>::from_scene(scene, numerics_of<D>(config).kernel_radius);
}

namespace {

/// Whether the lattice of a box stands at x already. One's rows end half a spacing inside the faces: with
/// half of that allowed for, rows of two lattices that do not fit stay .75 spacing apart, and those that fit
/// lose none.
template <int D>
bool filled(const RegionBox<D>& box, const Point<D>& x, double spacing) {
  const double margin = 0.25 * spacing;
  for (std::size_t d = 0; d < D; ++d)
    if (x[d] < box.outer_lower[d] - margin || x[d] > box.outer_upper[d] + margin) return false;
  return true;
}

}  // namespace

template <int D>
void place_particles(const RunConfig& config, const Layers<D>& layers, const Walls<D>* walls,
                     Particles<D>& particles, const LatticeShare& share) {
  const auto& boxes = layers.boxes();
  for (std::size_t b = 0; b < boxes.size(); ++b) {
    const std::size_t first = particles.n_owned;
    fill_lattice<D>(boxes[b].outer_lower, boxes[b].outer_upper, config.sph.spacing, config.scene,
                    numerics_of<D>(config).eos, particles, share, walls);
    if (b == 0) continue;
    std::vector<char> twice(particles.n_owned, 0);
    for (std::size_t i = first; i < particles.n_owned; ++i)
      for (std::size_t q = 0; q < b; ++q)
        if (filled<D>(boxes[q], at<D>(particles.x, i), config.sph.spacing)) twice[i] = 1;
    particles.remove(twice);
  }
}

template <int D>
bool starts_empty(const RunConfig& config, const Particles<D>& particles, bool coupled) {
  if (particles.next_id > 0) return false;
  if (coupled && support::level_set_crosses(config.scene)) return true;
  throw ConfigError(
      "the scene has no particle at the start: initial.surface is not below 0 at any lattice point of the "
      "region outside the bodies. Check its sign (water where it is negative), the region's box and the "
      "spacing.");
}

namespace {

/// Bytes a particle takes: columns of particles, stages, what the pair loops read, and its row in the lists.
template <int D>
double bytes_of_particle(const Numerics<D>& numerics) {
  constexpr int state = 4 * D + 7, stages = 4 * D + 2, rate = D + 1;
  constexpr int surface = D + 3, lists = 2 * D + 2;  // while they are found
  const std::size_t rows =
      numerics.precision == Precision::mixed
          ? sizeof(typename PairRows<D, float>::State) + sizeof(typename PairRows<D, float>::Face)
          : sizeof(typename PairRows<D, double>::State) + sizeof(typename PairRows<D, double>::Face);
  const double pi = std::acos(-1.0);
  const double reach = (numerics.kernel_radius + numerics.skin) / numerics.spacing;
  const double neighbors = D == 2 ? pi * reach * reach : 4.0 / 3.0 * pi * reach * reach * reach;
  return sizeof(double) * (state + stages + rate + surface + lists) + static_cast<double>(rows) +
         sizeof(std::int32_t) * neighbors;
}

template <int D>
Prediction predict_in(const RunConfig& config, bool coupled) {
  Particles<D> particles;
  const auto layers = region_of<D>(config, coupled);
  const Dynamics<D> dynamics(numerics_of<D>(config), domain_of<D>(config), nullptr,
                             walls_of<D>(config, layers.boxes()[0].outer_lower));
  place_particles<D>(config, layers, dynamics.walls(), particles);
  (void)starts_empty(config, particles, coupled);
  Prediction prediction;
  prediction.particles = particles.n_owned;
  prediction.dt = dynamics.stable_time_step();
  prediction.steps = std::ceil(config.scene.time.end / prediction.dt);
  prediction.memory = static_cast<double>(particles.n_owned) * bytes_of_particle<D>(dynamics.numerics());
  return prediction;
}

}  // namespace

Prediction predict(const RunConfig& config, bool coupled) {
  return config.scene.dimension == 2 ? predict_in<2>(config, coupled) : predict_in<3>(config, coupled);
}

std::string Prediction::text() const {
  constexpr double mebibyte = 1024.0 * 1024.0;
  std::ostringstream lines;
  lines << "particles: " << particles << "\ndt: at most " << dt << " s\nsteps: at least " << steps
        << "\nmemory: about " << std::ceil(memory / mebibyte) << " MiB\n";
  return lines.str();
}

template Layers<2> region_of<2>(const RunConfig&, bool);
template Layers<3> region_of<3>(const RunConfig&, bool);
template void place_particles<2>(const RunConfig&, const Layers<2>&, const Walls<2>*, Particles<2>&,
                                 const LatticeShare&);
template void place_particles<3>(const RunConfig&, const Layers<3>&, const Walls<3>*, Particles<3>&,
                                 const LatticeShare&);
template bool starts_empty<2>(const RunConfig&, const Particles<2>&, bool);
template bool starts_empty<3>(const RunConfig&, const Particles<3>&, bool);

}  // namespace littoral::sph
