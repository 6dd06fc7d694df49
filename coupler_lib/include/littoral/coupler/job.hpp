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
  ~Job();  ///< MPI_Finalize
  Job(const Job&) = delete;
  Job& operator=(const Job&) = delete;

  Role role() const;
  MPI_Comm comm() const;  ///< this program's ranks
  int rank() const;
  int size() const;
  bool has_partner() const;
  int partner_size() const;
  std::string partner_version() const;
  MPI_Comm intercomm() const;  ///< MPI_COMM_NULL without a partner

  /// Compares what must agree. Every mismatch (key, mine, theirs) is printed by both programs; then throws
  /// CouplingError. comm: collective over both programs
  void compare(const Contract& mine) const;

  std::unique_ptr<FvPartner> fv_partner(const RunPlan& plan) const;    ///< for role sph
  std::unique_ptr<SphPartner> sph_partner(const RunPlan& plan) const;  ///< for role fv

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// What main calls: builds the Job, runs `body`, and is the one place where a program dies. An exception is
/// printed with program, rank and the window last announced by set_place(), then MPI_Abort with a non-zero
/// status ends both programs. A --help or --check that ends before any partner is needed returns its status
/// through MPI_Finalize in both programs.
int run_program(int argc, char** argv, Role role, const std::string& version,
                const std::function<int(Job&, int, char**)>& body);

/// For messages of a dying program: where the run stands. thread: main only
void set_place(std::int64_t window, double time);

}  // namespace littoral::coupler
