#pragma once

#include <mpi.h>

#include <array>
#include <cstdint>
#include <vector>

#include "boundary/domain_box.hpp"
#include "pairs/pair_rows.hpp"
#include "parallel/halo.hpp"
#include "particles/particles.hpp"

namespace littoral::sph {

/// What a rank has sent to its neighbours so far, for a run's summary.
struct HaloTraffic {
  std::int64_t refreshes = 0;
  std::int64_t messages = 0;
  double bytes = 0.0;
  double seconds = 0.0;  // in the exchange, waiting included
};

/// Copies of other ranks' particles around this rank's. The lists of who gets what are made with the lists of
/// neighbours and live as long; every renewal is one message to and from each neighbour, out of buffers that
/// are kept.
template <int D>
class Halo {
 public:
  Halo(MPI_Comm comm, const DomainBox<D>& box) : comm_(comm), shifts_(periodic_shifts(box)) {}

  /// Makes the lists and appends the copies; returns their number. comm: collective
  std::size_t create(Particles<D>& particles, double reach, const RankBox<D>& wants);
  /// comm: with the neighbours, as all of these
  void refresh(Particles<D>& particles);
  template <class Real>
  void refresh(PairRows<D, Real>& rows);  ///< the gradients in them
  void refresh(const std::vector<std::vector<double>*>& columns, std::size_t n_owned);

  std::size_t size() const { return n_halo_; }
  std::size_t n_neighbors() const { return links_.size(); }
  const HaloTraffic& traffic() const { return traffic_; }

 private:
  struct Link {
    int rank = 0;
    std::vector<HaloEntry> gives;
    std::size_t takes = 0;  // number of copies it gives us
    std::size_t first = 0;  // of them in the halo
    std::vector<double> out, in;
  };
  /// pack(entry, double* place), unpack(copy in the halo, const double* place), `width` numbers a particle.
  template <class Pack, class Unpack>
  void exchange(std::size_t width, const Pack& pack, const Unpack& unpack);
  void find_links(const Particles<D>& particles, double reach, const RankBox<D>& wants);

  MPI_Comm comm_;
  std::vector<std::array<double, D>> shifts_;
  std::vector<Link> links_;
  std::vector<MPI_Request> requests_;
  std::size_t n_halo_ = 0;
  HaloTraffic traffic_;
};

extern template class Halo<2>;
extern template class Halo<3>;

}  // namespace littoral::sph
