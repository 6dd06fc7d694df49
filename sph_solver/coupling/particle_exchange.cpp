#include "coupling/particle_exchange.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "coupling/injection_place.hpp"
#include "littoral/error.hpp"

namespace littoral::sph {

namespace {

// Distance to the nearest particle that a new one must have [spacings]. Where water flows in, a place soon
// empties: the mass waits, up to that of one more particle. Where it flows out there is only a particle due
// because others left early; it comes where there is a void, else the mass waits for one.
constexpr double k_room_inflow = 0.65;
constexpr double k_room_outflow = 0.9;

double power(double base, int exponent) {
  double product = 1.0;
  for (int k = 0; k < exponent; ++k) product *= base;
  return product;
}

/// Index of the counts by face.
template <int D>
std::size_t face_of(const FaceElement<D>& element) {
  return 2 * space_axis<D>(element.axis) + element.side;
}

/// Particles within `reach` of an open outer face, or beyond it.
template <int D>
std::vector<std::size_t> near_faces(const Particles<D>& particles, const Layers<D>& layers, double reach) {
  std::vector<std::size_t> found;
  const double from = layers.blending_width() + layers.driven_width() - reach;
  for (std::size_t i = 0; i < particles.n_owned; ++i)
    if (layers.excess(at<D>(particles.x, i)) > from) found.push_back(i);
  return found;
}

}  // namespace

template <int D>
ParticleExchange<D>::ParticleExchange(const Layers<D>& layers, const LinearEos& eos, double spacing,
                                      Removal removal)
    : layers_(layers),
      eos_(eos),
      spacing_(spacing),
      m0_(eos.density(eos.p0) * power(spacing, D)),
      removal_(removal),
      elements_(layers, spacing) {}

template <int D>
void ParticleExchange<D>::start(const Particles<D>& particles) {
  start_mass_ = Compensated();
  for (std::size_t i = 0; i < particles.n_owned; ++i) start_mass_ += particles.m[i];
}

template <int D>
void ParticleExchange<D>::lose(double mass) {
  lost_ += mass;
  ++counts_.lost;
}

template <int D>
void ParticleExchange<D>::doom(const Particles<D>& particles, std::size_t i, std::size_t element) {
  elements_.credit(element, particles.m[i]);
  removed_ += particles.m[i];
  doomed_[i] = 1;
  ++n_doomed_;
  ++counts_.removed_through[face_of<D>(elements_[element])];
}

template <int D>
void ParticleExchange<D>::find_crossed(const Particles<D>& particles, double margin) {
  const double end = layers_.blending_width() + layers_.driven_width() + margin;
  for (std::size_t i = 0; i < particles.n_owned; ++i) {
    const Point<D> x = at<D>(particles.x, i);
    if (!(layers_.excess(x) > end)) continue;
    const std::size_t element = elements_.crossed(x);
    if (element == elements_.size()) continue;
    doom(particles, i, element);
    ++counts_.removed_crossing;
  }
}

template <int D>
void ParticleExchange<D>::find_nearest(const Particles<D>& particles) {
  std::vector<std::size_t> near;  // found once, when an element asks
  for (std::size_t e = 0; e < elements_.size(); ++e) {
    while (elements_.mass(e) < -m0_) {
      // what is further away belongs to other elements: the debt waits until a particle comes by
      const double reach = 2.0 * spacing_;
      if (near.empty()) near = near_faces(particles, layers_, reach);
      double s_min = reach * reach;
      std::size_t nearest = particles.n_owned;
      for (std::size_t i : near) {
        double s = 0.0;
        for (std::size_t d = 0; d < D; ++d) {
          const double r = particles.x[d][i] - elements_[e].centre[d];
          s += r * r;
        }
        if (doomed_[i] == 0 && s < s_min) {
          s_min = s;
          nearest = i;
        }
      }
      if (nearest == particles.n_owned) break;
      doom(particles, nearest, e);
      ++counts_.removed_nearest;
    }
  }
}

template <int D>
double ParticleExchange<D>::mass_due(std::size_t element) const {
  return removal_ == Removal::crossing && elements_.inflow_speed(element) > 0.0 ? 0.5 * m0_ : m0_;
}

template <int D>
bool ParticleExchange<D>::inject(Particles<D>& particles, const Exterior& fv, double time) {
  std::vector<std::size_t> due;
  for (std::size_t e = 0; e < elements_.size(); ++e)
    if (elements_.mass(e) >= mass_due(e)) due.push_back(e);
  if (due.empty()) return false;
  const std::int64_t before = counts_.injected;

  std::vector<PresentParticles<D>> present;
  for (const auto& box : layers_.boxes()) present.emplace_back(box, 2.0 * spacing_);
  for (std::size_t i : near_faces(particles, layers_, 4.0 * spacing_))
    for (auto& around : present) around.add(at<D>(particles.x, i));
  for (auto& around : present) around.sort();
  for (std::size_t e : due) {
    auto& around = present[elements_[e].box];
    while (elements_.mass(e) >= mass_due(e)) {
      // the particle's centre is the water that passed the face when half of m0 had: so far it has come since
      const double depth = (elements_.mass(e) - 0.5 * m0_) / (eos_.density(eos_.p0) * elements_[e].area);
      const bool inflow = elements_.inflow_speed(e) > 0.0;
      const bool pressed = inflow && elements_.mass(e) >= mass_due(e) + m0_;
      const auto place =
          injection_place<D>(elements_[e], depth, spacing_, pressed, around, fv, time, elements_.hint(e));
      if (place.room < (inflow ? k_room_inflow : k_room_outflow) * spacing_ && !pressed) break;
      if (place.room < 0.0) break;  // FV's water is not there yet
      NewParticle<D> particle;
      particle.x = place.x;
      const auto state = fv.at(to_vec3<D>(particle.x), time, elements_.hint(e));
      if (!state) {
        const auto x = to_vec3<D>(particle.x);
        std::ostringstream text;
        text << "t = " << time << " s: no donor cells where a particle must be injected, (" << x[0] << ", "
             << x[1] << ", " << x[2] << ").";
        throw CouplingError(text.str());
      }
      for (std::size_t d = 0; d < D; ++d) particle.u[d] = state->u[space_axis<D>(d)];
      particle.p = state->p;
      particle.m = m0_;
      particle.V = m0_ / eos_.density(state->p);
      particle.zone = layers_.zone(layers_.excess(particle.x));
      particles.append(particle);
      particles.rho.back() = eos_.density(state->p);
      around.add(particle.x);
      elements_.credit(e, -m0_);
      injected_ += m0_;
      ++counts_.injected;
      ++counts_.injected_through[face_of<D>(elements_[e])];
    }
  }
  return counts_.injected > before;
}

template <int D>
bool ParticleExchange<D>::step(Particles<D>& particles, const Exterior& fv, double time, double dt) {
  if (elements_.size() == 0) return false;
  elements_.integrate(fv, eos_, time, dt);
  doomed_.assign(particles.n_owned, 0);
  n_doomed_ = 0;
  find_crossed(particles, removal_ == Removal::crossing ? 0.0 : spacing_);
  if (removal_ == Removal::nearest) find_nearest(particles);
  if (n_doomed_ > 0) particles.remove(doomed_);
  elements_.level_outflow(m0_);
  return inject(particles, fv, time + dt) || n_doomed_ > 0;
}

template <int D>
coupler::Ledger ParticleExchange<D>::ledger(const Particles<D>& particles) const {
  Compensated inside;
  for (std::size_t i = 0; i < particles.n_owned; ++i) inside += particles.m[i];
  coupler::Ledger ledger;
  ledger.mass_inside = inside.value();
  ledger.mass_on_faces = elements_.total_mass();
  ledger.mass_injected = injected_.value();
  ledger.mass_removed = removed_.value();
  ledger.mass_flux = elements_.flux();
  ledger.n_injected = static_cast<double>(counts_.injected);
  ledger.n_removed = static_cast<double>(counts_.removed_crossing + counts_.removed_nearest);
  Compensated defect = inside;
  defect += ledger.mass_on_faces;
  defect += lost_;
  defect -= start_mass_.value();
  defect -= ledger.mass_flux;
  ledger.defect = defect.value();
  return ledger;
}

template <int D>
std::vector<double> ParticleExchange<D>::pack() const {
  std::vector<double> packed = elements_.pack();
  for (const Compensated* sum : {&start_mass_, &injected_, &removed_, &lost_}) {
    packed.push_back(sum->sum());
    packed.push_back(sum->carry());
  }
  return packed;
}

template <int D>
std::vector<std::int64_t> ParticleExchange<D>::pack_counts() const {
  std::vector<std::int64_t> packed = {counts_.injected, counts_.removed_crossing, counts_.removed_nearest,
                                      counts_.lost};
  for (const auto* by_face : {&counts_.injected_through, &counts_.removed_through})
    packed.insert(packed.end(), by_face->begin(), by_face->end());
  return packed;
}

template <int D>
void ParticleExchange<D>::unpack(const std::vector<double>& packed, const std::vector<std::int64_t>& counts) {
  constexpr std::size_t tail = 8;
  if (packed.size() < tail || counts.size() != pack_counts().size())
    throw IoError("particle exchange: the record is too short.");
  const std::size_t first = packed.size() - tail;
  elements_.unpack(std::vector<double>(packed.begin(), packed.begin() + static_cast<std::ptrdiff_t>(first)));
  std::size_t k = first;
  for (Compensated* sum : {&start_mass_, &injected_, &removed_, &lost_}) {
    *sum = Compensated(packed[k], packed[k + 1]);
    k += 2;
  }
  counts_.injected = counts[0];
  counts_.removed_crossing = counts[1];
  counts_.removed_nearest = counts[2];
  counts_.lost = counts[3];
  auto next = counts.begin() + 4;
  for (auto* by_face : {&counts_.injected_through, &counts_.removed_through})
    for (auto& count : *by_face) count = *next++;
}

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

template class ParticleExchange<2>;
template class ParticleExchange<3>;

}  // namespace littoral::sph
