#include "outbox.hpp"

#include <algorithm>

#include "wire.hpp"

namespace littoral::coupler {

void Outbox::start(int rank, const Bytes& message, const std::vector<Piece>& columns) {
  auto& parcel = parcels_.emplace_back();
  parcel.rank = rank;
  std::size_t first = message.size();
  if (message.size() > k_one_piece || !columns.empty()) {
    first = sizeof(Header);
    parcel.rest.push_back({message.data() + first, message.size() - first});
    parcel.rest.insert(parcel.rest.end(), columns.begin(), columns.end());
  }
  send(parcel, {message.data(), first}, k_tag_message);
}

void Outbox::send(Parcel& parcel, const Piece& piece, int tag) {
  piece.gather();
  MPI_Isend(piece.at, static_cast<int>(piece.bytes), MPI_CHAR, parcel.rank, tag, intercomm_,
            &parcel.requests.emplace_back(MPI_REQUEST_NULL));
}

bool Outbox::progress() {
  bool all = true;
  for (auto& parcel : parcels_) {
    if (parcel.gone) continue;
    int yes = 0;
    MPI_Testall(static_cast<int>(parcel.requests.size()), parcel.requests.data(), &yes, MPI_STATUSES_IGNORE);
    if (yes && parcel.rest.empty()) {
      parcel.gone = true;
      continue;
    }
    all = false;
    if (!yes) continue;
    MPI_Iprobe(parcel.rank, k_tag_request, intercomm_, &yes, MPI_STATUS_IGNORE);
    if (!yes) continue;
    MPI_Recv(nullptr, 0, MPI_CHAR, parcel.rank, k_tag_request, intercomm_, MPI_STATUS_IGNORE);
    for (const Piece& piece : parcel.rest) send(parcel, piece, k_tag_rest);
    parcel.rest.clear();
  }
  if (all) parcels_.clear();
  return all;
}

bool Outbox::settled() {
  bool all = true;
  for (auto& parcel : parcels_) {
    int yes = 0;
    MPI_Testall(static_cast<int>(parcel.requests.size()), parcel.requests.data(), &yes, MPI_STATUSES_IGNORE);
    all = yes && all;
  }
  return all;
}

bool Outbox::moving() const {
  return std::any_of(parcels_.begin(), parcels_.end(),
                     [](const Parcel& parcel) { return !parcel.gone && parcel.rest.empty(); });
}

std::vector<int> Outbox::ranks() const {
  std::vector<int> ranks;
  for (const auto& parcel : parcels_)
    if (!parcel.gone) ranks.push_back(parcel.rank);
  return ranks;
}

}  // namespace littoral::coupler
