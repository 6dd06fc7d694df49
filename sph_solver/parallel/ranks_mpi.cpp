#include "parallel/ranks_mpi.hpp"

#include <algorithm>

#include "parallel/bisection.hpp"
#include "parallel/migrate_mpi.hpp"

namespace littoral::sph {

template <int D>
MpiRanks<D>::MpiRanks(MPI_Comm comm, const DomainBox<D>& box) : comm_(comm), halo_(comm, box) {
  MPI_Comm_rank(comm_, &rank_);
  MPI_Comm_size(comm_, &size_);
}

template <int D>
void MpiRanks<D>::balance(Particles<D>& particles) {
  regions_ = bisect(particles, comm_);
  ++n_balanced_;
  n_migrated_ += static_cast<std::int64_t>(sph::migrate(particles, regions_, comm_));
  load_ = imbalance(particles);
}

template <int D>
bool MpiRanks<D>::unbalanced(const Particles<D>& particles, double drift) {
  return imbalance(particles) > drift * load_;
}

template <int D>
std::int64_t MpiRanks<D>::total(const Particles<D>& particles) {
  auto n = static_cast<std::int64_t>(particles.n_owned);
  MPI_Allreduce(MPI_IN_PLACE, &n, 1, MPI_INT64_T, MPI_SUM, comm_);
  return n;
}

template <int D>
double MpiRanks<D>::imbalance(const Particles<D>& particles) {
  auto most = static_cast<std::int64_t>(particles.n_owned);
  MPI_Allreduce(MPI_IN_PLACE, &most, 1, MPI_INT64_T, MPI_MAX, comm_);
  const auto all = static_cast<double>(std::max<std::int64_t>(1, total(particles)));
  return static_cast<double>(most) * size_ / all;
}

template <int D>
bool MpiRanks<D>::any(bool here) {
  int flag = here ? 1 : 0;
  MPI_Allreduce(MPI_IN_PLACE, &flag, 1, MPI_INT, MPI_MAX, comm_);
  return flag != 0;
}

template <int D>
void MpiRanks<D>::take_largest(double* values, std::size_t n) {
  MPI_Allreduce(MPI_IN_PLACE, values, static_cast<int>(n), MPI_DOUBLE, MPI_MAX, comm_);
}

template <int D>
void MpiRanks<D>::take_sum(double* values, std::size_t n) {
  gathered_.resize(n * static_cast<std::size_t>(size_));
  MPI_Allgather(values, static_cast<int>(n), MPI_DOUBLE, gathered_.data(), static_cast<int>(n), MPI_DOUBLE,
                comm_);
  for (std::size_t k = 0; k < n; ++k) {
    values[k] = 0.0;
    for (std::size_t r = 0; r < static_cast<std::size_t>(size_); ++r) values[k] += gathered_[r * n + k];
  }
}

template <int D>
void MpiRanks<D>::merge(std::vector<double>& values) {
  MPI_Allreduce(MPI_IN_PLACE, values.data(), static_cast<int>(values.size()), MPI_DOUBLE, MPI_SUM, comm_);
}

template <int D>
std::vector<double> MpiRanks<D>::gather(const std::vector<double>& mine) {
  const int n = static_cast<int>(mine.size());
  std::vector<int> counts(static_cast<std::size_t>(size_)), places(static_cast<std::size_t>(size_));
  MPI_Allgather(&n, 1, MPI_INT, counts.data(), 1, MPI_INT, comm_);
  int total = 0;
  for (std::size_t r = 0; r < counts.size(); ++r) {
    places[r] = total;
    total += counts[r];
  }
  std::vector<double> all(static_cast<std::size_t>(total));
  MPI_Allgatherv(mine.data(), n, MPI_DOUBLE, all.data(), counts.data(), places.data(), MPI_DOUBLE, comm_);
  return all;
}

template <int D>
void MpiRanks<D>::migrate(Particles<D>& particles) {
  if (regions_.size() == 0) return;
  n_migrated_ += static_cast<std::int64_t>(sph::migrate(particles, regions_, comm_));
  if (drift_ > 0.0 && unbalanced(particles, drift_)) balance(particles);
}

template <int D>
std::size_t MpiRanks<D>::create_halo(Particles<D>& particles, double reach, std::array<double, D> lower,
                                     std::array<double, D> upper) {
  return halo_.create(particles, reach, {lower, upper});
}

template <int D>
void MpiRanks<D>::refresh_scalar(std::vector<double>& column, std::size_t n_owned) {
  halo_.refresh({&column}, n_owned);
}

template <int D>
void MpiRanks<D>::refresh_vector(std::array<std::vector<double>, D>& columns, std::size_t n_owned) {
  std::vector<std::vector<double>*> all;
  for (auto& column : columns) all.push_back(&column);
  halo_.refresh(all, n_owned);
}

template class MpiRanks<2>;
template class MpiRanks<3>;

}  // namespace littoral::sph
