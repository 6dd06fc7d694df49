#pragma once

#include <memory>
#include <string>

#include "meeting.hpp"

namespace littoral::coupler {

/// What the two MPI partners answer alike. `Partner`: FvPartner or SphPartner
template <class Partner>
class MpiPartner : public Partner {
 public:
  Agreement agree(const Proposal& mine) override {
    donor_pass_ = sample_pass_ = 0;
    return meeting_.agree(mine);
  }
  Ledger exchange(const Window& window, const Ledger& mine) override {
    return meeting_.exchange(window, mine);
  }
  void goodbye(const std::string& reason) override { meeting_.goodbye(reason); }
  double waited() const override { return meeting_.channel().waited(); }
  std::string description() const override { return meeting_.description(); }

 protected:
  MpiPartner(Role role, MPI_Comm program, MPI_Comm intercomm, const std::string& partner, const RunPlan& plan,
             std::shared_ptr<Standing> standing)
      : meeting_(role, program, intercomm, partner, plan, std::move(standing)), with_phi_(plan.with_phi) {}

  Expected next_donors(const Window& window) {
    Expected what = meeting_.expected(Kind::donors, window, window.t_begin);
    what.pass = donor_pass_++;
    return what;
  }
  Expected next_samples(const Window& window) {
    Expected what = meeting_.expected(Kind::samples, window, window.t_end);
    what.pass = sample_pass_++;
    return what;
  }
  /// The same message from each of `ranks`, into in_.
  void receive_whole(const std::vector<int>& ranks, const Expected& what) {
    meeting_.channel().receive(ranks, std::vector<Expected>(ranks.size(), what), in_);
  }

  Meeting meeting_;
  bool with_phi_;
  std::vector<Incoming> in_;  // messages without slots
  std::vector<Bytes> out_;
  std::vector<Expected> expected_;

 private:
  std::uint32_t donor_pass_ = 0, sample_pass_ = 0;  // of the window
};

}  // namespace littoral::coupler
