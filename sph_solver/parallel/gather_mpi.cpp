#include "parallel/gather_mpi.hpp"

#include <numeric>

#include "parallel/migrate.hpp"

namespace littoral::sph {
namespace {
constexpr int k_tag_gather = 14;
}

template <int D>
Particles<D> gather_on_root(const Particles<D>& particles, const std::vector<std::int32_t>& chosen,
                            MPI_Comm comm, std::vector<std::int64_t>* counts) {
  int rank = 0, size = 1;
  MPI_Comm_rank(comm, &rank);
  MPI_Comm_size(comm, &size);
  const auto mine = static_cast<std::int64_t>(chosen.size());
  std::vector<std::int64_t> each(static_cast<std::size_t>(size));
  MPI_Gather(&mine, 1, MPI_INT64_T, each.data(), 1, MPI_INT64_T, 0, comm);
  std::vector<char> bytes;
  pack_particles(particles, chosen, bytes);
  MPI_Datatype parcel;
  MPI_Type_contiguous(static_cast<int>(particle_bytes(D)), MPI_BYTE, &parcel);
  MPI_Type_commit(&parcel);
  Particles<D> all;
  if (rank != 0) {
    if (mine > 0) MPI_Send(bytes.data(), static_cast<int>(mine), parcel, 0, k_tag_gather, comm);
  } else {
    all.next_id = particles.next_id;
    unpack_particles(bytes.data(), chosen.size(), all);
    for (int r = 1; r < size; ++r) {
      const auto n = static_cast<std::size_t>(each[static_cast<std::size_t>(r)]);
      if (n == 0) continue;
      bytes.resize(n * particle_bytes(D));
      MPI_Recv(bytes.data(), static_cast<int>(n), parcel, r, k_tag_gather, comm, MPI_STATUS_IGNORE);
      unpack_particles(bytes.data(), n, all);
    }
    if (counts != nullptr) *counts = each;
  }
  MPI_Type_free(&parcel);
  return all;
}

template <int D>
Particles<D> gather_on_root(const Particles<D>& particles, MPI_Comm comm, std::vector<std::int64_t>* counts) {
  std::vector<std::int32_t> everyone(particles.n_owned);
  std::iota(everyone.begin(), everyone.end(), 0);
  return gather_on_root(particles, everyone, comm, counts);
}

template Particles<2> gather_on_root<2>(const Particles<2>&, MPI_Comm, std::vector<std::int64_t>*);
template Particles<3> gather_on_root<3>(const Particles<3>&, MPI_Comm, std::vector<std::int64_t>*);
template Particles<2> gather_on_root<2>(const Particles<2>&, const std::vector<std::int32_t>&, MPI_Comm,
                                        std::vector<std::int64_t>*);
template Particles<3> gather_on_root<3>(const Particles<3>&, const std::vector<std::int32_t>&, MPI_Comm,
                                        std::vector<std::int64_t>*);

}  // namespace littoral::sph
