#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "pairs/pair_rows.hpp"
#include "parallel/regions.hpp"
#include "particles/particles.hpp"

namespace littoral::sph {

/// The other ranks of this program, as a step needs them. A run on one rank has no such object: where a null
/// pointer stands nothing is sent and nothing copied. Every function is called by all ranks in the same
/// order.
template <int D>
class OtherRanks {
 public:
  using Column = std::vector<double>;
  virtual ~OtherRanks() = default;

  virtual int rank() const = 0;
  virtual const Regions<D>& regions() const = 0;  ///< the same on all ranks

  /// comm: collective, each of these
  virtual bool any(bool here) = 0;
  virtual void take_largest(double* values, std::size_t n) = 0;  ///< each becomes the largest of all ranks
  virtual void take_sum(double* values, std::size_t n) = 0;      ///< summed in the order of the ranks
  /// Of each number, one rank at most has another value than 0: all get that. No sum is rounded.
  virtual void merge(std::vector<double>& values) = 0;
  /// What all ranks give, one after the other.
  virtual std::vector<double> gather(const std::vector<double>& mine) = 0;

  /// Sends the owned particles that stand in another rank's part of space there. comm: collective
  virtual void migrate(Particles<D>& particles) = 0;

  /// Appends to the owned particles, behind which no copy stands, the halo: copies of all particles of other
  /// ranks, and of their periodic images, within `reach` [m] of the box `lower`, `upper` that holds this
  /// rank's points (lower > upper: none). Returns their number. comm: collective
  virtual std::size_t create_halo(Particles<D>& particles, double reach, std::array<double, D> lower,
                                  std::array<double, D> upper) = 0;
  /// Renews what the halo holds, the first copies behind the owned ones. comm: between neighbours, one
  /// message each way
  virtual void refresh(Particles<D>& particles) = 0;
  virtual void refresh(PairRows<D, double>& rows) = 0;  ///< the gradients in them, as below
  virtual void refresh(PairRows<D, float>& rows) = 0;
  virtual void refresh_scalar(Column& column, std::size_t n_owned) = 0;
  virtual void refresh_vector(std::array<Column, D>& columns, std::size_t n_owned) = 0;
};

}  // namespace littoral::sph
