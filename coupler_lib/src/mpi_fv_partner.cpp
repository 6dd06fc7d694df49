#include <algorithm>
#include <utility>

#include "littoral/error.hpp"
#include "mpi_partner.hpp"
#include "mpi_partners.hpp"
#include "validate.hpp"

namespace littoral::coupler {

namespace {

/// A rank of the partner with which something is exchanged, and where its part lies in our arrays.
struct Contact {
  std::size_t first = 0, n = 0;
};

class MpiFvPartner final : public MpiPartner<FvPartner> {
 public:
  MpiFvPartner(MPI_Comm program, MPI_Comm intercomm, const std::string& partner, const RunPlan& plan,
               std::shared_ptr<Standing> standing)
      : MpiPartner(Role::sph, program, intercomm, partner, plan, std::move(standing)) {}

  void announce(const Box& needs, const Box& covers) override {
    const auto theirs = meeting_.meet({needs, covers});
    std::vector<int> donor_ranks, target_ranks;
    grids_.clear();
    for (int rank = 0; rank < static_cast<int>(theirs.size()); ++rank) {
      const auto& boxes = theirs[static_cast<std::size_t>(rank)];
      if (needs.meets(boxes.donors)) donor_ranks.push_back(rank);
      if (covers.meets(boxes.targets)) target_ranks.push_back(rank);
      if (covers.meets(boxes.donors)) grids_.push_back({rank, boxes.donors});
    }
    receive_geometry(donor_ranks);
    receive_targets(target_ranks);

    const double donors = meeting_.sum(static_cast<double>(geometry_.size()));
    const double wanting = meeting_.sum(needs.empty() ? 0.0 : 1.0);
    if (wanting > 0.0 && donors == 0.0)
      throw CouplingError(
          meeting_.channel().partner() +
          " offers no donor cell (zero points) where the layers of this program need them: does its "
          "grid cover the region and its layers?");
  }
  const DonorGeometry& donor_geometry() const override { return geometry_; }
  const Targets& targets() const override { return targets_; }

  void receive(const Window& window, DonorValues& donors) override {
    Expected what = next_donors(window);
    expected_.clear();
    for (const auto& contact : donor_contacts_) {
      what.count = contact.n;
      expected_.push_back(what);
    }
    donors.resize(geometry_.size(), with_phi_);
    donors.time = donors.horizon_begin = window.t_begin;
    donors.horizon_end = window.t_end;
    donors_in_.resize(donor_ranks_.size());
    preludes_.resize(donor_ranks_.size());
    for (std::size_t i = 0; i < donor_ranks_.size(); ++i)
      place_donors(donors_in_[i].slots, preludes_[i], donors, donor_contacts_[i].first, donor_contacts_[i].n);
    auto& channel = meeting_.channel();
    channel.receive(donor_ranks_, expected_, donors_in_);
    for (std::size_t i = 0; i < donor_ranks_.size(); ++i) {
      const double time = donors.time, begin = donors.horizon_begin, end = donors.horizon_end;
      const std::string who = channel.who(donor_ranks_[i]);
      accept_donors(donors_in_[i].slots, preludes_[i], who, usable_.data() + donor_contacts_[i].first,
                    donors);
      if (i > 0 && (donors.time != time || donors.horizon_begin != begin || donors.horizon_end != end))
        throw CouplingError(who + " sent donors with another time or horizon than the ranks before it");
      validate_horizon(donors, window, who);
    }
  }

  void send(const Window& window, const Samples& samples) override {
    Expected what = next_samples(window);
    check_own(samples);
    auto& channel = meeting_.channel();
    samples_out_.resize(target_ranks_.size());
    for (std::size_t i = 0; i < target_ranks_.size(); ++i) {
      const auto& contact = target_contacts_[i];
      pack(samples_out_[i], samples, contact.first, contact.n);
      seal(samples_out_[i], what, contact.n);
      channel.start_send(target_ranks_[i], samples_out_[i]);
    }
    channel.complete_sends(what);
  }

  void send_particles(const Window& window, const ParticleStates& states) override {
    const Expected what = meeting_.expected(Kind::particles, window, window.t_end);
    auto& channel = meeting_.channel();
    out_.resize(std::max(out_.size(), grids_.size()));
    for (std::size_t i = 0; i < grids_.size(); ++i) {
      const std::size_t n = pack(out_[i], states, grids_[i].second);
      seal(out_[i], what, n);
      channel.start_send(grids_[i].first, out_[i]);
    }
    channel.complete_sends(what);
  }

 private:
  /// Ranks that answer with nothing are no contacts.
  void receive_geometry(const std::vector<int>& ranks) {
    auto& channel = meeting_.channel();
    receive_whole(ranks, meeting_.expected_of_epoch(Kind::geometry));
    geometry_ = DonorGeometry{};
    geometry_.epoch = meeting_.epoch();
    usable_.clear();
    donor_ranks_.clear();
    donor_contacts_.clear();
    for (std::size_t i = 0; i < ranks.size(); ++i) {
      auto part = unpack_geometry(in_[i].content(), in_[i].content_size(), channel.who(ranks[i]));
      if (part.size() == 0) continue;
      donor_ranks_.push_back(ranks[i]);
      donor_contacts_.push_back({usable_.size(), part.size()});
      for (auto& patch : part.patches) {
        usable_.insert(usable_.end(), patch.usable.begin(), patch.usable.end());
        geometry_.patches.push_back(std::move(patch));
      }
    }
  }

  void receive_targets(const std::vector<int>& ranks) {
    auto& channel = meeting_.channel();
    receive_whole(ranks, meeting_.expected_of_epoch(Kind::targets));
    targets_ = Targets{};
    targets_.epoch = meeting_.epoch();
    target_ranks_.clear();
    target_contacts_.clear();
    for (std::size_t i = 0; i < ranks.size(); ++i) {
      const auto part = unpack_targets(in_[i].content(), in_[i].content_size(), channel.who(ranks[i]));
      if (part.size() == 0) continue;
      target_ranks_.push_back(ranks[i]);
      target_contacts_.push_back({targets_.size(), part.size()});
      const auto append = [](auto& to, const auto& from) { to.insert(to.end(), from.begin(), from.end()); };
      append(targets_.x, part.x);
      append(targets_.y, part.y);
      append(targets_.z, part.z);
      append(targets_.wants, part.wants);
    }
  }

  void check_own(const Samples& samples) const {
    const std::size_t n = targets_.size();
    for (const auto* column : {&samples.p, &samples.u, &samples.v, &samples.w, &samples.coverage})
      if (column->size() != n) refuse_own(column->size(), n);
    if (samples.status.size() != n) refuse_own(samples.status.size(), n);
    if (samples.phi.size() != (with_phi_ ? n : 0)) refuse_own(samples.phi.size(), with_phi_ ? n : 0);
  }
  [[noreturn]] static void refuse_own(std::size_t found, std::size_t due) {
    throw CouplingError("samples of " + std::to_string(found) +
                        " points are to be sent where the partner asked for " + std::to_string(due));
  }

  DonorGeometry geometry_;
  Targets targets_;
  std::vector<std::uint8_t> usable_;  // of all donors
  std::vector<int> donor_ranks_, target_ranks_;
  std::vector<Contact> donor_contacts_, target_contacts_;
  std::vector<std::pair<int, Box>> grids_;  // ranks that get our particles, and where they want them
  std::vector<Incoming> donors_in_;
  std::vector<DonorPrelude> preludes_;
  std::vector<Outgoing> samples_out_;
};

}  // namespace

std::unique_ptr<FvPartner> mpi_fv_partner(MPI_Comm program, MPI_Comm intercomm, const std::string& partner,
                                          const RunPlan& plan, std::shared_ptr<Standing> standing) {
  return std::make_unique<MpiFvPartner>(program, intercomm, partner, plan, std::move(standing));
}

}  // namespace littoral::coupler
