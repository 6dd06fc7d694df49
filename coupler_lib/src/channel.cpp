#include "channel.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "littoral/error.hpp"
#include "patience.hpp"
#include "validate.hpp"

namespace littoral::coupler {

namespace {

// A partner that has left may still have messages on their way to us, from other ranks than the one that said
// so.
constexpr double k_after_farewell = 2.0;  // [s]

}  // namespace

/// One wait: counts its time as waiting, pauses, ends at the deadline or soon after the partner's farewell.
struct Channel::Wait {
  Channel& channel;
  Patience patience;
  double farewell_at = std::numeric_limits<double>::infinity();

  explicit Wait(Channel& c) : channel(c), patience(c.deadline_) {}
  ~Wait() { channel.waited_ += patience.elapsed(); }
  Wait(const Wait&) = delete;
  Wait& operator=(const Wait&) = delete;

  /// Between two looks at what is awaited; false: give up.
  bool go_on() {
    if (channel.abort_) throw CouplingError(channel.partner_ + " aborts the job: " + channel.abort_->reason);
    channel.look_for_notice();
    if (channel.abort_) return true;  // what was sent before it may be here by now: look once more
    if (channel.farewell_) {
      farewell_at = std::min(farewell_at, patience.elapsed());
      if (patience.elapsed() > farewell_at + k_after_farewell) return false;
    }
    if (patience.expired()) return false;
    patience.pause();
    return true;
  }
};

Channel::Channel(MPI_Comm intercomm, std::string partner, double deadline)
    : intercomm_(intercomm), partner_(std::move(partner)), deadline_(deadline), outbox_(intercomm) {
  MPI_Comm_remote_size(intercomm, &size_);
}

void Channel::look_for_notice() {
  int here = 0;
  MPI_Message handle;
  MPI_Status status;
  MPI_Improbe(MPI_ANY_SOURCE, k_tag_notice, intercomm_, &here, &handle, &status);
  if (!here) return;
  int count = 0;
  MPI_Get_count(&status, MPI_CHAR, &count);
  Bytes message(static_cast<std::size_t>(count));
  MPI_Mrecv(message.data(), count, MPI_CHAR, &handle, &status);
  const Notice notice = unpack_notice(message.data(), message.size(), who(status.MPI_SOURCE));
  (notice.kind == Kind::abort ? abort_ : farewell_) = notice;
}

void Channel::give_up(const std::string& awaited, const std::vector<int>& silent, double seconds) const {
  if (farewell_) {
    const std::string left = farewell_->kind == Kind::goodbye ? " said goodbye" : " left";
    throw CouplingError(partner_ + left + " (" + farewell_->reason + "); still awaited: " + awaited);
  }
  std::string ranks;
  for (const int rank : silent) ranks += (ranks.empty() ? "" : ", ") + std::to_string(rank);
  throw CouplingError(partner_ + " is late: " + awaited + " did not come within " + text_of(seconds) +
                      " s (awaited of its rank " + ranks + "). If it needs longer, raise coupling.deadline");
}

void Channel::start_send(int rank, const Bytes& message) {
  if (message.size() > static_cast<std::size_t>(std::numeric_limits<int>::max()))
    throw CouplingError("a message of " + std::to_string(message.size()) + " bytes to " + who(rank) +
                        " exceeds what MPI can count; use more ranks");
  outbox_.start(rank, message);
}

void Channel::complete_sends(const Expected& what) {
  if (outbox_.empty()) return;
  Wait wait(*this);
  while (!outbox_.progress()) {
    if (outbox_.moving() && !wait.patience.expired()) continue;  // bytes are moving: they need us
    if (!wait.go_on()) give_up("its reception of " + describe(what), outbox_.ranks(), deadline_);
  }
}

/// A message or the header of a long one has come: checks it, takes it or asks for the rest.
void Channel::begin_reception(std::size_t i, int rank, const Expected& expected, Bytes& buffer,
                              Header& header) {
  int yes = 0;
  MPI_Message handle;
  MPI_Status status;
  MPI_Improbe(rank, k_tag_message, intercomm_, &yes, &handle, &status);
  if (!yes) return;
  int count = 0;
  MPI_Get_count(&status, MPI_CHAR, &count);
  buffer.resize(static_cast<std::size_t>(count));
  if (buffer.size() != sizeof(Header)) {
    MPI_Imrecv(buffer.data(), count, MPI_CHAR, &handle, &receives_[i]);
    progress_[i] = Progress::arriving;
    return;
  }
  MPI_Mrecv(buffer.data(), count, MPI_CHAR, &handle, &status);
  header = checked_header_of_long_message(buffer.data(), expected, who(rank));
  if (header.bytes == 0) {
    progress_[i] = Progress::here;
    return;
  }
  MPI_Send(nullptr, 0, MPI_CHAR, rank, k_tag_request, intercomm_);  // empty: goes at once
  progress_[i] = Progress::asked;
}

/// The rest of a long message has come.
void Channel::begin_rest(std::size_t i, int rank, const Header& header, Bytes& buffer) {
  int yes = 0;
  MPI_Message handle;
  MPI_Status status;
  MPI_Improbe(rank, k_tag_rest, intercomm_, &yes, &handle, &status);
  if (!yes) return;
  int count = 0;
  MPI_Get_count(&status, MPI_CHAR, &count);
  if (static_cast<std::uint64_t>(count) != header.bytes)
    throw CouplingError(who(rank) + " sent " +
                        (static_cast<std::uint64_t>(count) < header.bytes ? "a truncated" : "an oversized") +
                        " message (" + name(header.kind) + "): it announces " + std::to_string(header.bytes) +
                        " bytes and holds " + std::to_string(count));
  buffer.resize(sizeof(Header) + static_cast<std::size_t>(count));
  MPI_Imrecv(buffer.data() + sizeof(Header), count, MPI_CHAR, &handle, &receives_[i]);
  progress_[i] = Progress::arriving;
}

/// Moves message i as far as it goes now; true when it is here.
bool Channel::advance(std::size_t i, int rank, const Expected& expected, Bytes& buffer, Header& header) {
  if (progress_[i] == Progress::awaited) begin_reception(i, rank, expected, buffer, header);
  if (progress_[i] == Progress::asked) begin_rest(i, rank, header, buffer);
  if (progress_[i] == Progress::arriving) {
    int yes = 0;
    MPI_Test(&receives_[i], &yes, MPI_STATUS_IGNORE);
    if (!yes) return false;
    progress_[i] = Progress::here;
    header = checked_header(buffer.data(), buffer.size(), expected, who(rank));
  }
  return progress_[i] == Progress::here;
}

/// Before an error leaves: no buffer may go away while MPI still writes into it.
void Channel::settle_receives() {
  Patience patience(1.0);
  for (int done = 0; !done && !patience.expired(); patience.pause())
    MPI_Testall(static_cast<int>(receives_.size()), receives_.data(), &done, MPI_STATUSES_IGNORE);
}

void Channel::receive(const std::vector<int>& ranks, const std::vector<Expected>& expected,
                      std::vector<Bytes>& buffers, std::vector<Header>& headers) {
  const std::size_t n = ranks.size();
  buffers.resize(std::max(buffers.size(), n));
  headers.resize(n);
  if (n == 0) return;
  receives_.assign(n, MPI_REQUEST_NULL);
  progress_.assign(n, Progress::awaited);
  Wait wait(*this);
  try {
    for (std::size_t missing = n; missing > 0;) {
      outbox_.progress();  // the partner may be waiting for our message before it looks after its own
      for (std::size_t i = 0; i < n; ++i)
        if (progress_[i] != Progress::here && advance(i, ranks[i], expected[i], buffers[i], headers[i]))
          --missing;
      if (missing == 0) break;
      const bool arriving =
          std::find(progress_.begin(), progress_.end(), Progress::arriving) != progress_.end();
      // bytes are moving: they need us
      if ((arriving || outbox_.moving()) && !wait.patience.expired()) continue;
      if (wait.go_on()) continue;
      std::vector<int> silent;
      for (std::size_t i = 0; i < n; ++i)
        if (progress_[i] != Progress::here) silent.push_back(ranks[i]);
      const auto first = std::find(ranks.begin(), ranks.end(), silent.front()) - ranks.begin();
      give_up(describe(expected[static_cast<std::size_t>(first)]), silent, deadline_);
    }
  } catch (const CouplingError&) {
    settle_receives();
    throw;
  }
}

Header Channel::receive(int rank, const Expected& expected, Bytes& buffer) {
  std::vector<Bytes> buffers(1);
  std::vector<Header> headers;
  buffers[0].swap(buffer);
  receive(std::vector<int>{rank}, {expected}, buffers, headers);
  buffer.swap(buffers[0]);
  return headers[0];
}

Notice Channel::await_farewell() {
  Wait wait(*this);
  for (;;) {
    outbox_.progress();
    look_for_notice();
    if (farewell_) return *farewell_;
    if (!wait.go_on()) give_up("its goodbye", {0}, deadline_);
  }
}

Notice Channel::await_goodbye() {
  const Notice notice = await_farewell();
  if (notice.kind != Kind::goodbye)
    throw CouplingError(partner_ + " left (" + notice.reason + ") where its goodbye was awaited");
  return notice;
}

void Channel::expect_silence() const {
  int here = 0;
  MPI_Status status;
  MPI_Iprobe(MPI_ANY_SOURCE, k_tag_message, intercomm_, &here, &status);
  if (here) throw CouplingError(who(status.MPI_SOURCE) + " sent a message that nobody awaited");
}

void send_notice(MPI_Comm intercomm, const Notice& notice) {
  if (intercomm == MPI_COMM_NULL) return;
  int size = 0;
  MPI_Comm_remote_size(intercomm, &size);
  const Bytes message = pack(notice);
  std::vector<MPI_Request> requests(static_cast<std::size_t>(size));
  for (int rank = 0; rank < size; ++rank)
    MPI_Isend(message.data(), static_cast<int>(message.size()), MPI_CHAR, rank, k_tag_notice, intercomm,
              &requests[static_cast<std::size_t>(rank)]);
  Patience patience(1.0);
  for (int done = 0; !done && !patience.expired(); patience.pause())
    MPI_Testall(size, requests.data(), &done, MPI_STATUSES_IGNORE);
}

}  // namespace littoral::coupler
