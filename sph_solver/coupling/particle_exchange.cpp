#include "coupling/particle_exchange.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <sstream>

#include "coupling/injection_rounds.hpp"
#include "littoral/error.hpp"

namespace littoral::sph {

namespace {

// Distance to the nearest particle that a new one must have [spacings]. Where water flows in, a place soon
// empties: the mass waits, up to that of one more particle. Where it flows out there is only a particle due
// because others left early; it comes where there is a void, else the mass waits for one.
constexpr double k_room_inflow = 0.65;
constexpr double k_room_outflow = 0.9;
// At the face itself there always is room when a row has just left: only further in it tells of a void
// [spacings].
constexpr double k_depth_outflow = 1.0;

// A place lies within two spacings in front of its element and one beside it, and looks two spacings around
// itself for particles: what stands further from the element's centre does not matter to it [spacings].
constexpr double k_near = 5.0;
constexpr double k_apart = 8.0;  // nor do elements that far apart to each other [spacings]

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
                                      Removal removal, FaceRows rows)
    : layers_(layers),
      eos_(eos),
      spacing_(spacing),
      m0_(eos.density(eos.p0) * power(spacing, D)),
      removal_(removal),
      elements_(layers, spacing, rows) {}

template <int D>
void ParticleExchange<D>::divide_among(OtherRanks<D>* others) {
  others_ = others;
  elements_.divide_among(others);
}

template <int D>
void ParticleExchange<D>::start(const Particles<D>& particles) {
  start_mass_ = Compensated();
  for (std::size_t i = 0; i < particles.n_owned; ++i) start_mass_ += particles.m[i];
  if (others_ == nullptr) return;
  const auto all = others_->gather({start_mass_.sum(), start_mass_.carry()});
  start_mass_ = Compensated();
  for (std::size_t r = 0; r < all.size(); r += 2) start_mass_ += Compensated(all[r], all[r + 1]);
}

template <int D>
void ParticleExchange<D>::doom(std::size_t i) {
  doomed_[i] = 1;
  ++n_doomed_;
}

template <int D>
void ParticleExchange<D>::credit(const Leaver& leaver) {
  const auto element = static_cast<std::size_t>(leaver.element);
  elements_.credit(element, leaver.mass);
  removed_ += leaver.mass;
  ++counts_.removed_through[face_of<D>(elements_[element])];
}

template <int D>
std::vector<typename ParticleExchange<D>::Leaver> ParticleExchange<D>::of_all_ranks(
    std::vector<Leaver> mine) const {
  if (others_ != nullptr) {
    std::vector<double> numbers;
    for (const Leaver& l : mine) numbers.insert(numbers.end(), {l.id, l.mass, l.element, l.distance2});
    numbers = others_->gather(numbers);
    mine.clear();
    for (std::size_t k = 0; k < numbers.size(); k += 4)
      mine.push_back({numbers[k], numbers[k + 1], numbers[k + 2], numbers[k + 3]});
  }
  std::sort(mine.begin(), mine.end(), [](const Leaver& a, const Leaver& b) {
    return a.element != b.element ? a.element < b.element : a.id < b.id;
  });
  return mine;
}

template <int D>
void ParticleExchange<D>::find_crossed(const Particles<D>& particles, double margin) {
  const double end = layers_.blending_width() + layers_.driven_width() + margin;
  std::vector<Leaver> mine;
  for (std::size_t i = 0; i < particles.n_owned; ++i) {
    const Point<D> x = at<D>(particles.x, i);
    if (!(layers_.excess(x) > end)) continue;
    const std::size_t element = elements_.crossed(x);
    if (element == elements_.size()) continue;
    doom(i);
    mine.push_back({static_cast<double>(particles.id[i]), particles.m[i], static_cast<double>(element), 0.0});
  }
  for (const Leaver& leaver : of_all_ranks(std::move(mine))) {
    credit(leaver);
    ++counts_.removed_crossing;
  }
}

template <int D>
void ParticleExchange<D>::find_nearest(const Particles<D>& particles) {
  std::vector<std::size_t> asking;
  for (std::size_t e = 0; e < elements_.size(); ++e)
    if (elements_.mass(e) < -mass_of(e)) asking.push_back(e);
  if (asking.empty()) return;
  // what is further away belongs to other elements: the debt waits until a particle comes by
  const double reach = 2.0 * spacing_;
  const auto near = near_faces(particles, layers_, reach);
  std::vector<Leaver> candidates;
  for (std::size_t e : asking)
    for (std::size_t i : near) {
      double s = 0.0;
      for (std::size_t d = 0; d < D; ++d) {
        const double r = particles.x[d][i] - elements_[e].centre[d];
        s += r * r;
      }
      if (doomed_[i] == 0 && s < reach * reach)
        candidates.push_back(
            {static_cast<double>(particles.id[i]), particles.m[i], static_cast<double>(e), s});
    }
  candidates = of_all_ranks(std::move(candidates));
  std::set<double> gone;
  auto first = candidates.cbegin();
  for (std::size_t e : asking) {
    const auto last = std::find_if(first, candidates.cend(),
                                   [e](const Leaver& l) { return l.element > static_cast<double>(e); });
    while (elements_.mass(e) < -mass_of(e)) {
      auto nearest = last;
      for (auto l = first; l != last; ++l)
        if (gone.count(l->id) == 0 && (nearest == last || l->distance2 < nearest->distance2)) nearest = l;
      if (nearest == last) break;
      credit(*nearest);
      gone.insert(nearest->id);
      ++counts_.removed_nearest;
    }
    first = last;
  }
  for (std::size_t i : near)
    if (doomed_[i] == 0 && gone.count(static_cast<double>(particles.id[i])) > 0) doom(i);
}

template <int D>
double ParticleExchange<D>::mass_due(std::size_t element) const {
  return removal_ == Removal::crossing && elements_.inflow_speed(element) > 0.0 ? 0.5 * mass_of(element)
                                                                                : mass_of(element);
}

template <int D>
void ParticleExchange<D>::add_particles_near(const std::vector<std::size_t>& due,
                                             const Particles<D>& particles,
                                             std::vector<PresentParticles<D>>& present) const {
  std::vector<double> places;
  for (std::size_t i : near_faces(particles, layers_, 4.0 * spacing_)) {
    const Point<D> x = at<D>(particles.x, i);
    const auto matters = [&](std::size_t e) { return elements_.distance_to(e, x) < k_near * spacing_; };
    if (others_ == nullptr) {
      for (auto& around : present) around.add(x);
    } else if (std::any_of(due.begin(), due.end(), matters)) {
      places.insert(places.end(), x.begin(), x.end());
    }
  }
  if (others_ == nullptr) return;
  places = others_->gather(places);
  for (std::size_t k = 0; k < places.size(); k += D) {
    Point<D> x;
    std::copy_n(places.begin() + static_cast<std::ptrdiff_t>(k), D, x.begin());
    for (auto& around : present) around.add(x);
  }
}

template <int D>
void ParticleExchange<D>::inject_at(std::size_t k, std::size_t e, Particles<D>& particles, const Exterior& fv,
                                    double time, PresentParticles<D>& around, std::vector<Birth>& births) {
  for (std::size_t sequence = 0; elements_.mass(e) >= mass_due(e); ++sequence) {
    const double m = mass_of(e);
    // the particle's centre is the water that passed the face when half of m had: so far it has come since
    const double depth = (elements_.mass(e) - 0.5 * m) / (eos_.density(eos_.p0) * elements_[e].area);
    const bool inflow = elements_.inflow_speed(e) > 0.0;
    const bool pressed = inflow && elements_.mass(e) >= mass_due(e) + m;
    const auto place = injection_place<D>(elements_[e], depth, inflow ? 0.0 : k_depth_outflow * spacing_,
                                          spacing_, pressed, around, fv, time, elements_.hint(e));
    if (place.room < (inflow ? k_room_inflow : k_room_outflow) * spacing_ && !pressed) return;
    if (place.room < 0.0) return;  // FV's water is not there yet
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
    particle.m = m;
    particle.V = m / eos_.density(state->p);
    particle.zone = layers_.zone(layers_.excess(particle.x));
    particles.append(particle);
    particles.rho.back() = eos_.density(state->p);
    around.add(particle.x);
    elements_.credit(e, -m);
    births.push_back({k, sequence, particle.x});
  }
}

/// All ranks learn what one has born: where it stands and whose mass it took.
template <int D>
void ParticleExchange<D>::hear_of(const std::vector<Birth>& mine, const std::vector<std::size_t>& due,
                                  std::vector<PresentParticles<D>>& present, std::vector<Birth>& all) {
  std::vector<double> numbers;
  for (const Birth& birth : mine) {
    numbers.insert(numbers.end(), {static_cast<double>(birth.due), static_cast<double>(birth.sequence)});
    numbers.insert(numbers.end(), birth.x.begin(), birth.x.end());
  }
  numbers = others_->gather(numbers);
  for (auto it = numbers.begin(); it != numbers.end(); it += D + 2) {
    Birth birth{static_cast<std::size_t>(it[0]), static_cast<std::size_t>(it[1]), {}};
    std::copy_n(it + 2, D, birth.x.begin());
    all.push_back(birth);
    const std::size_t e = due[birth.due];
    if (elements_.is_mine(e)) continue;
    present[elements_[e].box].add(birth.x);
    elements_.credit(e, -mass_of(e));
  }
}

template <int D>
bool ParticleExchange<D>::inject(Particles<D>& particles, const Exterior& fv, double time) {
  std::vector<std::size_t> due, owner;
  for (std::size_t e = 0; e < elements_.size(); ++e) {
    if (elements_.mass(e) < mass_due(e)) continue;
    due.push_back(e);
    owner.push_back(elements_.owner(e));
  }
  if (due.empty()) return false;

  std::vector<PresentParticles<D>> present;
  for (const auto& box : layers_.boxes()) present.emplace_back(box, 2.0 * spacing_);
  add_particles_near(due, particles, present);
  for (auto& around : present) around.sort();

  std::vector<std::size_t> rounds(due.size(), 0);
  if (others_ != nullptr) rounds = injection_rounds(elements_, due, owner, k_apart * spacing_);
  const std::size_t last = *std::max_element(rounds.begin(), rounds.end());
  const std::size_t n_before = particles.n_owned;
  const std::int64_t first_id = particles.next_id;
  std::vector<Birth> mine, all;
  for (std::size_t round = 0; round <= last; ++round) {
    std::vector<Birth> of_round;
    for (std::size_t k = 0; k < due.size(); ++k)
      if (rounds[k] == round && elements_.is_mine(due[k]))
        inject_at(k, due[k], particles, fv, time, present[elements_[due[k]].box], of_round);
    mine.insert(mine.end(), of_round.begin(), of_round.end());
    if (others_ != nullptr) hear_of(of_round, due, present, all);
  }
  if (others_ == nullptr) all = mine;
  // ids in the order of the elements, whoever owns them
  const auto before = [](const Birth& a, const Birth& b) {
    return a.due != b.due ? a.due < b.due : a.sequence < b.sequence;
  };
  std::sort(all.begin(), all.end(), before);
  for (std::size_t k = 0; k < mine.size(); ++k)
    particles.id[n_before + k] =
        first_id + (std::lower_bound(all.begin(), all.end(), mine[k], before) - all.begin());
  particles.next_id = first_id + static_cast<std::int64_t>(all.size());
  for (const Birth& birth : all) {
    injected_ += mass_of(due[birth.due]);
    ++counts_.injected_through[face_of<D>(elements_[due[birth.due]])];
  }
  counts_.injected += static_cast<std::int64_t>(all.size());
  return !all.empty();
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
  if (others_ != nullptr && others_->rank() != 0) {
    ledger.defect = ledger.mass_inside;
    return ledger;
  }
  ledger.mass_on_faces = elements_.total_mass();
  ledger.mass_injected = injected_.value();
  ledger.mass_removed = removed_.value();
  ledger.mass_flux = elements_.flux();
  ledger.n_injected = static_cast<double>(counts_.injected);
  ledger.n_removed = static_cast<double>(counts_.removed_crossing + counts_.removed_nearest);
  Compensated defect = inside;
  defect += ledger.mass_on_faces;
  defect -= start_mass_.value();
  defect -= ledger.mass_flux;
  ledger.defect = defect.value();
  return ledger;
}

template <int D>
std::vector<double> ParticleExchange<D>::pack() const {
  std::vector<double> packed = elements_.pack();
  for (const Compensated* sum : {&start_mass_, &injected_, &removed_}) {
    packed.push_back(sum->sum());
    packed.push_back(sum->carry());
  }
  return packed;
}

template <int D>
std::vector<std::int64_t> ParticleExchange<D>::pack_counts() const {
  std::vector<std::int64_t> packed = {counts_.injected, counts_.removed_crossing, counts_.removed_nearest};
  for (const auto* by_face : {&counts_.injected_through, &counts_.removed_through})
    packed.insert(packed.end(), by_face->begin(), by_face->end());
  return packed;
}

template <int D>
void ParticleExchange<D>::unpack(const std::vector<double>& packed, const std::vector<std::int64_t>& counts) {
  constexpr std::size_t tail = 6;
  if (packed.size() < tail || counts.size() != pack_counts().size())
    throw IoError("particle exchange: the record is too short.");
  const std::size_t first = packed.size() - tail;
  elements_.unpack(std::vector<double>(packed.begin(), packed.begin() + static_cast<std::ptrdiff_t>(first)));
  std::size_t k = first;
  for (Compensated* sum : {&start_mass_, &injected_, &removed_}) {
    *sum = Compensated(packed[k], packed[k + 1]);
    k += 2;
  }
  counts_.injected = counts[0];
  counts_.removed_crossing = counts[1];
  counts_.removed_nearest = counts[2];
  auto next = counts.begin() + 3;
  for (auto* by_face : {&counts_.injected_through, &counts_.removed_through})
    for (auto& count : *by_face) count = *next++;
}

template class ParticleExchange<2>;
template class ParticleExchange<3>;

}  // namespace littoral::sph
