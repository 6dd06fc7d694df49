#include "coupling/face_elements.hpp"

#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>
#include <sstream>

#include "littoral/error.hpp"

namespace littoral::sph {

namespace {

/// Fewer searches than this cost less than waking a second thread.
constexpr std::ptrdiff_t k_worth_a_team = 256;

}  // namespace

template <int D>
FaceElements<D>::FaceElements(const Layers<D>& layers, double spacing) : boxes_(layers.boxes()) {
  for (std::size_t b = 0; b < boxes_.size(); ++b) {
    const auto& box = boxes_[b];
    for (std::size_t axis = 0; axis < D; ++axis)
      for (std::size_t side = 0; side < 2; ++side) {
        if (!box.open[axis][side]) continue;
        Face face{b, axis, side, elements_.size(), {}};
        Point<D> size{};
        FaceElement<D> element;
        element.axis = axis;
        element.inward = side == 0 ? 1.0 : -1.0;
        element.area = 1.0;
        element.box = b;
        std::size_t count = 1;
        for (std::size_t d = 0; d < D; ++d) {
          face.n[d] = 1;
          if (d == axis) continue;
          const double length = box.outer_upper[d] - box.outer_lower[d];
          face.n[d] = static_cast<std::size_t>(std::max(1.0, std::round(length / spacing)));
          size[d] = length / static_cast<double>(face.n[d]);
          element.area *= size[d];
          element.half[d] = 0.5 * size[d];
          count *= face.n[d];
        }
        for (std::size_t k = 0; k < count; ++k) {
          std::size_t rest = k;
          for (std::size_t d = 0; d < D; ++d) {
            const auto i = static_cast<double>(rest % face.n[d]);
            rest /= face.n[d];
            element.centre[d] = box.outer_lower[d] + (i + 0.5) * size[d];
          }
          element.centre[axis] = side == 0 ? box.outer_lower[axis] : box.outer_upper[axis];
          elements_.push_back(element);
        }
        faces_.push_back(face);
      }
  }
  mass_.assign(size(), Compensated());
  speed_.assign(size(), 0.0);
  forget_hints();
}

template <int D>
double FaceElements<D>::wet_part(const Exterior& fv, std::size_t e, double phi_centre, double time) const {
  const auto& element = elements_[e];
  double reach = 0.0;
  for (double h : element.half) reach += h * h;
  if (std::fabs(phi_centre) >= std::sqrt(reach)) return phi_centre < 0.0 ? 1.0 : 0.0;
  // phi is linear over so small an element: what it changes by from the centre to each end
  Point<D> change{};
  for (std::size_t d = 0; d < D; ++d)
    if (element.half[d] > 0.0)
      change[d] = element.half[d] * phi_slope(fv, to_vec3<D>(element.centre), phi_centre, space_axis<D>(d),
                                              element.half[d], time, hint_[e]);
  if constexpr (D == 2) {
    const double total = std::fabs(change[1 - element.axis]);
    if (total == 0.0) return phi_centre < 0.0 ? 1.0 : 0.0;
    return std::clamp(0.5 - 0.5 * phi_centre / total, 0.0, 1.0);
  } else {
    constexpr int n = 16;  // sub-points a direction: the share is known to 1/32
    const std::size_t a = (element.axis + 1) % 3, b = (element.axis + 2) % 3;
    int wet = 0;
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j) {
        const double s = (2 * i + 1 - n) / static_cast<double>(n),
                     t = (2 * j + 1 - n) / static_cast<double>(n);
        if (phi_centre + s * change[a] + t * change[b] < 0.0) ++wet;
      }
    return wet / static_cast<double>(n * n);
  }
}

template <int D>
void FaceElements<D>::integrate(const Exterior& fv, const LinearEos& eos, double time, double dt) {
  const double half_time = time + 0.5 * dt;
  const auto n = static_cast<std::ptrdiff_t>(size());
  std::vector<double> gain(size(), 0.0);
  std::ptrdiff_t first_missing = n;
  std::exception_ptr failure;
#pragma omp parallel for schedule(static) reduction(min : first_missing) if (n > k_worth_a_team)
  for (std::ptrdiff_t k = 0; k < n; ++k) {
    const auto e = static_cast<std::size_t>(k);
    const auto& element = elements_[e];
    try {
      const auto state = fv.at(to_vec3<D>(element.centre), half_time, hint_[e]);
      speed_[e] = 0.0;
      if (!state) {  // no FV water here
        first_missing = k < first_missing ? k : first_missing;
        continue;
      }
      const double wet = fv.with_phi() ? wet_part(fv, e, state->phi, half_time) : 1.0;
      speed_[e] = element.inward * state->u[space_axis<D>(element.axis)];
      gain[e] = eos.density(state->p) * wet * speed_[e] * element.area * dt;  // (18), (19), with rho(p)
    } catch (...) {
#pragma omp critical(littoral_face_elements)
      failure = std::current_exception();
    }
  }
  if (failure) std::rethrow_exception(failure);
  if (first_missing < n && !fv.with_phi()) {
    const auto x = to_vec3<D>(elements_[static_cast<std::size_t>(first_missing)].centre);
    std::ostringstream text;
    text << "t = " << time << " s: no donor cells at the SPH region's outer face, point (" << x[0] << ", "
         << x[1] << ", " << x[2] << "). The partner's grid must reach half a cell beyond it.";
    throw CouplingError(text.str());
  }
  for (std::size_t e = 0; e < size(); ++e) {  // in order: the same sums on any number of threads
    mass_[e] += gain[e];
    flux_ += gain[e];
  }
}

template <int D>
void FaceElements<D>::level_outflow(double particle_mass) {
  for (const Face& face : faces_) {
    std::size_t count = 1;
    for (std::size_t n : face.n) count *= n;
    for (std::size_t e = face.first; e < face.first + count; ++e) {
      while (speed_[e] <= 0.0 && mass(e) >= 0.5 * particle_mass) {
        std::size_t nearest = size();
        double s_min = std::numeric_limits<double>::infinity();
        for (std::size_t f = face.first; f < face.first + count; ++f) {
          if (mass(f) > -0.5 * particle_mass || mass(e) - mass(f) < 1.5 * particle_mass) continue;
          double s = 0.0;
          for (std::size_t d = 0; d < D; ++d)
            s += (elements_[f].centre[d] - elements_[e].centre[d]) *
                 (elements_[f].centre[d] - elements_[e].centre[d]);
          if (s < s_min) {
            s_min = s;
            nearest = f;
          }
        }
        if (nearest == size()) break;
        credit(e, -particle_mass);
        credit(nearest, particle_mass);
      }
    }
  }
}

template <int D>
double FaceElements<D>::total_mass() const {
  Compensated sum;
  for (const auto& m : mass_) sum += m;
  return sum.value();
}

template <int D>
std::size_t FaceElements<D>::crossed(const Point<D>& x) const {
  double furthest = 0.0;
  const Face* through = nullptr;
  for (const auto& face : faces_) {
    const auto& box = boxes_[face.box];
    const double beyond = face.side == 0 ? box.outer_lower[face.axis] - x[face.axis]
                                         : x[face.axis] - box.outer_upper[face.axis];
    if (beyond > furthest) {
      furthest = beyond;
      through = &face;
    }
  }
  if (through == nullptr) return size();
  const auto& box = boxes_[through->box];
  std::size_t index = 0, stride = 1;
  for (std::size_t d = 0; d < D; ++d) {
    if (d != through->axis) {
      const double s = (x[d] - box.outer_lower[d]) / (box.outer_upper[d] - box.outer_lower[d]);
      const double i = std::clamp(std::floor(s * static_cast<double>(through->n[d])), 0.0,
                                  static_cast<double>(through->n[d] - 1));
      index += stride * static_cast<std::size_t>(i);
    }
    stride *= through->n[d];
  }
  return through->first + index;
}

template <int D>
std::vector<double> FaceElements<D>::pack() const {
  std::vector<double> packed;
  for (const auto& m : mass_) {
    packed.push_back(m.sum());
    packed.push_back(m.carry());
  }
  packed.push_back(flux_.sum());
  packed.push_back(flux_.carry());
  return packed;
}

template <int D>
void FaceElements<D>::unpack(const std::vector<double>& packed) {
  if (packed.size() != 2 * size() + 2)
    throw IoError("face elements: the record holds " + std::to_string(packed.size() / 2 - 1) +
                  " elements, this scene has " + std::to_string(size()) + ".");
  for (std::size_t e = 0; e < size(); ++e) mass_[e] = Compensated(packed[2 * e], packed[2 * e + 1]);
  flux_ = Compensated(packed[2 * size()], packed[2 * size() + 1]);
}

template class FaceElements<2>;
template class FaceElements<3>;

}  // namespace littoral::sph
