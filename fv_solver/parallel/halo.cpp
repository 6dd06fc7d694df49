#include "parallel/halo.hpp"

#include <utility>

namespace littoral::fv {
namespace {
constexpr int k_tag_halo = 32;
}

Halo::Halo(const Ranks& ranks, const std::vector<Peer>& peers) : traffic_(ranks.traffic()) {
  const auto doubles = [](std::size_t bytes) { return (bytes + sizeof(double) - 1) / sizeof(double); };
  for (const Peer& peer : peers) {
    out_.emplace_back(doubles(peer.gives));
    in_.emplace_back(doubles(peer.takes));
    if (peer.takes > 0) {
      requests_.emplace_back();
      MPI_Recv_init(in_.back().data(), static_cast<int>(peer.takes), MPI_BYTE, peer.rank, k_tag_halo,
                    ranks.comm(), &requests_.back());
    }
    if (peer.gives > 0) {
      of_start_.messages += 1.0;
      of_start_.bytes += static_cast<double>(peer.gives);
      requests_.emplace_back();
      MPI_Send_init(out_.back().data(), static_cast<int>(peer.gives), MPI_BYTE, peer.rank, k_tag_halo,
                    ranks.comm(), &requests_.back());
    }
  }
}

Halo::Halo(Halo&& other) noexcept
    : out_(std::move(other.out_)),
      in_(std::move(other.in_)),
      requests_(std::move(other.requests_)),
      traffic_(std::move(other.traffic_)),
      of_start_(other.of_start_) {
  other.requests_.clear();
}

Halo& Halo::operator=(Halo&& other) noexcept {
  std::swap(out_, other.out_);
  std::swap(in_, other.in_);
  std::swap(requests_, other.requests_);
  std::swap(traffic_, other.traffic_);
  std::swap(of_start_, other.of_start_);
  return *this;
}

Halo::~Halo() {
  int finalized = 0;
  if (!requests_.empty()) MPI_Finalized(&finalized);
  if (finalized != 0) return;
  for (MPI_Request& request : requests_) MPI_Request_free(&request);
}

void Halo::start() {
  if (requests_.empty()) return;
  MPI_Startall(static_cast<int>(requests_.size()), requests_.data());
  traffic_->messages += of_start_.messages;
  traffic_->bytes += of_start_.bytes;
}

void Halo::wait() {
  if (!requests_.empty())
    MPI_Waitall(static_cast<int>(requests_.size()), requests_.data(), MPI_STATUSES_IGNORE);
}

}  // namespace littoral::fv
