#include "program.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace littoral::coupler {

Proposal join(const Proposal& mine, MPI_Comm program) {
  int size = 1, rank = 0;
  if (program != MPI_COMM_SELF) {  // alone, also where MPI was never started
    MPI_Comm_size(program, &size);
    MPI_Comm_rank(program, &rank);
  }
  if (size == 1) return mine;
  constexpr double k_inf = std::numeric_limits<double>::infinity();
  const auto flag = [](bool on) { return on ? 0.0 : 1.0; };  // the smallest wins: "any"
  const bool lost = std::isnan(mine.dt_stable);
  const double speaker = mine.stop && !mine.reason.empty() ? rank : size;
  std::array<double, 8> values{lost ? -k_inf : mine.dt_stable, flag(lost),      flag(mine.write),
                               flag(mine.checkpoint),          flag(mine.stop), flag(mine.region_changed),
                               flag(mine.wants_particles),     speaker};
  MPI_Allreduce(MPI_IN_PLACE, values.data(), static_cast<int>(values.size()), MPI_DOUBLE, MPI_MIN, program);
  Proposal all;
  all.dt_stable = values[1] == 0.0 ? std::nan("") : values[0];
  all.write = values[2] == 0.0;
  all.checkpoint = values[3] == 0.0;
  all.stop = values[4] == 0.0;
  all.region_changed = values[5] == 0.0;
  all.wants_particles = values[6] == 0.0;
  const int root = static_cast<int>(values[7]);
  if (root < size) {
    int length = static_cast<int>(mine.reason.size());
    MPI_Bcast(&length, 1, MPI_INT, root, program);
    all.reason = rank == root ? mine.reason : std::string(static_cast<std::size_t>(length), ' ');
    MPI_Bcast(all.reason.data(), length, MPI_CHAR, root, program);
  }
  return all;
}

Ledger sum(const Ledger& mine, MPI_Comm program) {
  if (program == MPI_COMM_SELF) return mine;
  constexpr std::array<double Ledger::*, 9> members{
      &Ledger::mass_inside,  &Ledger::mass_on_faces, &Ledger::mass_injected,
      &Ledger::mass_removed, &Ledger::mass_flux,     &Ledger::fv_mass_flux,
      &Ledger::n_injected,   &Ledger::n_removed,     &Ledger::defect};
  std::array<double, members.size()> values;
  for (std::size_t i = 0; i < members.size(); ++i) values[i] = mine.*members[i];
  MPI_Allreduce(MPI_IN_PLACE, values.data(), static_cast<int>(values.size()), MPI_DOUBLE, MPI_SUM, program);
  Ledger all;
  for (std::size_t i = 0; i < members.size(); ++i) all.*members[i] = values[i];
  return all;
}

Proposal Sequence::limited(Proposal mine) const {
  if (!mine.stop && plan_.max_windows >= 0 && index_ >= plan_.start_window + plan_.max_windows) {
    mine.stop = true;
    mine.reason = "the number of windows asked for is reached";
  }
  return mine;
}

Agreement Sequence::advance(const Proposal& sph, const Proposal& fv) {
  const Agreement agreement = agree(sph, fv, plan_.window, index_, time_, plan_.end_time);
  follow(agreement);
  return agreement;
}

void Sequence::follow(const Agreement& agreement) {
  if (agreement.stop) return;
  index_ = agreement.window.index + 1;
  time_ = agreement.window.t_end;
}

}  // namespace littoral::coupler
