#pragma once

#include <mpi.h>

#include <cstddef>
#include <memory>
#include <vector>

#include "parallel/ranks.hpp"

namespace littoral::fv {

/// One message to and from each neighbour rank, out of buffers and with requests that are kept: the transport
/// of everything that passes between blocks of different ranks. Fill out(i), start(), wait(), read in(i).
class Halo {
 public:
  struct Peer {
    int rank = 0;
    std::size_t gives = 0, takes = 0;  // bytes of a message
  };
  Halo() = default;
  /// All ranks make their halos in the same order; a pair of them agrees on the sizes. comm: local
  Halo(const Ranks& ranks, const std::vector<Peer>& peers);
  Halo(Halo&&) noexcept;
  Halo& operator=(Halo&&) noexcept;
  ~Halo();

  template <class T>
  T* out(std::size_t peer) {
    return reinterpret_cast<T*>(out_[peer].data());
  }
  template <class T>
  const T* in(std::size_t peer) const {
    return reinterpret_cast<const T*>(in_[peer].data());
  }
  void start();
  void wait();

 private:
  std::vector<std::vector<double>> out_, in_;  // of doubles, so that any number lies aligned in them
  std::vector<MPI_Request> requests_;
  std::shared_ptr<Traffic> traffic_;
  Traffic of_start_;  // what one start() adds
};

}  // namespace littoral::fv
