#include "channel.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "littoral/error.hpp"
#include "patience.hpp"
#include "probe.hpp"
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
  auto found = probe(MPI_ANY_SOURCE, k_tag_notice, intercomm_);
  if (!found) return;
  Bytes message(static_cast<std::size_t>(found->bytes));
  MPI_Mrecv(message.data(), found->bytes, MPI_CHAR, &found->handle, MPI_STATUS_IGNORE);
  const Notice notice = unpack_notice(message.data(), message.size(), who(found->rank));
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

void Channel::refuse_too_long(int rank, std::size_t bytes) const {
  if (bytes > static_cast<std::size_t>(std::numeric_limits<int>::max()))
    throw CouplingError("a message of " + std::to_string(bytes) + " bytes to " + who(rank) +
                        " exceeds what MPI can count; use more ranks");
}

void Channel::start_send(int rank, const Bytes& message) {
  refuse_too_long(rank, message.size());
  outbox_.start(rank, message);
}

void Channel::start_send(int rank, const Outgoing& outgoing) {
  refuse_too_long(rank, outgoing.size());
  outbox_.start(rank, outgoing.message, outgoing.columns);
}

void Channel::complete_sends(const Expected& what) {
  if (outbox_.empty()) return;
  Wait wait(*this);
  try {
    while (!outbox_.progress()) {
      if (outbox_.moving() && !wait.patience.expired()) continue;  // bytes are moving: they need us
      if (!wait.go_on()) give_up("its reception of " + describe(what), outbox_.ranks(), deadline_);
    }
  } catch (const CouplingError&) {
    settle();
    throw;
  }
}

void Channel::settle(Incoming* messages, std::size_t n) {
  Patience patience(1.0);  // no memory may go away while MPI still writes into it, or reads from it
  for (;;) {
    bool all = outbox_.settled();
    for (std::size_t i = 0; i < n; ++i) all = messages[i].settled() && all;
    if (all || patience.expired()) return;
    patience.pause();
  }
}

void Channel::receive(const std::vector<int>& ranks, const std::vector<Expected>& expected,
                      std::vector<Incoming>& messages) {
  const std::size_t n = ranks.size();
  if (messages.size() < n) messages.resize(n);
  if (n == 0) return;
  for (std::size_t i = 0; i < n; ++i) messages[i].expect(intercomm_, ranks[i], expected[i], who(ranks[i]));
  const auto begin = messages.begin(), end = begin + static_cast<std::ptrdiff_t>(n);
  Wait wait(*this);
  try {
    for (;;) {
      outbox_.progress();  // the partner may be waiting for our message before it looks after its own
      bool all = true;
      for (auto m = begin; m != end; ++m) all = (m->here() || m->progress()) && all;
      if (all) break;
      const bool arriving = std::any_of(begin, end, [](const Incoming& m) { return m.moving(); });
      // bytes are moving: they need us
      if ((arriving || outbox_.moving()) && !wait.patience.expired()) continue;
      if (wait.go_on()) continue;
      std::vector<int> silent;
      for (std::size_t i = 0; i < n; ++i)
        if (!messages[i].here()) silent.push_back(ranks[i]);
      const auto first = std::find(ranks.begin(), ranks.end(), silent.front()) - ranks.begin();
      give_up(describe(expected[static_cast<std::size_t>(first)]), silent, deadline_);
    }
  } catch (const CouplingError&) {
    settle(messages.data(), n);
    throw;
  }
}

Header Channel::receive(int rank, const Expected& expected, Bytes& buffer) {
  std::vector<Incoming> messages(1);
  messages[0].buffer().swap(buffer);
  receive({rank}, {expected}, messages);
  buffer.swap(messages[0].buffer());
  return messages[0].header();
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
