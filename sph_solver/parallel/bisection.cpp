#include "parallel/bisection.hpp"

#include <zoltan.h>

#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string>

namespace littoral::sph {
namespace {

void demand(int code, const char* what) {
  if (code == ZOLTAN_OK || code == ZOLTAN_WARN) return;
  throw std::runtime_error(std::string("Zoltan's recursive bisection failed (") + what + ", code " +
                           std::to_string(code) + ").");
}

template <int D>
const Particles<D>& particles_of(void* data) {
  return *static_cast<const Particles<D>*>(data);
}

template <int D>
int count(void* data, int* error) {
  *error = ZOLTAN_OK;
  return static_cast<int>(particles_of<D>(data).n_owned);
}

template <int D>
void list(void* data, int, int, ZOLTAN_ID_PTR global, ZOLTAN_ID_PTR local, int, float*, int* error) {
  *error = ZOLTAN_OK;
  const auto& particles = particles_of<D>(data);
  for (std::size_t i = 0; i < particles.n_owned; ++i) {
    // Two words hold a 64-bit id.
    global[2 * i] = static_cast<ZOLTAN_ID_TYPE>(particles.id[i] & 0xffffffff);
    global[2 * i + 1] = static_cast<ZOLTAN_ID_TYPE>(particles.id[i] >> 32);
    local[i] = static_cast<ZOLTAN_ID_TYPE>(i);
  }
}

int dimensions_2(void*, int* error) { return *error = ZOLTAN_OK, 2; }
int dimensions_3(void*, int* error) { return *error = ZOLTAN_OK, 3; }

template <int D>
void places(void* data, int, int, int n, ZOLTAN_ID_PTR, ZOLTAN_ID_PTR local, int, double* x, int* error) {
  *error = ZOLTAN_OK;
  const auto& particles = particles_of<D>(data);
  for (int k = 0; k < n; ++k)
    for (std::size_t d = 0; d < D; ++d) x[static_cast<std::size_t>(k) * D + d] = particles.x[d][local[k]];
}

/// The first rank's, whose particles will be the first.
template <int D>
Regions<D> undivided(int ranks) {
  constexpr double far = std::numeric_limits<double>::max();
  std::vector<RankBox<D>> boxes(static_cast<std::size_t>(ranks));
  for (std::size_t r = 0; r < boxes.size(); ++r) {
    boxes[r].lower.fill(r == 0 ? -far : far);
    boxes[r].upper.fill(r == 0 ? far : -far);
  }
  return Regions<D>(std::move(boxes));
}

struct Partition {
  Zoltan_Struct* zz;
  ~Partition() { Zoltan_Destroy(&zz); }
};

struct Result {
  int changes = 0, n_gid = 0, n_lid = 0, n_import = 0, n_export = 0;
  ZOLTAN_ID_PTR import_global = nullptr, import_local = nullptr, export_global = nullptr,
                export_local = nullptr;
  int *import_ranks = nullptr, *import_parts = nullptr, *export_ranks = nullptr, *export_parts = nullptr;
  ~Result() {
    Zoltan_LB_Free_Part(&import_global, &import_local, &import_ranks, &import_parts);
    Zoltan_LB_Free_Part(&export_global, &export_local, &export_ranks, &export_parts);
  }
};

}  // namespace

template <int D>
Regions<D> bisect(const Particles<D>& particles, MPI_Comm comm) {
  int size = 1;
  MPI_Comm_size(comm, &size);
  auto total = static_cast<std::int64_t>(particles.n_owned);
  MPI_Allreduce(MPI_IN_PLACE, &total, 1, MPI_INT64_T, MPI_SUM, comm);
  if (total == 0) return undivided<D>(size);
  float version = 0;
  demand(Zoltan_Initialize(0, nullptr, &version), "start");
  Partition partition{Zoltan_Create(comm)};
  if (partition.zz == nullptr) throw std::runtime_error("Zoltan cannot be started (no memory?).");
  Zoltan_Struct* zz = partition.zz;
  for (const auto& [name, value] : {std::pair{"DEBUG_LEVEL", "0"},
                                    {"LB_METHOD", "RCB"},
                                    {"NUM_GID_ENTRIES", "2"},
                                    {"NUM_LID_ENTRIES", "1"},
                                    {"OBJ_WEIGHT_DIM", "0"},
                                    {"KEEP_CUTS", "1"},
                                    {"RETURN_LISTS", "NONE"},
                                    {"IMBALANCE_TOL", "1.0"}})
    demand(Zoltan_Set_Param(zz, name, value), name);
  auto* data = const_cast<Particles<D>*>(&particles);  // Zoltan's functions take no const
  demand(Zoltan_Set_Num_Obj_Fn(zz, count<D>, data), "objects");
  demand(Zoltan_Set_Obj_List_Fn(zz, list<D>, data), "objects");
  demand(Zoltan_Set_Num_Geom_Fn(zz, D == 2 ? dimensions_2 : dimensions_3, data), "dimensions");
  demand(Zoltan_Set_Geom_Multi_Fn(zz, places<D>, data), "places");
  Result result;
  demand(Zoltan_LB_Partition(zz, &result.changes, &result.n_gid, &result.n_lid, &result.n_import,
                             &result.import_global, &result.import_local, &result.import_ranks,
                             &result.import_parts, &result.n_export, &result.export_global,
                             &result.export_local, &result.export_ranks, &result.export_parts),
         "partition");
  std::vector<RankBox<D>> boxes(static_cast<std::size_t>(size));
  for (int part = 0; part < size; ++part) {
    int dimensions = 0;
    std::array<double, 3> lower{}, upper{};
    demand(Zoltan_RCB_Box(zz, part, &dimensions, &lower[0], &lower[1], &lower[2], &upper[0], &upper[1],
                          &upper[2]),
           "box");
    for (std::size_t d = 0; d < D; ++d) {
      boxes[static_cast<std::size_t>(part)].lower[d] = lower[d];
      boxes[static_cast<std::size_t>(part)].upper[d] = upper[d];
    }
  }
  return Regions<D>(std::move(boxes));
}

template Regions<2> bisect<2>(const Particles<2>&, MPI_Comm);
template Regions<3> bisect<3>(const Particles<3>&, MPI_Comm);

}  // namespace littoral::sph
