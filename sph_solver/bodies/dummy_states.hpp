#pragma once

#include "bodies/wall_list.hpp"
#include "parallel/other_ranks.hpp"

namespace littoral::sph {

/// States that dummies take over from the water around them (`wall_states: extrapolated`; Adami, Hu & Adams
/// 2012), means with weights V_i W_iw:
///   p_w = <p_i + rho_i (f_i - a_w) . x_iw>,   u_w = <u_i> - 2 ((<u_i> - u_wall) . n) n
/// f: mass force, x_iw: from particle to dummy. The copies of a dummy beyond periodic sides and symmetry
/// planes share one sum, to which every rank adds what its owned particles contribute.
template <int D>
class DummyStates {
 public:
  /// Which particles each dummy hears of. pre: list belongs to these particles and dummies
  void build(const WallList<D>& list, const Dummies<D>& dummies);
  /// comm  collective over `others`: one sum; local where it is null
  void extrapolate(const Particles<D>& particles, const Dummies<D>& dummies, const WallList<D>& list,
                   const RowAccelerations<D>& mass_force, double kernel_radius, OtherRanks<D>* others);

  double pressure(std::size_t dummy) const { return p_[dummy]; }  // [Pa]
  std::array<double, D> velocity(std::size_t dummy) const;        // [m/s]

 private:
  struct Heard {
    std::int32_t dummy, row;
  };
  std::vector<std::size_t> start_;  // of each source, in heard_
  std::vector<Heard> heard_;
  std::vector<double> sums_;  // of each source: weight, p, u
  std::vector<double> p_;
  std::array<std::vector<double>, D> u_;
};

extern template class DummyStates<2>;
extern template class DummyStates<3>;

}  // namespace littoral::sph
