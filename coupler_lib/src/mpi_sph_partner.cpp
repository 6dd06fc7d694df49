#include <algorithm>
#include <utility>

#include "clip.hpp"
#include "littoral/error.hpp"
#include "mpi_partner.hpp"
#include "mpi_partners.hpp"
#include "validate.hpp"

namespace littoral::coupler {

namespace {

class MpiSphPartner final : public MpiPartner<SphPartner> {
 public:
  MpiSphPartner(MPI_Comm program, MPI_Comm intercomm, const std::string& partner, const RunPlan& plan,
                std::shared_ptr<Standing> standing)
      : MpiPartner(Role::fv, program, intercomm, partner, plan, std::move(standing)) {}

  void offer(const DonorGeometry& donors, const Targets& targets) override {
    validate(donors, "this program");
    validate(targets, "this program");
    n_donors_ = donors.size();
    n_targets_ = targets.size();
    const RankBoxes mine{reach(donors), around(targets)};
    const auto theirs = meeting_.meet(mine);
    send_geometry(donors, mine.donors, theirs);
    send_targets(targets, mine.targets, theirs);
    particle_ranks_.clear();
    for (int rank = 0; rank < static_cast<int>(theirs.size()); ++rank)
      if (theirs[static_cast<std::size_t>(rank)].targets.meets(mine.donors)) particle_ranks_.push_back(rank);
  }

  void send(const Window& window, const DonorValues& donors) override {
    check_own(donors);
    Expected what = next_donors(window);
    auto& channel = meeting_.channel();
    donors_out_.resize(donor_ranks_.size());
    for (std::size_t i = 0; i < donor_ranks_.size(); ++i) {
      pack(donors_out_[i], donors, runs_[i], with_phi_);
      seal(donors_out_[i], what, donor_counts_[i]);
      channel.start_send(donor_ranks_[i], donors_out_[i]);
    }
    channel.complete_sends(what);
  }

  void receive(const Window& window, Samples& samples) override {
    Expected what = next_samples(window);
    expected_.clear();
    for (const auto& chosen : chosen_) {
      what.count = chosen.size();
      expected_.push_back(what);
    }
    samples.resize(n_targets_, with_phi_);
    samples.time = window.t_end;
    auto& channel = meeting_.channel();
    const std::size_t n = target_ranks_.size();
    const bool one_answers_all = n == 1 && chosen_[0].size() == n_targets_;
    samples_in_.resize(n);
    answers_.resize(n);
    with_phi_in_.resize(n);
    const auto answers = [&](std::size_t i) -> Samples& { return one_answers_all ? samples : answers_[i]; };
    for (std::size_t i = 0; i < n; ++i) {
      answers(i).resize(chosen_[i].size(), with_phi_);
      place_samples(samples_in_[i].slots, with_phi_in_[i], answers(i));
    }
    channel.receive(target_ranks_, expected_, samples_in_);
    for (std::size_t i = 0; i < n; ++i)
      accept_samples(samples_in_[i].slots, with_phi_in_[i], channel.who(target_ranks_[i]), answers(i));
    if (!one_answers_all) {
      std::fill(samples.status.begin(), samples.status.end(), SampleStatus::uncovered);
      std::fill(samples.coverage.begin(), samples.coverage.end(), 0.0);
      for (std::size_t i = 0; i < n; ++i) merge(answers_[i], chosen_[i], samples);
    }
    for (std::size_t i = 0; i < n_targets_; ++i) {  // only what is marked as valid carries a number
      if (samples.status[i] == SampleStatus::ok) continue;
      samples.p[i] = samples.u[i] = samples.v[i] = samples.w[i] = 0.0;
      if (samples.status[i] == SampleStatus::uncovered && with_phi_) samples.phi[i] = 0.0;
    }
  }

  void receive_particles(const Window& window, ParticleStates& states) override {
    const Expected what = meeting_.expected(Kind::particles, window, window.t_end);
    states = ParticleStates{};
    states.time = window.t_end;
    auto& channel = meeting_.channel();
    receive_whole(particle_ranks_, what);
    for (std::size_t i = 0; i < particle_ranks_.size(); ++i)
      unpack(in_[i].content(), in_[i].content_size(), channel.who(particle_ranks_[i]), in_[i].header().count,
             states);
  }

 private:
  void send_geometry(const DonorGeometry& donors, const Box& mine, const std::vector<RankBoxes>& theirs) {
    const Expected what = meeting_.expected_of_epoch(Kind::geometry);
    auto& channel = meeting_.channel();
    donor_ranks_.clear();
    donor_counts_.clear();
    runs_.clear();
    out_.resize(std::max(out_.size(), theirs.size()));
    for (std::size_t rank = 0; rank < theirs.size(); ++rank) {
      if (!theirs[rank].donors.meets(mine)) continue;
      const auto clips = clip(donors, theirs[rank].donors);
      const auto part = clipped(donors, clips);
      pack(out_[rank], part);
      seal(out_[rank], what, part.size());
      channel.start_send(static_cast<int>(rank), out_[rank]);
      if (part.size() == 0)
        continue;  // the box meets, the cells do not: no contact, and the other side sees it
      donor_ranks_.push_back(static_cast<int>(rank));
      donor_counts_.push_back(part.size());
      runs_.push_back(runs(donors, clips));
    }
    channel.complete_sends(what);
  }

  void send_targets(const Targets& targets, const Box& mine, const std::vector<RankBoxes>& theirs) {
    const Expected what = meeting_.expected_of_epoch(Kind::targets);
    auto& channel = meeting_.channel();
    target_ranks_.clear();
    chosen_.clear();
    for (std::size_t rank = 0; rank < theirs.size(); ++rank) {
      if (!theirs[rank].targets.meets(mine)) continue;
      auto chosen = held_by(theirs[rank].targets, targets);
      pack(out_[rank], targets, chosen);
      seal(out_[rank], what, chosen.size());
      channel.start_send(static_cast<int>(rank), out_[rank]);
      if (chosen.empty()) continue;
      target_ranks_.push_back(static_cast<int>(rank));
      chosen_.push_back(std::move(chosen));
    }
    channel.complete_sends(what);
  }

  void check_own(const DonorValues& values) const {
    const auto check = [&](const std::vector<double>& column) {
      if (column.size() != n_donors_)
        throw CouplingError("donor values of " + std::to_string(column.size()) +
                            " cells are to be sent where " + std::to_string(n_donors_) + " were offered");
    };
    for (const auto* column : {&values.p, &values.u, &values.v, &values.w, &values.dp_dt, &values.du_dt,
                               &values.dv_dt, &values.dw_dt})
      check(*column);
    if (with_phi_)
      for (const auto* column : {&values.phi, &values.dphi_dt}) check(*column);
  }

  std::size_t n_donors_ = 0, n_targets_ = 0;
  std::vector<int> donor_ranks_, target_ranks_, particle_ranks_;
  std::vector<std::size_t> donor_counts_;
  std::vector<std::vector<Run>> runs_;            // of the donors each rank needs
  std::vector<std::vector<std::size_t>> chosen_;  // targets each rank answers
  std::vector<Incoming> samples_in_;
  std::vector<Samples> answers_;  // of each rank, where more than one answers
  std::vector<std::uint64_t> with_phi_in_;
  std::vector<Outgoing> donors_out_;
};

}  // namespace

std::unique_ptr<SphPartner> mpi_sph_partner(MPI_Comm program, MPI_Comm intercomm, const std::string& partner,
                                            const RunPlan& plan, std::shared_ptr<Standing> standing) {
  return std::make_unique<MpiSphPartner>(program, intercomm, partner, plan, std::move(standing));
}

}  // namespace littoral::coupler
