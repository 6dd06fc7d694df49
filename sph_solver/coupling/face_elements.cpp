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

/// Faces nearer than this coincide [spacing]: room for the round-off of a scene's formulas.
constexpr double k_same_place = 1e-6;

/// Calls f(k) for k in [0, n) in a team of threads; what one of them throws is thrown when all are done.
template <class F>
void in_team(std::size_t n, const F& f) {
  std::exception_ptr failure;
  const auto count = static_cast<std::ptrdiff_t>(n);
#pragma omp parallel for schedule(static) if (count > k_worth_a_team)
  for (std::ptrdiff_t k = 0; k < count; ++k) {
    try {
      f(static_cast<std::size_t>(k));
    } catch (...) {
#pragma omp critical(littoral_face_elements)
      failure = std::current_exception();
    }
  }
  if (failure) std::rethrow_exception(failure);
}

/// Ends of the tiles of about `spacing` that fill [lower, upper], with an end at each of the cuts inside.
std::vector<double> tile_edges(double lower, double upper, std::vector<double> cuts, double spacing) {
  cuts.push_back(upper);
  std::sort(cuts.begin(), cuts.end());
  std::vector<double> edges = {lower};
  for (const double cut : cuts) {
    const double from = edges.back(), length = cut - from;
    if (length < k_same_place * spacing || cut > upper) continue;
    if (cut < upper && upper - cut < k_same_place * spacing) continue;
    const double n = std::max(1.0, std::round(length / spacing));
    for (double i = 1.0; i <= n; ++i) edges.push_back(i < n ? from + i * length / n : cut);
  }
  return edges;
}

/// Whether the outer face `axis`, `side` of box b at x lies within another box of the list. Of two boxes that
/// share a piece of their outer faces the earlier one has it.
template <int D>
bool covered(const std::vector<RegionBox<D>>& boxes, std::size_t b, std::size_t axis, std::size_t side,
             const Point<D>& x, double tolerance) {
  for (std::size_t q = 0; q < boxes.size(); ++q) {
    if (q == b) continue;
    const auto& other = boxes[q];
    bool within = true;
    for (std::size_t d = 0; d < D && within; ++d)
      if (d != axis) within = x[d] > other.outer_lower[d] && x[d] < other.outer_upper[d];
    if (!within) continue;
    const double below = x[axis] - other.outer_lower[axis], above = other.outer_upper[axis] - x[axis];
    if (below > tolerance && above > tolerance) return true;
    const bool same_face = other.open[axis][side] && std::fabs(side == 0 ? below : above) <= tolerance;
    const bool back_to_back = std::fabs(side == 0 ? above : below) <= tolerance;
    if ((same_face && q < b) || back_to_back) return true;
  }
  return false;
}

}  // namespace

template <int D>
FaceElements<D>::FaceElements(const Layers<D>& layers, double spacing, FaceRows rows)
    : boxes_(layers.boxes()), spacing_(spacing) {
  for (std::size_t b = 0; b < boxes_.size(); ++b)
    for (std::size_t axis = 0; axis < D; ++axis)
      for (std::size_t side = 0; side < 2; ++side) {
        if (!boxes_[b].open[axis][side]) continue;
        Face face{b, axis, side, elements_.size(), 0, {}, {}};
        tile(face, spacing);
        if (rows == FaceRows::level && axis != D - 1) make_columns(face);
        faces_.push_back(face);
      }
  columns_.set_probes(elements_);
  mass_.assign(size(), Compensated());
  speed_.assign(size(), 0.0);
  forget_hints();
}

template <int D>
void FaceElements<D>::tile(Face& face, double spacing) {
  const auto& box = boxes_[face.box];
  std::size_t tiles = 1;
  for (std::size_t d = 0; d < D; ++d) {
    face.edges[d] = {box.outer_lower[d], box.outer_upper[d]};
    if (d == face.axis) continue;
    std::vector<double> cuts;
    for (std::size_t q = 0; q < boxes_.size(); ++q)
      if (q != face.box) {
        cuts.push_back(boxes_[q].outer_lower[d]);
        cuts.push_back(boxes_[q].outer_upper[d]);
      }
    face.edges[d] = tile_edges(box.outer_lower[d], box.outer_upper[d], cuts, spacing);
    tiles *= face.edges[d].size() - 1;
  }
  for (std::size_t k = 0; k < tiles; ++k) {
    FaceElement<D> element;
    element.axis = face.axis;
    element.side = face.side;
    element.inward = face.side == 0 ? 1.0 : -1.0;
    element.area = 1.0;
    element.box = face.box;
    std::size_t rest = k;
    for (std::size_t d = 0; d < D; ++d) {
      if (d == face.axis) continue;
      const auto& edges = face.edges[d];
      const std::size_t i = rest % (edges.size() - 1);
      rest /= edges.size() - 1;
      element.centre[d] = 0.5 * (edges[i] + edges[i + 1]);
      element.half[d] = 0.5 * (edges[i + 1] - edges[i]);
      element.area *= edges[i + 1] - edges[i];
    }
    element.centre[face.axis] = face.side == 0 ? box.outer_lower[face.axis] : box.outer_upper[face.axis];
    const bool inner =
        covered<D>(boxes_, face.box, face.axis, face.side, element.centre, k_same_place * spacing);
    face.element.push_back(inner ? k_covered : elements_.size());
    if (!inner) elements_.push_back(element);
  }
  face.count = elements_.size() - face.first;
}

template <int D>
void FaceElements<D>::make_columns(const Face& face) {
  const auto& edges = face.edges[D - 1];
  const std::size_t height = edges.size() - 1, n = face.element.size() / height;
  for (std::size_t c = 0; c < n; ++c) {  // the last direction, up, is the slowest
    std::vector<std::size_t> column;
    for (std::size_t k = 0; k < height; ++k) column.push_back(face.element[c + k * n]);
    if (std::count(column.begin(), column.end(), k_covered) == 0) columns_.add(std::move(column), edges);
  }
}

template <int D>
void FaceElements<D>::follow_level(const Exterior& fv, double time) {
  const auto& probes = columns_.probes();
  std::vector<double> phi(probes.size(), 0.0), known(probes.size(), 0.0);
  in_team(probes.size(), [&](std::size_t k) {
    if (!probe_owner_.empty() && probe_owner_[k] != rank_) return;
    const auto state = fv.at(to_vec3<D>(probes[k]), time, probe_hint_[k]);
    if (!state) return;
    phi[k] = state->phi;
    known[k] = 1.0;
  });
  if (others_ != nullptr) {
    others_->merge(phi);
    others_->merge(known);
  }
  columns_.follow(phi, known, spacing_, elements_, mass_);
  if (others_ == nullptr) return;
  for (std::size_t e = 0; e < owner_.size(); ++e)
    if (columns_.moves(e)) owner_[e] = others_->regions().owner(elements_[e].centre, 0);
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
  // a rank without a donor cell has no phi of its own, and must take part in what follows all the same
  const bool with_phi = others_ != nullptr ? others_->any(fv.with_phi()) : fv.with_phi();
  if (with_phi && !columns_.empty()) follow_level(fv, half_time);
  std::vector<double> gain(size(), 0.0);
  std::vector<char> missing(size(), 0);
  in_team(size(), [&](std::size_t e) {
    const auto& element = elements_[e];
    speed_[e] = 0.0;
    if (!is_mine(e) || element.area == 0.0) return;
    const auto state = fv.at(to_vec3<D>(element.centre), half_time, hint_[e]);
    if (!state) {  // no FV water here
      missing[e] = 1;
      return;
    }
    const double wet = with_phi && !element.stretched ? wet_part(fv, e, state->phi, half_time) : 1.0;
    speed_[e] = element.inward * state->u[space_axis<D>(element.axis)];
    gain[e] = eos.density(state->p) * wet * speed_[e] * element.area * dt;  // (18), (19), with rho(p)
  });
  const auto first_missing =
      static_cast<std::size_t>(std::find(missing.begin(), missing.end(), 1) - missing.begin());
  if (first_missing < size() && !with_phi) {
    const auto x = to_vec3<D>(elements_[first_missing].centre);
    std::ostringstream text;
    text << "t = " << time << " s: no donor cells at the SPH region's outer face, point (" << x[0] << ", "
         << x[1] << ", " << x[2] << "). The partner's grid must reach half a cell beyond it.";
    throw CouplingError(text.str());
  }
  if (others_ != nullptr) {
    others_->merge(gain);
    others_->merge(speed_);
  }
  for (std::size_t e = 0; e < size(); ++e) {  // in order: the same sums on any number of threads
    mass_[e] += gain[e];
    flux_ += gain[e];
  }
}

template <int D>
double FaceElements<D>::mean_pressure(const Exterior& fv, double time, double otherwise,
                                      const Walls<D>* walls) const {
  std::vector<double> forces(size(), 0.0), areas(size(), 0.0);
  for (std::size_t e = 0; e < size(); ++e) {
    if (!is_mine(e) || (walls != nullptr && walls->inside(elements_[e].centre))) continue;
    const auto state = fv.at(to_vec3<D>(elements_[e].centre), time, hint_[e]);
    if (!state) continue;
    forces[e] = state->p * elements_[e].area;
    areas[e] = elements_[e].area;
  }
  if (others_ != nullptr) {
    others_->merge(forces);
    others_->merge(areas);
  }
  double force = 0.0, area = 0.0;
  for (std::size_t e = 0; e < size(); ++e) {
    force += forces[e];
    area += areas[e];
  }
  return area > 0.0 ? force / area : otherwise;
}

template <int D>
void FaceElements<D>::divide_among(OtherRanks<D>* others) {
  others_ = others;
  owner_.clear();
  probe_owner_.clear();
  if (others_ == nullptr) return;
  rank_ = static_cast<std::size_t>(others_->rank());
  for (const auto& element : elements_) owner_.push_back(others_->regions().owner(element.centre, 0));
  for (const auto& probe : columns_.probes()) probe_owner_.push_back(others_->regions().owner(probe, 0));
}

template <int D>
double FaceElements<D>::distance_to(std::size_t e, const Point<D>& x) const {
  const auto& box = boxes_[elements_[e].box];
  double r2 = 0.0;
  for (std::size_t d = 0; d < D; ++d) {
    double r = std::fabs(elements_[e].centre[d] - x[d]);
    if (box.periodic[d]) r = std::min(r, std::fabs(box.upper[d] - box.lower[d] - r));
    r2 += r * r;
  }
  return std::sqrt(r2);
}

template <int D>
void FaceElements<D>::level_outflow(double particle_mass) {
  for (const Face& face : faces_) {
    for (std::size_t e = face.first; e < face.first + face.count; ++e) {
      while (speed_[e] <= 0.0 && mass(e) >= 0.5 * particle_mass) {
        std::size_t nearest = size();
        double s_min = std::numeric_limits<double>::infinity();
        for (std::size_t f = face.first; f < face.first + face.count; ++f) {
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
  const Face* through = nullptr;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t b = 0; b < boxes_.size(); ++b) {  // out of the box it is least far from
    double furthest = 0.0;
    const Face* of_box = nullptr;
    for (const auto& face : faces_) {
      if (face.box != b) continue;
      const double beyond = face.side == 0 ? boxes_[b].outer_lower[face.axis] - x[face.axis]
                                           : x[face.axis] - boxes_[b].outer_upper[face.axis];
      if (beyond > furthest) {
        furthest = beyond;
        of_box = &face;
      }
    }
    if (of_box == nullptr) return size();  // inside this box
    if (furthest < least) {
      least = furthest;
      through = of_box;
    }
  }
  if (through == nullptr) return size();
  std::size_t tile = 0, stride = 1;
  for (std::size_t d = 0; d < D; ++d) {
    if (d == through->axis) continue;
    const auto& edges = through->edges[d];
    const auto above = std::upper_bound(edges.begin() + 1, edges.end() - 1, x[d]);
    tile += stride * static_cast<std::size_t>(above - edges.begin() - 1);
    stride *= edges.size() - 1;
  }
  const std::size_t element = through->element[tile];
  if (element != k_covered) return columns_.at_height(element, x[D - 1], elements_);
  return nearest(x);  // past an edge where two boxes meet
}

template <int D>
std::size_t FaceElements<D>::nearest(const Point<D>& x) const {
  std::size_t nearest = size();
  double s_min = std::numeric_limits<double>::infinity();
  for (std::size_t e = 0; e < size(); ++e) {
    double s = 0.0;
    for (std::size_t d = 0; d < D; ++d)
      s += (elements_[e].centre[d] - x[d]) * (elements_[e].centre[d] - x[d]);
    if (s < s_min) {
      s_min = s;
      nearest = e;
    }
  }
  return nearest;
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
  for (std::size_t c = 0; c < columns_.size(); ++c) packed.push_back(columns_.rows(c));
  return packed;
}

template <int D>
void FaceElements<D>::unpack(const std::vector<double>& packed) {
  const std::size_t expected = 2 * size() + 2 + columns_.size();
  if (packed.size() != expected)
    throw IoError("face elements: the record holds " + std::to_string(packed.size()) +
                  " numbers, this scene's faces have " + std::to_string(expected) + ".");
  for (std::size_t e = 0; e < size(); ++e) mass_[e] = Compensated(packed[2 * e], packed[2 * e + 1]);
  flux_ = Compensated(packed[2 * size()], packed[2 * size() + 1]);
  for (std::size_t c = 0; c < columns_.size(); ++c) columns_.set_rows(c, packed[2 * size() + 2 + c]);
}

template class FaceElements<2>;
template class FaceElements<3>;

}  // namespace littoral::sph
