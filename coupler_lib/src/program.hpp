#pragma once

#include <mpi.h>

#include "littoral/coupler/fields.hpp"
#include "littoral/coupler/partner.hpp"
#include "littoral/coupler/window.hpp"

namespace littoral::coupler {

/// Joins what the ranks of one program propose: the shortest step (NaN wins), flags by "any", reasons of the
/// lowest rank that has one. comm: collective
Proposal join(const Proposal& mine, MPI_Comm program);

/// Sum over the ranks of one program. comm: collective
Ledger sum(const Ledger& mine, MPI_Comm program);

/// Where a program stands in the sequence of windows, and the rule by which it goes on.
class Sequence {
 public:
  explicit Sequence(const RunPlan& plan) : plan_(plan), index_(plan.start_window), time_(plan.start_time) {}
  std::int64_t index() const { return index_; }
  double time() const { return time_; }
  /// A proposal of this program, with the plan's limit of windows put in.
  Proposal limited(Proposal mine) const;
  /// Agrees on the next window and moves behind it.
  Agreement advance(const Proposal& sph, const Proposal& fv);
  /// Moves behind a window agreed on elsewhere.
  void follow(const Agreement& agreement);

 private:
  RunPlan plan_;
  std::int64_t index_;
  double time_;
};

}  // namespace littoral::coupler
