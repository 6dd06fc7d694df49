#include "bodies/sheets.hpp"

#include "bodies/nearest_image.hpp"
#include "bodies/wall_view.hpp"

namespace littoral::sph {
namespace {

bool divides(const Body& sheet, const Vector3& from, const Vector3& to) {
  return Body::side(from) != Body::side(to) && sheet.passage(from, to).has_value();
}

}  // namespace

template <int D>
Sheets<D>::Sheets(const std::vector<Body>& bodies) {
  for (std::size_t b = 0; b < bodies.size(); ++b)
    if (bodies[b].is_sheet()) sheets_.push_back(b);
}

template <int D>
bool Sheets<D>::between(const std::vector<Body>& bodies, const DomainBox<D>& box,
                        const std::array<double, D>& x, const std::array<double, D>& y) const {
  for (const std::size_t b : sheets_)
    if (divides(bodies[b], bodies[b].to_local(nearest_image<D>(box, bodies[b], in_scene<D>(x))),
                bodies[b].to_local(nearest_image<D>(box, bodies[b], in_scene<D>(y)))))
      return true;
  return false;
}

template <int D>
bool Sheets<D>::shows(const std::vector<Body>& bodies, const Dummies<D>& dummies, std::size_t e,
                      const std::array<double, D>& x) const {
  const auto own = static_cast<std::size_t>(dummies[e].body);
  if (!bodies[own].is_sheet()) return true;
  const Vector3 eye = in_scene<D>(dummies.in_source(e, x)),
                place = in_scene<D>(dummies.in_source(e, dummies[e].x));
  const Vector3 from = bodies[own].to_local(eye), to = bodies[own].to_local(place);
  if (Body::side(from) != dummies.front(e)) return false;
  const auto way = bodies[own].passage(from, to);
  if (!way) return false;
  for (const std::size_t b : sheets_) {
    if (b == own) continue;
    const Vector3 here = bodies[b].to_local(eye), there = bodies[b].to_local(place);
    if (Body::side(here) == Body::side(there)) continue;
    const auto other = bodies[b].passage(here, there);
    if (other && (*other < *way || (*other == *way && b < own))) return false;
  }
  return true;
}

template <int D>
void Sheets<D>::part(const std::vector<Body>& bodies, const DomainBox<D>& box, const Particles<D>& particles,
                     NeighborList<D>& neighbors) const {
  std::vector<Vector3> local(particles.size());
  for (const std::size_t b : sheets_) {
    const Body& sheet = bodies[b];
    const auto n = static_cast<std::ptrdiff_t>(particles.size());
#pragma omp parallel for schedule(static)
    for (std::ptrdiff_t k = 0; k < n; ++k) {
      const auto i = static_cast<std::size_t>(k);
      local[i] = sheet.to_local(nearest_image<D>(box, sheet, in_scene<D>(at<D>(particles.x, i))));
    }
    neighbors.mark_pairs([&](std::size_t i) { return std::fabs(local[i][2]) < neighbors.reach(); },
                         [&](std::size_t i, std::size_t j) { return divides(sheet, local[i], local[j]); });
  }
  neighbors.drop_marked();
}

template class Sheets<2>;
template class Sheets<3>;

}  // namespace littoral::sph
