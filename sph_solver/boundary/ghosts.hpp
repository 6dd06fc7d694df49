#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "boundary/domain_box.hpp"
#include "pairs/pair_rows.hpp"
#include "parallel/other_ranks.hpp"
#include "particles/particles.hpp"

namespace littoral::sph {

/// The copies behind the owned particles, in this order: the halo, which other ranks fill (periodic images of
/// their particles included); images of owned particles beyond periodic faces; mirror images of all these
/// beyond symmetry planes; edges and corners included. A copy knows its source and the transform: per
/// component a sign and an offset. A copy of the halo is its own source.
template <int D>
class Ghosts {
 public:
  explicit Ghosts(const DomainBox<D>& box, OtherRanks<D>* others = nullptr) : box_(box), others_(others) {}

  /// Brings owned particles that left through a periodic face back on the other side, and those that crossed
  /// a symmetry plane by less than `tolerance` back to its mirror image, velocity included. Returns the
  /// number of the latter. throws StabilityError naming a particle that is further outside, or beyond an open
  /// face by more than the domain's length: it is lost
  std::size_t bring_back(Particles<D>& particles, double tolerance, double time) const;

  /// Makes all copies that lie within `reach` [m] outside the domain, and the halo within `reach` of the
  /// owned particles and of the points of interest. The domain must be as long as `reach`. comm: collective
  void create(Particles<D>& particles, double reach);
  /// A box of points besides the particles around which the halo must be complete; lower > upper: none.
  void set_interest(const std::array<double, D>& lower, const std::array<double, D>& upper) {
    interest_lower_ = lower, interest_upper_ = upper;
  }
  /// Positions and states of the copies from their sources. comm: with the ranks of the halo, all of these
  void refresh(Particles<D>& particles) const;
  /// The gradients in rows.
  template <class Real>
  void refresh(PairRows<D, Real>& rows) const;
  void refresh_scalar(std::vector<double>& column, std::size_t n_owned) const;  ///< (n_owned + n_ghost)
  void refresh_vector(std::array<std::vector<double>, D>& columns, std::size_t n_owned) const;

  std::size_t size() const { return source_.size(); }
  std::size_t source(std::size_t ghost) const { return static_cast<std::size_t>(source_[ghost]); }
  std::size_t n_halo() const { return n_halo_; }
  OtherRanks<D>* others() const { return others_; }  ///< null: there are none

 private:
  void refresh_images(Particles<D>& particles) const;
  void create_halo(Particles<D>& particles, double reach);
  void copy_across(const Particles<D>& particles, std::size_t d, double reach, bool periodic);
  void add(std::size_t parent, std::size_t n_owned, std::size_t d, double sign, double offset);

  DomainBox<D> box_;
  OtherRanks<D>* others_;
  std::array<double, D> interest_lower_ = filled(1.0), interest_upper_ = filled(-1.0);  // [m]
  std::size_t n_halo_ = 0;
  std::vector<std::int32_t> source_;           // owned particle, or one of the halo
  std::array<std::vector<double>, D> sign_;    // x = sign x_source + offset; u = sign u_source
  std::array<std::vector<double>, D> offset_;  // [m]

  static std::array<double, D> filled(double value) {
    std::array<double, D> all;
    all.fill(value);
    return all;
  }
};

extern template class Ghosts<2>;
extern template class Ghosts<3>;

}  // namespace littoral::sph
