#pragma once

#include <mpi.h>

#include <memory>
#include <string>
#include <vector>

#include "channel.hpp"
#include "littoral/coupler/partner.hpp"
#include "payload.hpp"
#include "program.hpp"

namespace littoral::coupler {

/// Whether this program has begun to couple and has said goodbye: decides how it may end.
struct Standing {
  bool coupled = false;
  bool said_goodbye = false;
};

/// What both MPI partners do alike: programs meet through their roots; what the roots learn all ranks learn.
class Meeting {
 public:
  /// comm: collective over the program (duplicates its communicator, so that nothing mixes with the solver's
  /// messages)
  Meeting(Role role, MPI_Comm program, MPI_Comm intercomm, const std::string& partner, const RunPlan& plan,
          std::shared_ptr<Standing> standing);
  ~Meeting();
  Meeting(const Meeting&) = delete;
  Meeting& operator=(const Meeting&) = delete;

  Channel& channel() { return channel_; }
  const Channel& channel() const { return channel_; }
  std::int64_t epoch() const { return epoch_; }
  std::string description() const;

  /// A new epoch: every rank's boxes to every rank of the partner. Returns the partner's, by rank.
  std::vector<RankBoxes> meet(const RankBoxes& mine);
  Agreement agree(const Proposal& mine);
  Ledger exchange(const Window& window, const Ledger& mine);
  void goodbye(const std::string& reason);

  /// Sum over the program.
  double sum(double value) const;

  /// What a message of the window, or of the epoch, has in its header.
  Expected expected(Kind kind, const Window& window, double time) const;
  Expected expected_of_epoch(Kind kind) const;

 private:
  bool is_root() const { return rank_ == 0; }
  double patience_at_home() const;
  void share(Bytes& bytes, const char* what);  // from the root to the program's ranks
  /// The roots swap a message; `bytes` becomes the partner's. Only the root calls it.
  Header swap(Bytes& bytes, const Expected& what, std::uint64_t count);

  Role role_;
  MPI_Comm program_ = MPI_COMM_NULL;
  MPI_Comm intercomm_;
  int rank_ = 0, size_ = 1;
  Channel channel_;
  Sequence sequence_;
  std::shared_ptr<Standing> standing_;
  std::int64_t epoch_ = 0;
  Bytes out_, in_;
};

}  // namespace littoral::coupler
