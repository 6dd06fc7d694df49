#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "bodies/walls.hpp"
#include "coupling/compensated.hpp"
#include "coupling/exterior.hpp"
#include "coupling/face_columns.hpp"
#include "coupling/face_element.hpp"
#include "coupling/zones.hpp"
#include "parallel/other_ranks.hpp"
#include "physics/eos.hpp"

namespace littoral::sph {

/// The outer faces of the region, split into elements, and the mass each carries: integrated by (18), not yet
/// injected as particles. Of several boxes only what bounds their union has elements: a face is cut where
/// another box's outer faces end, and what lies within another box (or coincides with an earlier one's
/// face) is left out. On several ranks each knows all of it;
/// FV's state at an element is asked by the rank in whose part of space its centre lies.
template <int D>
class FaceElements {
 public:
  FaceElements() = default;
  FaceElements(const Layers<D>& layers, double spacing, FaceRows rows);

  std::size_t size() const { return elements_.size(); }
  const FaceElement<D>& operator[](std::size_t e) const { return elements_[e]; }

  /// Adds the mass that enters in [time, time + dt]: rho(p) u.n S dt with FV's state at the centre at half
  /// time (18), second order in time; of an element that FV's surface cuts only the wet part counts (19),
  /// after those that follow the level have been brought there. comm: collective over the other ranks. throws
  /// CouplingError: no donors at an element in a scene without free surface
  void integrate(const Exterior& fv, const LinearEos& eos, double time, double dt);

  double mass(std::size_t e) const { return mass_[e].value(); }  // [kg]
  void credit(std::size_t e, double mass) { mass_[e] += mass; }  // [kg]
  /// Mean of FV's pressure over the outer faces at `time` [Pa]; `otherwise` where FV has no water at any.
  /// walls: elements inside bodies do not count; null without
  double mean_pressure(const Exterior& fv, double time, double otherwise,
                       const Walls<D>* walls = nullptr) const;
  /// Where water flows out, a particle may leave through the element beside the one that its mass was counted
  /// on: a whole particle's surplus goes to the nearest element of the face that is owed one.
  void level_outflow(double particle_mass);
  double inflow_speed(std::size_t e) const { return speed_[e]; }  // [m/s] u.n of the last integration
  std::int64_t& hint(std::size_t e) const { return hint_[e]; }
  double total_mass() const;                     // [kg] on all elements
  double flux() const { return flux_.value(); }  // [kg] through all elements since the start

  /// null: there are none. To be called anew when space was divided anew.
  void divide_among(OtherRanks<D>* others);
  std::size_t owner(std::size_t e) const { return owner_.empty() ? 0 : owner_[e]; }  ///< its rank
  bool is_mine(std::size_t e) const { return owner_.empty() || owner_[e] == rank_; }
  /// Between the centres, across a periodic side where that is shorter [m]; of elements of one box.
  double distance(std::size_t e, std::size_t f) const { return distance_to(e, elements_[f].centre); }
  double distance_to(std::size_t e, const Point<D>& x) const;  ///< likewise from the centre of e

  /// Element of the outer face through which a point outside has left; size() if it is not outside.
  std::size_t crossed(const Point<D>& x) const;

  void forget_hints() {
    hint_.assign(size(), -1);
    probe_hint_.assign(columns_.probes().size(), -1);
  }

  /// The integrals, as they are written and restored: mass sums, their carries, the flux, rows of the
  /// columns.
  std::vector<double> pack() const;
  void unpack(const std::vector<double>& packed);  ///< throws IoError if the count is another

 private:
  struct Face {
    std::size_t box, axis, side;
    std::size_t first, count;  // its elements
    std::array<std::vector<double>, D>
        edges;                         // [m] of the tiles, by direction; the normal one: a single tile
    std::vector<std::size_t> element;  // of the tile, first direction fastest; k_covered: none
  };
  static constexpr std::size_t k_covered = static_cast<std::size_t>(-1);
  void tile(Face& face, double spacing);
  void make_columns(const Face& face);
  void follow_level(const Exterior& fv, double time);
  std::size_t nearest(const Point<D>& x) const;
  double wet_part(const Exterior& fv, std::size_t e, double phi_centre, double time) const;

  std::vector<RegionBox<D>> boxes_;
  std::vector<Face> faces_;
  double spacing_ = 0.0;  // [m]
  std::vector<FaceElement<D>> elements_;
  FaceColumns<D> columns_;
  std::vector<Compensated> mass_;
  std::vector<double> speed_;
  OtherRanks<D>* others_ = nullptr;
  std::size_t rank_ = 0;
  std::vector<std::size_t> owner_;        // empty on one rank
  std::vector<std::size_t> probe_owner_;  // likewise
  mutable std::vector<std::int64_t> hint_;
  std::vector<std::int64_t> probe_hint_;
  Compensated flux_;
};

}  // namespace littoral::sph
