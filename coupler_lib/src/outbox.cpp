#include "outbox.hpp"

#include <algorithm>

#include "wire.hpp"

namespace littoral::coupler {

void Outbox::start(int rank, const Bytes& message) {
  auto& parcel = parcels_.emplace_back();
  parcel.rank = rank;
  parcel.message = &message;
  parcel.asked = message.size() <= k_one_piece;
  const std::size_t first = parcel.asked ? message.size() : sizeof(Header);
  MPI_Isend(message.data(), static_cast<int>(first), MPI_CHAR, rank, k_tag_message, intercomm_,
            &parcel.request);
}

bool Outbox::progress() {
  bool all = true;
  for (auto& parcel : parcels_) {
    if (parcel.gone) continue;
    int yes = 0;
    MPI_Test(&parcel.request, &yes, MPI_STATUS_IGNORE);
    if (yes && parcel.asked) {
      parcel.gone = true;
      continue;
    }
    all = false;
    if (!yes) continue;
    MPI_Iprobe(parcel.rank, k_tag_request, intercomm_, &yes, MPI_STATUS_IGNORE);
    if (!yes) continue;
    MPI_Recv(nullptr, 0, MPI_CHAR, parcel.rank, k_tag_request, intercomm_, MPI_STATUS_IGNORE);
    parcel.asked = true;
    MPI_Isend(parcel.message->data() + sizeof(Header),
              static_cast<int>(parcel.message->size() - sizeof(Header)), MPI_CHAR, parcel.rank, k_tag_rest,
              intercomm_, &parcel.request);
  }
  if (all) parcels_.clear();
  return all;
}

bool Outbox::moving() const {
  return std::any_of(parcels_.begin(), parcels_.end(),
                     [](const Parcel& parcel) { return !parcel.gone && parcel.asked; });
}

std::vector<int> Outbox::ranks() const {
  std::vector<int> ranks;
  for (const auto& parcel : parcels_)
    if (!parcel.gone) ranks.push_back(parcel.rank);
  return ranks;
}

}  // namespace littoral::coupler
