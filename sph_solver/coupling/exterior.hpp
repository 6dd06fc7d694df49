#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "littoral/coupler/donor_search.hpp"
#include "littoral/coupler/fields.hpp"
#include "littoral/support/scene.hpp"

namespace littoral::sph {

/// FV's solution around the SPH region, as the layers and the face elements use it: a state at a point and a
/// time. Absent where FV has no cell with a state near (in the air).
class Exterior {
 public:
  virtual ~Exterior() = default;
  /// hint: memory of an earlier search near x, -1 at first; updated. thread-safe
  /// throws CouplingError if the time lies outside the horizon of the values
  virtual std::optional<coupler::DonorState> at(const coupler::Vec3& x, double time,
                                                std::int64_t& hint) const = 0;
  virtual bool with_phi() const = 0;
};

/// Change of phi per length along direction `axis` (of space) at x, from the values `half` to either side;
/// where FV has no state on one side, from x and the other. 0 where it has none on both. hint: a copy of the
/// one at x.
double phi_slope(const Exterior& fv, const coupler::Vec3& x, double phi_here, std::size_t axis, double half,
                 double time, std::int64_t hint);

/// The exterior out of donor cells: trilinear in space, linear in time (24).
class DonorField final : public Exterior {
 public:
  explicit DonorField(const support::Scene& scene);
  /// A new geometry (epoch): the search is set up anew and every hint is void.
  void set_geometry(const coupler::DonorGeometry& geometry);
  coupler::DonorValues& values() { return values_; }
  const coupler::DonorValues& values() const { return values_; }

  std::optional<coupler::DonorState> at(const coupler::Vec3& x, double time,
                                        std::int64_t& hint) const override;
  bool with_phi() const override { return !values_.phi.empty(); }

 private:
  /// x brought into the domain's period: particles are wrapped when their lists are built, not every stage,
  /// and a stream carries them further than the ghost cells beyond a periodic side reach.
  coupler::Vec3 wrapped(const coupler::Vec3& x) const;

  int dimension_;
  coupler::Vec3 lower_;   // [m] of the domain
  coupler::Vec3 period_;  // [m] 0 where the domain does not repeat itself
  std::unique_ptr<coupler::DonorSearch> search_;
  coupler::DonorValues values_;
};

}  // namespace littoral::sph
