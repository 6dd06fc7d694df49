#include "parallel/migrate.hpp"

#include <cstring>
#include <type_traits>

namespace littoral::sph {

template <int D>
MigrationPlan plan_migration(const Particles<D>& particles, const Regions<D>& regions, std::size_t rank) {
  MigrationPlan plan;
  plan.to.resize(regions.size());
  plan.leaves.assign(particles.n_owned, 0);
  for (std::size_t i = 0; i < particles.n_owned; ++i) {
    std::array<double, D> x;
    for (std::size_t d = 0; d < D; ++d) x[d] = particles.x[d][i];
    const std::size_t owner = regions.owner(x, rank);
    if (owner == rank) continue;
    plan.to[owner].push_back(static_cast<std::int32_t>(i));
    plan.leaves[i] = 1;
    ++plan.n_leaving;
  }
  return plan;
}

template <int D>
void pack_particles(const Particles<D>& particles, const std::vector<std::int32_t>& which,
                    std::vector<char>& bytes) {
  const auto put = [&](auto& column) {
    using Value = typename std::decay_t<decltype(column)>::value_type;
    const std::size_t begin = bytes.size();
    bytes.resize(begin + which.size() * sizeof(Value));
    for (std::size_t k = 0; k < which.size(); ++k)
      std::memcpy(bytes.data() + begin + k * sizeof(Value), &column[static_cast<std::size_t>(which[k])],
                  sizeof(Value));
  };
  auto& columns =
      const_cast<Particles<D>&>(particles);  // the list of columns is not const; they are only read
  columns.for_each_shared_column(put);
  columns.for_each_owned_column(put);
}

namespace {
template <int D>
std::size_t bytes_of_one() {
  std::size_t sum = 0;
  const auto add = [&sum](auto& column) {
    sum += sizeof(typename std::decay_t<decltype(column)>::value_type);
  };
  Particles<D> none;
  none.for_each_shared_column(add);
  none.for_each_owned_column(add);
  return sum;
}
}  // namespace

std::size_t particle_bytes(int dimension) {
  static const std::size_t in_2d = bytes_of_one<2>(), in_3d = bytes_of_one<3>();
  return dimension == 2 ? in_2d : in_3d;
}

template <int D>
const char* unpack_particles(const char* bytes, std::size_t n, Particles<D>& particles) {
  ++particles.revision;
  particles.drop_ghosts();
  const std::size_t first = particles.n_owned;
  const auto get = [&](auto& column) {
    using Value = typename std::decay_t<decltype(column)>::value_type;
    column.resize(first + n);
    if (n > 0) std::memcpy(column.data() + first, bytes, n * sizeof(Value));
    bytes += n * sizeof(Value);
  };
  particles.for_each_shared_column(get);
  particles.for_each_owned_column(get);
  particles.n_owned += n;
  for (std::size_t i = first; i < particles.n_owned; ++i) particles.donor_hint[i] = -1;
  return bytes;
}

template MigrationPlan plan_migration<2>(const Particles<2>&, const Regions<2>&, std::size_t);
template MigrationPlan plan_migration<3>(const Particles<3>&, const Regions<3>&, std::size_t);
template void pack_particles<2>(const Particles<2>&, const std::vector<std::int32_t>&, std::vector<char>&);
template void pack_particles<3>(const Particles<3>&, const std::vector<std::int32_t>&, std::vector<char>&);
template const char* unpack_particles<2>(const char*, std::size_t, Particles<2>&);
template const char* unpack_particles<3>(const char*, std::size_t, Particles<3>&);

}  // namespace littoral::sph
