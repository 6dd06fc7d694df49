#include "littoral/coupler/job.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <thread>
#include <utility>
#include <vector>

#include "channel.hpp"
#include "littoral/error.hpp"
#include "mpi_partners.hpp"
#include "patience.hpp"
#include "wire.hpp"
#include "world.hpp"

namespace littoral::coupler {

namespace {

// Programs of one job are started together; what takes longer than this never comes.
constexpr double k_handshake_deadline = 120.0;  // [s]
constexpr int k_tag_intercomm = 77;

template <std::size_t n>
void copy_text(std::array<char, n>& to, const std::string& from) {
  to.fill('\0');
  std::copy_n(from.begin(), std::min(from.size(), n - 1), to.begin());
}

template <std::size_t n>
std::string text_of(const std::array<char, n>& text) {
  return std::string(text.begin(), std::find(text.begin(), text.end(), '\0'));
}

Greeting greeting_of(Role role, const std::string& program, const std::string& version) {
  Greeting greeting;
  copy_text(greeting.role, name(role));
  copy_text(greeting.program, program);
  copy_text(greeting.version, version);
  return greeting;
}

Contract unpack_contract(const Bytes& message, const std::string& who) {
  try {
    return Contract::unpack(message.data() + sizeof(Header), message.size() - sizeof(Header));
  } catch (const CouplingError& problem) {
    throw CouplingError(who + " sent a bad " + problem.what());
  }
}

std::vector<Greeting> greet(const Greeting& mine) {
  int size = 1;
  MPI_Comm_size(MPI_COMM_WORLD, &size);
  std::vector<Greeting> all(static_cast<std::size_t>(size));
  MPI_Request request;
  const int bytes = static_cast<int>(sizeof mine);
  MPI_Iallgather(&mine, bytes, MPI_BYTE, all.data(), bytes, MPI_BYTE, MPI_COMM_WORLD, &request);
  try {
    wait_politely(request, k_handshake_deadline, "");
  } catch (const CouplingError&) {
    throw CouplingError("handshake: not all programs of this MPI job took part within " +
                        std::to_string(static_cast<int>(k_handshake_deadline)) +
                        " s. Is one of them no littoral program, or has it stopped?");
  }
  return all;
}

/// throws CouplingError where the greetings of the world do not make a job
void check(const std::vector<Greeting>& all, const Greeting& mine) {
  for (const auto& greeting : all) {
    if (greeting.magic != Greeting::k_magic)
      throw CouplingError("handshake: another program of this MPI job does not speak this protocol");
    if (greeting.protocol_version != mine.protocol_version)
      throw CouplingError("handshake: " + text_of(greeting.program) + " speaks protocol version " +
                          std::to_string(greeting.protocol_version) + ", " + text_of(mine.program) +
                          " version " + std::to_string(mine.protocol_version) +
                          ". Build both from the same release of littoral");
    const std::string role = text_of(greeting.role);
    if (role != name(Role::sph) && role != name(Role::fv))
      throw CouplingError("handshake: " + text_of(greeting.program) + " plays the unknown role '" + role +
                          "'; there are sph and fv");
    if (role == text_of(mine.role) && (greeting.version != mine.version || greeting.program != mine.program))
      throw CouplingError("handshake: the role " + role + " is played twice, by " + text_of(mine.program) +
                          " " + text_of(mine.version) + " and by " + text_of(greeting.program) + " " +
                          text_of(greeting.version) + "; a job has one program a role");
  }
}

std::string base_name(const char* path) {
  const std::string text = path ? path : "program";
  return text.substr(text.find_last_of('/') + 1);
}

}  // namespace

struct Job::Impl {
  Role role;
  MPI_Comm comm = MPI_COMM_NULL, intercomm = MPI_COMM_NULL;
  int rank = 0, size = 1, partner_size = 0;
  std::string program, partner, partner_version;
  std::shared_ptr<Standing> standing = std::make_shared<Standing>();
};

Job::Job(int& argc, char**& argv, Role role, const std::string& program_version)
    : impl_(std::make_unique<Impl>()) {
  int initialized = 0, provided = 0;
  MPI_Initialized(&initialized);
  if (!initialized) MPI_Init_thread(&argc, &argv, MPI_THREAD_FUNNELED, &provided);
  impl_->role = role;
  impl_->program = base_name(argc > 0 ? argv[0] : nullptr);

  const Greeting mine = greeting_of(role, impl_->program, program_version);
  const auto all = greet(mine);
  check(all, mine);
  int world_rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &world_rank);
  MPI_Comm_split(MPI_COMM_WORLD, static_cast<int>(role), world_rank, &impl_->comm);
  MPI_Comm_rank(impl_->comm, &impl_->rank);
  MPI_Comm_size(impl_->comm, &impl_->size);

  const auto other = std::find_if(all.begin(), all.end(),
                                  [&](const Greeting& greeting) { return greeting.role != mine.role; });
  if (other == all.end()) return;
  impl_->partner = text_of(other->program);
  impl_->partner_version = text_of(other->version);
  MPI_Intercomm_create(impl_->comm, 0, MPI_COMM_WORLD, static_cast<int>(other - all.begin()), k_tag_intercomm,
                       &impl_->intercomm);
  MPI_Comm_remote_size(impl_->intercomm, &impl_->partner_size);
}

/// Nobody is left hanging: who has coupled says goodbye or takes the job with him; who has not, says that he
/// leaves.
Job::~Job() {
  int finalized = 0;
  MPI_Finalized(&finalized);
  if (finalized) return;
  if (has_partner() && impl_->standing->coupled && !impl_->standing->said_goodbye)
    end_world(impl_->intercomm, impl_->program + " ends without having said goodbye to " + impl_->partner,
              "it ends without having said goodbye");
  if (has_partner() && !impl_->standing->coupled) {
    if (impl_->rank == 0)
      send_notice(impl_->intercomm, {Kind::leaving, "it ended before the coupling began"});
    // Finalizing while the partner still works would wait busily, so wait here. If it counts on us, it aborts
    // the job.
    try {
      Channel(impl_->intercomm, impl_->partner, std::numeric_limits<double>::infinity()).await_farewell();
    } catch (const CouplingError& error) {
      end_world(impl_->intercomm, impl_->program + ": " + error.what(), "it has left");
    }
  }
  if (impl_->intercomm != MPI_COMM_NULL) MPI_Comm_free(&impl_->intercomm);
  if (impl_->comm != MPI_COMM_NULL) MPI_Comm_free(&impl_->comm);
  MPI_Finalize();
}

Role Job::role() const { return impl_->role; }
MPI_Comm Job::comm() const { return impl_->comm; }
int Job::rank() const { return impl_->rank; }
int Job::size() const { return impl_->size; }
bool Job::has_partner() const { return impl_->intercomm != MPI_COMM_NULL; }
int Job::partner_size() const { return impl_->partner_size; }
std::string Job::program() const { return impl_->program; }
std::string Job::partner_program() const { return impl_->partner; }
std::string Job::partner_version() const { return impl_->partner_version; }
MPI_Comm Job::intercomm() const { return impl_->intercomm; }

void Job::compare(const Contract& mine, double deadline) const {
  if (!has_partner()) return;
  std::string verdict;
  if (impl_->rank == 0) {
    Channel channel(impl_->intercomm, impl_->partner, deadline);
    Expected what;
    what.kind = Kind::contract;
    const auto packed = mine.pack();
    Bytes out(sizeof(Header)), in;
    out.insert(out.end(), packed.begin(), packed.end());
    seal(out, what, mine.entries().size());
    channel.start_send(0, out);
    channel.receive(0, what, in);
    channel.complete_sends(what);
    const Contract theirs = unpack_contract(in, channel.who(0));
    const auto mismatches = mine.compare(theirs);
    out.resize(sizeof(Header));  // nobody ends the job before both have compared
    seal(out, what, mismatches.size());
    channel.start_send(0, out);
    channel.receive(0, what, in);
    channel.complete_sends(what);
    if (!mismatches.empty())
      verdict = "the programs do not agree on what they compute:\n" +
                describe(mismatches, impl_->program, impl_->partner) + "Both must read the same scene";
  }
  const double at_home = 2.0 * deadline + 10.0;  // the root should be the one that complains of the partner
  int length = static_cast<int>(verdict.size());
  MPI_Request request;
  MPI_Ibcast(&length, 1, MPI_INT, 0, impl_->comm, &request);
  wait_politely(request, at_home, "the comparison with the partner");
  verdict.resize(static_cast<std::size_t>(length));
  MPI_Ibcast(verdict.data(), length, MPI_CHAR, 0, impl_->comm, &request);
  wait_politely(request, at_home, "the comparison with the partner");
  if (!verdict.empty()) throw CouplingError(verdict);
}

std::unique_ptr<FvPartner> Job::fv_partner(const RunPlan& plan) const {
  if (!has_partner())
    throw CouplingError("this job has no fv program to couple with; start both in one mpirun");
  if (role() != Role::sph) throw CouplingError("only the sph program has an fv partner");
  return mpi_fv_partner(impl_->comm, impl_->intercomm, impl_->partner, plan, impl_->standing);
}

std::unique_ptr<SphPartner> Job::sph_partner(const RunPlan& plan) const {
  if (!has_partner())
    throw CouplingError("this job has no sph program to couple with; start both in one mpirun");
  if (role() != Role::fv) throw CouplingError("only the fv program has an sph partner");
  return mpi_sph_partner(impl_->comm, impl_->intercomm, impl_->partner, plan, impl_->standing);
}

int world_rank() {
  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  return rank;
}

int world_size() {
  int size = 1;
  MPI_Comm_size(MPI_COMM_WORLD, &size);
  return size;
}

void end_world(MPI_Comm intercomm, const std::string& shown, const std::string& reason) {
  if (!shown.empty()) std::fprintf(stderr, "%s\n", shown.c_str());
  std::fflush(nullptr);
  send_notice(intercomm, {Kind::abort, reason});
  // The launcher kills everybody at the first abort, so the partner must have printed before. Its own notice
  // says that it has; a partner that computes will not answer.
  Patience patience(1.0);
  for (int answered = 0; intercomm != MPI_COMM_NULL && !answered && !patience.expired(); patience.pause())
    MPI_Iprobe(MPI_ANY_SOURCE, k_tag_notice, intercomm, &answered, MPI_STATUS_IGNORE);
  std::this_thread::sleep_for(
      std::chrono::milliseconds(100));  // for the launcher to forward what was printed
  MPI_Abort(MPI_COMM_WORLD, 1);
  std::abort();
}

}  // namespace littoral::coupler
