#include "meeting.hpp"

#include <sstream>

#include "littoral/error.hpp"
#include "patience.hpp"
#include "validate.hpp"

namespace littoral::coupler {

namespace {

bool same(const Agreement& a, const Agreement& b) {
  return a.window.index == b.window.index && a.window.t_begin == b.window.t_begin &&
         a.window.t_end == b.window.t_end && a.window.substeps == b.window.substeps && a.write == b.write &&
         a.checkpoint == b.checkpoint && a.stop == b.stop && a.region_changed == b.region_changed &&
         a.wants_particles == b.wants_particles;
}

std::string text(const Agreement& a) {
  std::ostringstream out;
  out.precision(17);
  out << "window " << a.window.index << " from " << a.window.t_begin << " to " << a.window.t_end << " s in "
      << a.window.substeps << " substeps" << (a.stop ? ", stop" : "") << (a.write ? ", write" : "")
      << (a.checkpoint ? ", checkpoint" : "") << (a.region_changed ? ", region changed" : "")
      << (a.wants_particles ? ", particles" : "");
  return out.str();
}

const char* payload(const Bytes& message) { return message.data() + sizeof(Header); }
std::size_t payload_size(const Bytes& message) { return message.size() - sizeof(Header); }

}  // namespace

Meeting::Meeting(Role role, MPI_Comm program, MPI_Comm intercomm, const std::string& partner,
                 const RunPlan& plan, std::shared_ptr<Standing> standing)
    : role_(role),
      intercomm_(intercomm),
      channel_(intercomm, partner, plan.deadline),
      sequence_(plan),
      standing_(std::move(standing)) {
  MPI_Comm_dup(program, &program_);
  MPI_Comm_rank(program_, &rank_);
  MPI_Comm_size(program_, &size_);
  standing_->coupled = true;
  standing_->said_goodbye = false;
}

Meeting::~Meeting() {
  int finalized = 0;
  MPI_Finalized(&finalized);
  if (!finalized) MPI_Comm_free(&program_);
}

std::string Meeting::description() const {
  return channel_.partner() + " on " + std::to_string(channel_.size()) +
         (channel_.size() == 1 ? " rank" : " ranks");
}

/// Ranks of this program wait for their root while it waits for the partner: it is the root that should
/// complain.
double Meeting::patience_at_home() const { return 2.0 * channel_.deadline() + 10.0; }

void Meeting::share(Bytes& bytes, const char* what) {
  if (size_ == 1) return;
  std::int64_t count = static_cast<std::int64_t>(bytes.size());
  MPI_Request request;
  MPI_Ibcast(&count, 1, MPI_INT64_T, 0, program_, &request);
  wait_politely(request, patience_at_home(), what);
  bytes.resize(static_cast<std::size_t>(count));
  MPI_Ibcast(bytes.data(), static_cast<int>(count), MPI_CHAR, 0, program_, &request);
  wait_politely(request, patience_at_home(), what);
}

Header Meeting::swap(Bytes& bytes, const Expected& what, std::uint64_t count) {
  seal(bytes, what, count);
  channel_.start_send(0, bytes);
  const Header header = channel_.receive(0, what, in_);
  channel_.complete_sends(what);
  bytes.swap(in_);
  return header;
}

std::vector<RankBoxes> Meeting::meet(const RankBoxes& mine) {
  ++epoch_;
  static_assert(sizeof(RankBoxes) == 12 * sizeof(double));
  std::vector<RankBoxes> ours(static_cast<std::size_t>(size_));
  MPI_Allgather(&mine, 12, MPI_DOUBLE, ours.data(), 12, MPI_DOUBLE, program_);
  if (is_root()) {
    pack(out_, ours);
    swap(out_, expected_of_epoch(Kind::boxes), ours.size());
  }
  share(out_, "the partner's boxes");
  auto theirs = unpack_boxes(payload(out_), payload_size(out_), channel_.partner());
  if (theirs.size() != static_cast<std::size_t>(channel_.size()))
    throw CouplingError(channel_.partner() + " sent boxes of " + std::to_string(theirs.size()) +
                        " ranks and has " + std::to_string(channel_.size()));
  return theirs;
}

Agreement Meeting::agree(const Proposal& mine) {
  const Proposal ours = join(sequence_.limited(mine), program_);
  if (is_root()) {
    Expected what;
    what.kind = Kind::proposal;
    what.window = sequence_.index();
    what.time = sequence_.time();
    pack(out_, ours);
    swap(out_, what, 1);
    const Proposal theirs = unpack_proposal(payload(out_), payload_size(out_), channel_.partner());
    const Agreement agreement =
        role_ == Role::sph ? sequence_.advance(ours, theirs) : sequence_.advance(theirs, ours);
    what.kind = Kind::agreement;
    pack(out_, agreement);
    Bytes confirmed = out_;
    swap(confirmed, what, 1);
    const Agreement other = unpack_agreement(payload(confirmed), payload_size(confirmed), channel_.partner());
    if (!same(agreement, other))
      throw CouplingError("the programs agree on different windows. Here: " + text(agreement) + "; " +
                          channel_.partner() + ": " + text(other));
  }
  share(out_, "the agreement");
  const Agreement agreement = unpack_agreement(payload(out_), payload_size(out_), channel_.partner());
  if (!is_root()) sequence_.follow(agreement);
  return agreement;
}

Ledger Meeting::exchange(const Window& window, const Ledger& mine) {
  const Ledger ours = coupler::sum(mine, program_);
  if (is_root()) {
    Expected what;
    what.kind = Kind::ledger;
    what.window = window.index;
    what.time = window.t_end;
    pack(out_, ours);
    swap(out_, what, 1);
  }
  share(out_, "the partner's ledger");
  const Ledger theirs = unpack_ledger(payload(out_), payload_size(out_), channel_.partner());
  Ledger both = role_ == Role::sph ? ours : theirs;
  both.fv_mass_flux = role_ == Role::fv ? ours.fv_mass_flux : theirs.fv_mass_flux;
  return both;
}

void Meeting::goodbye(const std::string& reason) {
  MPI_Request request;
  MPI_Ibarrier(program_, &request);  // all our ranks have what they awaited
  wait_politely(request, patience_at_home(), "the goodbye");
  if (is_root()) send_notice(intercomm_, {Kind::goodbye, reason});
  channel_.await_goodbye();
  channel_.expect_silence();
  MPI_Ibarrier(program_, &request);
  wait_politely(request, patience_at_home(), "the goodbye");
  standing_->said_goodbye = true;
}

Expected Meeting::expected(Kind kind, const Window& window, double time) const {
  Expected what = expected_of_epoch(kind);
  what.window = window.index;
  what.time = time;
  return what;
}

Expected Meeting::expected_of_epoch(Kind kind) const {
  Expected what;
  what.kind = kind;
  what.epoch = epoch_;
  return what;
}

double Meeting::sum(double value) const {
  MPI_Allreduce(MPI_IN_PLACE, &value, 1, MPI_DOUBLE, MPI_SUM, program_);
  return value;
}

}  // namespace littoral::coupler
