#pragma once

#include <mpi.h>

#include <optional>
#include <string>
#include <vector>

#include "incoming.hpp"
#include "outbox.hpp"
#include "wire.hpp"

namespace littoral::coupler {

/// The partner's ranks, as one rank of this program reaches them. Every wait is polite, watches for notices
/// of the partner (goodbye, leaving, abort), and ends at the deadline with an error that says what was
/// awaited of whom.
class Channel {
 public:
  Channel(MPI_Comm intercomm, std::string partner, double deadline);

  const std::string& partner() const { return partner_; }
  std::string who(int rank) const { return partner_ + " rank " + std::to_string(rank); }
  int size() const { return size_; }
  double deadline() const { return deadline_; }

  /// Starts a message; its bytes must stay until complete_sends(). It moves on in every wait of this channel,
  /// so two ranks may both send before they receive.
  void start_send(int rank, const Bytes& message);
  void start_send(int rank, const Outgoing& outgoing);
  /// Large messages move only while the sender looks after them: nobody computes with a send under way.
  void complete_sends(const Expected& what);

  /// One message from each of `ranks`, headers checked; messages[i]: of ranks[i], into its slots if it has
  /// any.
  void receive(const std::vector<int>& ranks, const std::vector<Expected>& expected,
               std::vector<Incoming>& messages);
  /// One message from one rank; payload begins after the header.
  Header receive(int rank, const Expected& expected, Bytes& buffer);

  /// Waits for the partner's goodbye or, where the coupling never began, for its leaving.
  Notice await_goodbye();
  Notice await_farewell();
  /// throws CouplingError if a message lies unread: somebody sent what nobody awaits.
  void expect_silence() const;

  double waited() const { return waited_; }

 private:
  struct Wait;
  void look_for_notice();
  /// Before an error leaves: gives MPI a second to let go of the memory of what is under way.
  void settle(Incoming* messages = nullptr, std::size_t n = 0);
  void refuse_too_long(int rank, std::size_t bytes) const;
  [[noreturn]] void give_up(const std::string& awaited, const std::vector<int>& silent, double seconds) const;

  MPI_Comm intercomm_;
  std::string partner_;
  double deadline_;
  int size_ = 0;
  double waited_ = 0.0;
  Outbox outbox_;
  std::optional<Notice> farewell_;  // goodbye or leaving, seen while waiting for something else
  std::optional<Notice> abort_;
};

/// Tells all ranks of the partner; best effort, never throws, at most a second.
void send_notice(MPI_Comm intercomm, const Notice& notice);

}  // namespace littoral::coupler
