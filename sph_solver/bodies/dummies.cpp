#include "bodies/dummies.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "bodies/nearest_image.hpp"

namespace littoral::sph {

template <int D>
Dummies<D>::Dummies(const std::vector<Body>& bodies, const DomainBox<D>& box, const Lattice<D>& lattice,
                    double depth)
    : box_(box), tolerance_(k_on_body * lattice.spacing), volume_(std::pow(lattice.spacing, D)) {
  for (std::size_t b = 0; b < bodies.size(); ++b) fill(bodies, static_cast<std::int32_t>(b), lattice, depth);
}

template <int D>
void Dummies<D>::fill(const std::vector<Body>& bodies, std::int32_t b, const Lattice<D>& lattice,
                      double depth) {
  const Body& own = bodies[static_cast<std::size_t>(b)];
  const auto [lower, upper] = own.bounds();
  std::array<long, D> first{}, n{};
  long total = 1;
  for (std::size_t d = 0; d < D; ++d) {
    double low = lower[scene_axis<D>(d)] - depth, high = upper[scene_axis<D>(d)] + depth;
    // Only what the water can see; a moving body may come from outside. A periodic length repeats itself.
    const bool endless = box_.is_periodic(d) && high - low > box_.length(d);
    if (!own.moves() || endless) {
      low = std::max(low, box_.lower[d] - (closed(d, 0) ? 0.0 : depth));
      high = std::min(high, box_.upper[d] + (closed(d, 1) ? 0.0 : depth));
    }
    first[d] = std::lround(std::floor((low - lattice.origin[d]) / lattice.spacing));
    n[d] = std::max(0L, std::lround(std::ceil((high - lattice.origin[d]) / lattice.spacing)) - first[d]);
    total *= n[d];
  }
  for (long place = 0; place < total; ++place) {
    std::array<double, D> node{};
    long rest = place;
    for (std::size_t d = D; d-- > 0; rest /= n[d])
      node[d] = lattice.origin[d] + (static_cast<double>(first[d] + rest % n[d]) + 0.5) * lattice.spacing;
    make(own, b, in_scene<D>(node), depth);
  }
}

template <int D>
void Dummies<D>::make(const Body& own, std::int32_t b, const Vector3& place, double depth) {
  const SurfacePoint closest = own.closest_wall(place);
  const Vector3 local = own.to_local(place);
  if (!own.is_sheet()) {
    if (closest.distance > tolerance_ || closest.distance < -depth) return;
    const Rotation back = own.state().rotation.inverse();
    made_.push_back({b, local, own.to_local(closest.point), back(closest.normal), closest.patch});
    return;
  }
  if (closest.distance > depth) return;
  // a place on the sheet itself stands behind it for both sides
  for (const double front : {1.0, -1.0})
    if (Body::side(local) != front || std::fabs(local[2]) < tolerance_)
      made_.push_back({b, local, {local[0], local[1], 0.0}, {0.0, 0.0, -front}, -1});
}

template <int D>
bool Dummies<D>::counts(const std::vector<Body>& bodies, const Made& dummy, const Vector3& place) const {
  const auto own = static_cast<std::size_t>(dummy.body);
  const double depth = norm(dummy.place - dummy.wall);
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    if (b == own || bodies[b].is_sheet()) continue;
    const double other = -bodies[b].closest_wall(nearest_image<D>(box_, bodies[b], place)).distance;
    if (other < -tolerance_) continue;
    if (bodies[own].is_sheet() || other > depth + tolerance_ || (other >= depth - tolerance_ && b < own))
      return false;
  }
  return true;
}

template <int D>
void Dummies<D>::add(std::int32_t source, const std::array<double, D>& sign,
                     const std::array<double, D>& offset) {
  source_.push_back(source);
  sign_.push_back(sign);
  offset_.push_back(offset);
}

template <int D>
void Dummies<D>::place(const std::vector<Body>& bodies, double reach) {
  source_.clear();
  sign_.clear();
  offset_.clear();
  std::vector<std::array<double, D>> where;
  for (std::size_t k = 0; k < made_.size(); ++k) {
    const Vector3 at = bodies[static_cast<std::size_t>(made_[k].body)].to_world(made_[k].place);
    auto to = in_plane<D>(at);
    std::array<double, D> sign, offset{};
    sign.fill(1.0);
    bool beyond = false;
    for (std::size_t d = 0; d < D; ++d) {
      if (box_.is_periodic(d)) {
        offset[d] = -box_.length(d) * std::floor((to[d] - box_.lower[d]) / box_.length(d));
        to[d] += offset[d];
        continue;
      }
      beyond = beyond || (closed(d, 0) && to[d] < box_.lower[d]) || (closed(d, 1) && to[d] > box_.upper[d]);
    }
    if (beyond || !counts(bodies, made_[k], at)) continue;
    add(static_cast<std::int32_t>(k), sign, offset);
    where.push_back(to);
  }
  // direction after direction, each copying the copies made before it: that fills edges and corners
  for (std::size_t d = 0; d < D; ++d) {
    const std::size_t n = source_.size();
    for (std::size_t k = 0; k < n; ++k) {
      const double from = where[k][d];
      const auto copy = [&](double s, double shift) {
        auto sign = sign_[k], offset = offset_[k];
        auto to = where[k];
        sign[d] *= s;
        offset[d] = s * offset[d] + shift;
        to[d] = s * from + shift;
        add(source_[k], sign, offset);
        where.push_back(to);
      };
      if (box_.is_periodic(d)) {
        if (from < box_.lower[d] + reach) copy(1.0, box_.length(d));
        if (from > box_.upper[d] - reach) copy(1.0, -box_.length(d));
        continue;
      }
      if (closed(d, 0) && from < box_.lower[d] + reach) copy(-1.0, 2.0 * box_.lower[d]);
      if (closed(d, 1) && from > box_.upper[d] - reach) copy(-1.0, 2.0 * box_.upper[d]);
    }
  }
  dummies_.resize(size());
  for (auto& column : x_) column.resize(size());
  refresh(bodies);
}

template <int D>
std::array<double, D> Dummies<D>::closest_on_sheet(std::size_t k, const std::array<double, D>& from) const {
  const SheetPlace& sheet = sheets_[static_cast<std::size_t>(dummies_[k].body)];
  const Vector3 local = in_scene<D>(in_source(k, from)) - sheet.centre;
  Vector3 point = sheet.centre;
  for (std::size_t q = 0; q < 2; ++q)
    point = point + std::clamp(dot(local, sheet.axis[q]), -sheet.half[q], sheet.half[q]) * sheet.axis[q];
  auto on = in_plane<D>(point);
  for (std::size_t d = 0; d < D; ++d) on[d] = sign_[k][d] * on[d] + offset_[k][d];
  return on;
}

template <int D>
void Dummies<D>::refresh(const std::vector<Body>& bodies) {
  const bool any = std::any_of(bodies.begin(), bodies.end(), [](const Body& b) { return b.is_sheet(); });
  sheets_.assign(any ? bodies.size() : 0, {});
  for (std::size_t b = 0; b < sheets_.size(); ++b) {
    if (!bodies[b].is_sheet()) continue;
    const BodyState& state = bodies[b].state();
    sheets_[b] = {
        true, state.position, {state.rotation({1, 0, 0}), state.rotation({0, 1, 0})}, bodies[b].sheet()};
  }
  for (std::size_t k = 0; k < size(); ++k) {
    const Made& made = made_[static_cast<std::size_t>(source_[k])];
    const Body& own = bodies[static_cast<std::size_t>(made.body)];
    const Vector3 surface = own.to_world(made.wall);
    const auto at = in_plane<D>(own.to_world(made.place)), on = in_plane<D>(surface);
    const auto n = in_plane<D>(own.state().rotation(made.normal));
    const auto velocity = in_plane<D>(own.state().velocity_at(surface));
    const auto acceleration = in_plane<D>(own.state().acceleration_at(surface));
    Dummy& dummy = dummies_[k];
    for (std::size_t d = 0; d < D; ++d) {
      const double s = sign_[k][d], o = offset_[k][d];
      x_[d][k] = dummy.x[d] = s * at[d] + o;
      dummy.wall[d] = s * on[d] + o;
      dummy.normal[d] = s * n[d];
      dummy.u[d] = s * velocity[d];
      dummy.a[d] = s * acceleration[d];
    }
    dummy.body = made.body;
    dummy.patch = made.patch;
  }
}

template class Dummies<2>;
template class Dummies<3>;

}  // namespace littoral::sph
