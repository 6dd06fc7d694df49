#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "boundary/domain_box.hpp"
#include "particles/particles.hpp"
#include "physics/gradients.hpp"

namespace littoral::sph {

/// Copies of owned particles beyond periodic faces and mirror images beyond symmetry planes, edges and
/// corners included. A copy knows its source and the transform: per component a sign and an offset.
template <int D>
class Ghosts {
 public:
  explicit Ghosts(const DomainBox<D>& box) : box_(box) {}

  /// Brings owned particles that left through a periodic face back on the other side, and those that crossed
  /// a symmetry plane by less than `tolerance` back to its mirror image, velocity included. Returns the
  /// number of the latter. throws StabilityError naming a particle that is further outside, or beyond an open
  /// face by more than the domain's length: it is lost
  std::size_t bring_back(Particles<D>& particles, double tolerance, double time) const;

  /// Makes all copies that lie within `reach` [m] outside the domain. The domain must be as long as `reach`.
  void create(Particles<D>& particles, double reach);
  /// Positions and states of the copies from their sources.
  void refresh(Particles<D>& particles) const;
  void refresh(Gradients<D>& gradients, std::size_t n_owned) const;
  void refresh_scalar(std::vector<double>& column, std::size_t n_owned) const;  ///< (n_owned + n_ghost)
  void refresh_vector(std::array<std::vector<double>, D>& columns, std::size_t n_owned) const;

  std::size_t size() const { return source_.size(); }
  std::size_t source(std::size_t ghost) const { return static_cast<std::size_t>(source_[ghost]); }

 private:
  void add(std::size_t parent, std::size_t n_owned, std::size_t d, double sign, double offset);

  DomainBox<D> box_;
  std::vector<std::int32_t> source_;           // owned particle
  std::array<std::vector<double>, D> sign_;    // x = sign x_source + offset; u = sign u_source
  std::array<std::vector<double>, D> offset_;  // [m]
};

extern template class Ghosts<2>;
extern template class Ghosts<3>;

}  // namespace littoral::sph
