#include "parallel/migrate_mpi.hpp"

#include <cstdint>
#include <vector>

#include "parallel/migrate.hpp"

namespace littoral::sph {
namespace {
constexpr int k_tag_migrate = 13;
}

template <int D>
std::size_t migrate(Particles<D>& particles, const Regions<D>& regions, MPI_Comm comm) {
  int rank = 0;
  MPI_Comm_rank(comm, &rank);
  const std::size_t size = regions.size();
  const MigrationPlan plan = plan_migration(particles, regions, static_cast<std::size_t>(rank));
  std::vector<std::int64_t> leaving(size), coming(size);
  for (std::size_t r = 0; r < size; ++r) leaving[r] = static_cast<std::int64_t>(plan.to[r].size());
  MPI_Alltoall(leaving.data(), 1, MPI_INT64_T, coming.data(), 1, MPI_INT64_T, comm);

  const std::size_t each = particle_bytes(D);
  std::vector<std::vector<char>> out(size), in(size);
  std::vector<MPI_Request> requests;
  MPI_Datatype parcel;  // a particle, so that counts stay small
  MPI_Type_contiguous(static_cast<int>(each), MPI_BYTE, &parcel);
  MPI_Type_commit(&parcel);
  for (std::size_t r = 0; r < size; ++r) {
    if (coming[r] == 0) continue;
    in[r].resize(static_cast<std::size_t>(coming[r]) * each);
    MPI_Irecv(in[r].data(), static_cast<int>(coming[r]), parcel, static_cast<int>(r), k_tag_migrate, comm,
              &requests.emplace_back());
  }
  for (std::size_t r = 0; r < size; ++r) {
    if (leaving[r] == 0) continue;
    pack_particles(particles, plan.to[r], out[r]);
    MPI_Isend(out[r].data(), static_cast<int>(leaving[r]), parcel, static_cast<int>(r), k_tag_migrate, comm,
              &requests.emplace_back());
  }
  MPI_Waitall(static_cast<int>(requests.size()), requests.data(), MPI_STATUSES_IGNORE);
  MPI_Type_free(&parcel);
  if (plan.n_leaving > 0) particles.remove(plan.leaves);
  for (std::size_t r = 0; r < size; ++r)
    if (coming[r] > 0) unpack_particles(in[r].data(), static_cast<std::size_t>(coming[r]), particles);
  return plan.n_leaving;
}

template std::size_t migrate<2>(Particles<2>&, const Regions<2>&, MPI_Comm);
template std::size_t migrate<3>(Particles<3>&, const Regions<3>&, MPI_Comm);

}  // namespace littoral::sph
