#pragma once

#include <mpi.h>

#include "boundary/domain_box.hpp"
#include "parallel/halo_mpi.hpp"
#include "parallel/other_ranks.hpp"
#include "parallel/regions.hpp"

namespace littoral::sph {

/// The ranks of the program, each with a part of space. Made on several ranks only.
template <int D>
class MpiRanks final : public OtherRanks<D> {
 public:
  /// Before the first balance() or set_regions() every particle stays where it is.
  MpiRanks(MPI_Comm comm, const DomainBox<D>& box);

  int rank() const override { return rank_; }
  int size() const { return size_; }
  MPI_Comm comm() const { return comm_; }

  const Regions<D>& regions() const override { return regions_; }
  void set_regions(Regions<D> regions) { regions_ = std::move(regions); }
  /// Bisects anew and sends every particle to its rank. comm: collective
  void balance(Particles<D>& particles);
  /// True if the fullest rank holds more than the mean of all, by a factor that has grown since the last
  /// bisection beyond `drift`. comm: collective
  bool unbalanced(const Particles<D>& particles, double drift);
  /// migrate() bisects anew, too, where unbalanced(drift). Without a call it never does.
  void balance_with_migration(double drift) { drift_ = drift; }
  double load() const { return load_; }  ///< the factor at the last bisection; part of a checkpoint
  void set_load(double load) { load_ = load; }
  std::int64_t total(const Particles<D>& particles);  ///< owned ones of all ranks. comm: collective
  std::int64_t n_balanced() const { return n_balanced_; }
  std::int64_t n_migrated() const { return n_migrated_; }  ///< particles that have left this rank so far
  const Halo<D>& halo() const { return halo_; }

  bool any(bool here) override;
  void take_largest(double* values, std::size_t n) override;
  void take_sum(double* values, std::size_t n) override;
  void merge(std::vector<double>& values) override;
  std::vector<double> gather(const std::vector<double>& mine) override;
  void migrate(Particles<D>& particles) override;
  std::size_t create_halo(Particles<D>& particles, double reach, std::array<double, D> lower,
                          std::array<double, D> upper) override;
  void refresh(Particles<D>& particles) override { halo_.refresh(particles); }
  void refresh(PairRows<D, double>& rows) override { halo_.refresh(rows); }
  void refresh(PairRows<D, float>& rows) override { halo_.refresh(rows); }
  void refresh_scalar(std::vector<double>& column, std::size_t n_owned) override;
  void refresh_vector(std::array<std::vector<double>, D>& columns, std::size_t n_owned) override;

 private:
  double imbalance(const Particles<D>& particles);

  MPI_Comm comm_;
  int rank_ = 0, size_ = 1;
  Regions<D> regions_;
  Halo<D> halo_;
  double drift_ = 0.0;  // 0: migration does not bisect
  double load_ = 1.0;
  std::int64_t n_balanced_ = 0, n_migrated_ = 0;
  std::vector<double> gathered_;
};

extern template class MpiRanks<2>;
extern template class MpiRanks<3>;

}  // namespace littoral::sph
