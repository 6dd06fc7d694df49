#include "incoming.hpp"

#include <cstring>
#include <utility>

#include "littoral/error.hpp"
#include "probe.hpp"
#include "validate.hpp"

namespace littoral::coupler {

namespace {

void look_through(Slot& slot) {
  if (slot.numbers) slot.all_finite = all_finite(slot.at, slot.bytes / sizeof(double));
}

void refuse_unless_due(std::uint64_t found, const std::vector<Slot>& slots, const std::string& who,
                       const std::string& what) {
  std::uint64_t due = 0;
  for (const Slot& slot : slots) due += slot.bytes;
  if (found != due)
    throw CouplingError(who + " sent " + what + " in " + std::to_string(found) + " bytes where " +
                        std::to_string(due) + " are due: are there other columns than the scene asks for?");
}

}  // namespace

void scatter(const char* content, std::size_t count, std::vector<Slot>& slots, const std::string& who,
             const std::string& what) {
  refuse_unless_due(count, slots, who, what);
  for (Slot& slot : slots) {
    if (slot.bytes > 0) std::memcpy(slot.at, content, slot.bytes);
    content += slot.bytes;
    look_through(slot);
  }
}

void Incoming::expect(MPI_Comm intercomm, int rank, const Expected& expected, std::string who) {
  intercomm_ = intercomm;
  rank_ = rank;
  expected_ = expected;
  who_ = std::move(who);
  state_ = State::awaited;
  piece_ = 0;
}

bool Incoming::progress() {
  if (state_ == State::awaited) begin();
  if (state_ == State::whole) {
    int yes = 0;
    MPI_Test(&request_, &yes, MPI_STATUS_IGNORE);
    if (yes) take_whole();
  }
  while (state_ == State::asked || state_ == State::piece) {
    if (state_ == State::asked) begin_piece();
    if (state_ == State::asked) return false;
    int yes = 0;
    MPI_Test(&request_, &yes, MPI_STATUS_IGNORE);
    if (!yes) return false;
    if (!slots.empty()) look_through(slots[piece_]);
    state_ = ++piece_ < slots.size() ? State::asked : State::here;
  }
  return here();
}

/// A message or the header of a long one has come: checks it, takes it or asks for the rest.
void Incoming::begin() {
  auto found = probe(rank_, k_tag_message, intercomm_);
  if (!found) return;
  buffer_.resize(static_cast<std::size_t>(found->bytes));
  if (buffer_.size() != sizeof(Header)) {
    MPI_Imrecv(buffer_.data(), found->bytes, MPI_CHAR, &found->handle, &request_);
    state_ = State::whole;
    return;
  }
  MPI_Mrecv(buffer_.data(), found->bytes, MPI_CHAR, &found->handle, MPI_STATUS_IGNORE);
  header_ = checked_header_of_long_message(buffer_.data(), expected_, who_);
  if (!slots.empty()) refuse_unless_due(header_.bytes, slots, who_, describe(expected_));
  if (header_.bytes == 0) {
    state_ = State::here;
    return;
  }
  MPI_Send(nullptr, 0, MPI_CHAR, rank_, k_tag_request, intercomm_);  // empty: goes at once
  state_ = State::asked;
}

void Incoming::take_whole() {
  header_ = checked_header(buffer_.data(), buffer_.size(), expected_, who_);
  if (!slots.empty()) scatter(content(), content_size(), slots, who_, describe(expected_));
  state_ = State::here;
}

void Incoming::begin_piece() {
  auto found = probe(rank_, k_tag_rest, intercomm_);
  if (!found) return;
  const auto bytes = static_cast<std::uint64_t>(found->bytes);
  const std::uint64_t due = slots.empty() ? header_.bytes : slots[piece_].bytes;
  if (bytes != due)
    throw CouplingError(who_ + " sent " + (bytes < due ? "a truncated" : "an oversized") + " message (" +
                        name(header_.kind) + "): it announces " + std::to_string(due) + " bytes and holds " +
                        std::to_string(bytes));
  char* at = nullptr;
  if (slots.empty()) {
    buffer_.resize(sizeof(Header) + bytes);
    at = buffer_.data() + sizeof(Header);
  } else {
    at = slots[piece_].at;
  }
  MPI_Imrecv(at, found->bytes, MPI_CHAR, &found->handle, &request_);
  state_ = State::piece;
}

bool Incoming::settled() {
  if (!moving()) return true;
  int yes = 0;
  MPI_Test(&request_, &yes, MPI_STATUS_IGNORE);
  if (yes) state_ = State::here;
  return yes != 0;
}

}  // namespace littoral::coupler
