#include "coupling/window_driver.hpp"

#include "coupling/check_ledger.hpp"
#include "littoral/error.hpp"
#include "littoral/support/run_plan.hpp"

namespace littoral::sph {

namespace {

template <int D>
DomainBox<D> domain_box(const support::Scene& scene) {
  DomainBox<D> box;
  for (std::size_t d = 0; d < D; ++d) {
    const std::size_t axis = scene_axis<D>(d);
    box.lower[d] = scene.domain.lower[axis];
    box.upper[d] = scene.domain.upper[axis];
    box.sides[d] = scene.domain.sides[axis];
  }
  return box;
}

/// rho0 g [N/m^3]
std::array<double, 3> weight_of(const support::Scene& scene) {
  std::array<double, 3> weight = scene.gravity;
  for (std::size_t d = 0; d < 3; ++d) {
    // an image across a period is the particle itself: nothing of its pressure is another place's weight
    const bool repeats = scene.domain.sides[d][0] == support::Scene::Side::periodic;
    weight[d] = repeats ? 0.0 : weight[d] * scene.fluid.density;
  }
  return weight;
}

}  // namespace

template <int D>
WindowDriver<D>::WindowDriver(const support::Scene& scene, const CouplingConfig& config,
                              const Numerics<D>& numerics, coupler::FvPartner& partner)
    : partner_(partner),
      passes_(scene.coupling.schedule.sph_passes()),
      with_phi_(support::level_set_crosses(scene)),
      sample_rules_{config.samples, numerics.kernel_radius, scene.has_free_surface(), weight_of(scene)},
      spacing_(numerics.spacing),
      phi_band_(config.phi_band * numerics.spacing),
      level_follows_fv_(!numerics.free_surface),
      reference_pressure_(numerics.eos.p0),
      skin_(numerics.skin),
      domain_(domain_box<D>(scene)),
      donors_(scene),
      hooks_(Layers<D>::from_scene(scene, numerics.kernel_radius), numerics, donors_, config.removal,
             config.rows) {}

template <int D>
void WindowDriver<D>::begin(Particles<D>& particles) {
  for (std::size_t i = 0; i < particles.n_owned; ++i)
    particles.zone[i] = layers().zone(layers().excess(at<D>(particles.x, i)));
  hooks_.exchange().start(particles);
}

template <int D>
void WindowDriver<D>::divide_among(OtherRanks<D>* others) {
  others_ = others;
  hooks_.exchange().divide_among(others);
}

template <int D>
void WindowDriver<D>::announce(Particles<D>& particles) {
  // Particles pass the outer face by less than a spacing before they are removed; one more holds the donors'
  // own extent, which is the partner's to add.
  const double skin = 2.0 * spacing_;
  coupler::Box needs = layers().needs(skin), covers = layers().covers();
  if (others_ != nullptr) {
    const RankBox<D>& mine = others_->regions()[static_cast<std::size_t>(others_->rank())];
    needs = rank_part(needs, mine, domain_, skin + skin_);
    covers = rank_part(covers, mine, domain_, 0.0);
  }
  partner_.announce(needs, covers);
  donors_.set_geometry(partner_.donor_geometry());
  forget_hints(particles);
  samples_.resize(partner_.targets().size(), with_phi_);
}

template <int D>
void WindowDriver<D>::forget_hints(Particles<D>& particles) {
  hooks_.exchange().elements().forget_hints();
  particles.donor_hint.assign(particles.n_owned, -1);
}

template <int D>
void WindowDriver<D>::advance(const coupler::Agreement& agreement, Particles<D>& particles,
                              Dynamics<D>& dynamics) {
  const coupler::Window& window = agreement.window;
  const double dt = window.substep_dt();
  Particles<D> start;
  ParticleExchange<D> start_exchange;
  if (passes_ > 1) {
    start = particles;
    start_exchange = hooks_.exchange();
  }
  for (int pass = 0; pass < passes_; ++pass) {
    if (pass > 0) {
      particles = start;
      hooks_.exchange() = start_exchange;
      dynamics.forget_lists();
    }
    partner_.receive(window, donors_.values());
    if (level_follows_fv_ && hooks_.exchange().elements().size() > 0)
      dynamics.set_pressure_level(hooks_.exchange().elements().mean_pressure(
          donors_, window.t_begin, reference_pressure_, dynamics.walls()));
    for (int k = 0; k < window.substeps; ++k) dynamics.step(particles, window.t_begin + k * dt, dt, &hooks_);
    send_samples(window, particles, dynamics);
  }
  if (agreement.wants_particles) partner_.send_particles(window, particle_states(particles, window.t_end));
  ledger_ = partner_.exchange(window, hooks_.exchange().ledger(particles));
  check_ledger(ledger_, window.t_end);
}

template <int D>
void WindowDriver<D>::send_samples(const coupler::Window& window, Particles<D>& particles,
                                   Dynamics<D>& dynamics) {
  dynamics.prepare(particles, window.t_end, &hooks_, dynamics.stable_time_step());
  samples_.time = window.t_end;
  sample_states(particles, layers(), sample_rules_, partner_.targets(), samples_, dynamics.walls(),
                &dynamics.ghosts());
  if (with_phi_) {
    const SurfaceDistance<D> surface(particles, dynamics.ghosts(), sample_rules_.kernel_radius, spacing_,
                                     surface_reach());
    sample_level_set(surface, phi_band_, partner_.targets(), samples_);
    constrain_pressure(particles, layers(), surface, spacing_, reference_pressure_, partner_.targets(),
                       samples_);
  }
  partner_.send(window, samples_);
}

template <int D>
coupler::ParticleStates particle_states(const Particles<D>& particles, double time) {
  coupler::ParticleStates states;
  states.time = time;
  for (std::size_t i = 0; i < particles.n_owned; ++i) {
    if (particles.zone[i] != Zone::blending && particles.surface[i] == SurfaceFlag::none) continue;
    const auto x = to_vec3<D>(at<D>(particles.x, i));
    const auto u = to_vec3<D>(at<D>(particles.u, i));
    const bool on_surface = particles.surface[i] == SurfaceFlag::surface;
    const auto n = on_surface ? to_vec3<D>(at<D>(particles.normal, i)) : coupler::Vec3{};
    states.x.push_back(x[0]);
    states.y.push_back(x[1]);
    states.z.push_back(x[2]);
    states.u.push_back(u[0]);
    states.v.push_back(u[1]);
    states.w.push_back(u[2]);
    states.p.push_back(particles.p[i]);
    states.V.push_back(particles.V[i]);
    states.on_surface.push_back(on_surface ? 1 : 0);
    states.nx.push_back(n[0]);
    states.ny.push_back(n[1]);
    states.nz.push_back(n[2]);
  }
  return states;
}

template class WindowDriver<2>;
template class WindowDriver<3>;
template coupler::ParticleStates particle_states<2>(const Particles<2>&, double);
template coupler::ParticleStates particle_states<3>(const Particles<3>&, double);

}  // namespace littoral::sph
