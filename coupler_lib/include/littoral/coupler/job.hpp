#pragma once

#include <mpi.h>

#include <functional>
#include <memory>
#include <string>

#include "littoral/coupler/contract.hpp"
#include "littoral/coupler/partner.hpp"

namespace littoral::coupler {

/// This program's place in the MPI job: MPI itself, its own communicator, and the partner's program if there
/// is one. MPI_COMM_WORLD appears in the implementation of this class and nowhere else.
class Job {
 public:
  /// MPI_Init_thread (funneled), then the handshake by name: allgather of {magic, protocol version, role,
  /// program version} over the world, split, intercommunicator. A world of one role only has no partner.
  /// comm: collective over the world. throws CouplingError: other magic, other protocol version, three roles,
  /// one role twice under different program versions
  Job(int& argc, char**& argv, Role role, const std::string& program_version);
  /// MPI_Finalize, when it can be done without leaving the partner hanging: after both have said goodbye, or
  /// when the coupling has not begun on either side. Else the world is aborted with a non-zero status.
  ~Job();
  Job(const Job&) = delete;
  Job& operator=(const Job&) = delete;

  Role role() const;
  MPI_Comm comm() const;  ///< this program's ranks
  int rank() const;
  int size() const;
  bool has_partner() const;
  int partner_size() const;
  std::string program() const;          ///< name of this program's executable
  std::string partner_program() const;  ///< and of the partner's; empty without one
  std::string partner_version() const;
  MPI_Comm intercomm() const;  ///< MPI_COMM_NULL without a partner

  /// Compares what must agree. Every mismatch (key, mine, theirs) is printed by both programs; then throws
  /// CouplingError. `deadline` [s]: how long the partner may take to come here. comm: collective over both
  /// programs
  void compare(const Contract& mine, double deadline = 600.0) const;

  std::unique_ptr<FvPartner> fv_partner(const RunPlan& plan) const;    ///< for role sph
  std::unique_ptr<SphPartner> sph_partner(const RunPlan& plan) const;  ///< for role fv

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// What main calls: builds the Job, runs `body`, and is the one place where a program dies. An exception is
/// printed with program, rank and the window last announced by set_place(), the partner is told, then
/// MPI_Abort with a non-zero status ends both programs. A body that returns before the coupling has begun
/// (--help, --check) tells the partner so: if both do, the job ends in peace; if the partner counted on it,
/// the partner ends the job. A body that returns after coupling without goodbye aborts the job.
int run_program(int argc, char** argv, Role role, const std::string& version,
                const std::function<int(Job&, int, char**)>& body);

/// For messages of a dying program: where the run stands. thread: main only
void set_place(std::int64_t window, double time);

}  // namespace littoral::coupler
