#pragma once

#include <mpi.h>

#include <chrono>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "littoral/coupler/analytic.hpp"
#include "littoral/coupler/job.hpp"
#include "littoral/support/scene.hpp"

namespace littoral::mock {

/// What a mock partner is asked to play. All lengths in m, times in s.
struct Script {
  int dimension = 2;
  coupler::Box region{{0.0, 0.0, -0.5}, {1.0, 0.4, 0.0}};  // where mock_sph has its particles
  coupler::Box layers = region;                            // where it needs donors
  coupler::Box grid{{-0.5, -0.3, -1.2}, {1.5, 0.7, 0.4}};  // cells of mock_fv
  double spacing = 0.1;
  bool with_phi = true;
  bool last_rank_is_empty = false;
  bool split_along_z = false;  // how a program's ranks divide its box; else along x
  double dt_stable = 0.02;
  double dt = 0.05;  // of the window
  double end = 0.25;
  std::string schedule = "serial";
  double deadline = 20.0;
  int stop_at = -1;            // window before which this program asks for the end
  int region_changes_at = -1;  // window before which it asks for a new epoch
  bool wants_particles = false;
  int entries = 0;    // more entries in the contract, so that it no longer goes in one piece
  double work = 0.0;  // [s] pretends to compute so long in each window

  std::string misbehave;  // empty: plays by the rules
  int at = 2;             // in this window
  double delay = 1.0;     // of `late`

  // Of a mock beside a real solver: the scene that the other one reads, whose initial state is a steady flow.
  std::optional<support::Scene> scene;
  double tolerance = 0.0;  // of the other's values, in the units of each, beyond round-off
};

/// Reads --key value pairs; throws ConfigError for what it does not know. With --scene FILE (and any number
/// of
/// --set scene.KEY=VALUE, as the solvers have it) the scene says what the mock plays: contract, plan, flow,
/// region. Its region has one face open to the grid, the lower one along z.
Script parse(int argc, char** argv);

coupler::RunPlan plan_of(const Script& script);
coupler::Contract contract_of(const Script& script);

/// The scene's initial state or, without a scene, linear in space and time: trilinear weights and (24)
/// reproduce it to round-off, so every value that crosses can be checked by the other side.
coupler::FlowState flow(const Script& script, const coupler::Vec3& x, double t);

/// Part `rank` of `box`.
coupler::Box part_of(const coupler::Box& box, int rank, int size, const Script& script);

/// Cell centres of a box: block of the lattice of spacing h, y = 0 in the plane.
coupler::DonorPatch lattice(const coupler::Box& box, double spacing, int dimension);

// The two scripts. Each returns when it has said goodbye; throws where the partner's values are not the
// flow's.
int play_sph(coupler::Job& job, const Script& script);
int play_fv(coupler::Job& job, const Script& script);

/// Misbehaviour that is no more than leaving, being silent or slow, at a window's begin. True: leave now.
bool misbehave_at_begin(const Script& script, std::int64_t window);
/// Misbehaviour that replaces message `kind` to the partner's rank 0 by bytes that do not fit. True: done.
bool misbehave_in_message(const Script& script, const coupler::Job& job, bool donors,
                          const coupler::Window& window, std::size_t count);
/// Agrees on the next window and begins it as the script has it; `renew` where the region has changed.
/// Nothing: this program has ended, as is proper or not.
template <class Partner, class Renew>
std::optional<coupler::Agreement> begin_window(Partner& partner, const Script& script, const std::string& who,
                                               coupler::Proposal proposal, std::int64_t windows,
                                               const Renew& renew) {
  proposal.stop = windows == script.stop_at;
  proposal.reason = proposal.stop ? who + " has had enough" : "";
  proposal.region_changed = windows == script.region_changes_at;
  coupler::Agreement agreement = partner.agree(proposal);
  if (agreement.stop) {
    partner.goodbye(agreement.reason);
    return std::nullopt;
  }
  coupler::set_place(agreement.window.index, agreement.window.t_begin);
  if (agreement.region_changed) renew();
  if (misbehave_at_begin(script, agreement.window.index)) return std::nullopt;
  if (script.misbehave == "early-goodbye" && agreement.window.index == script.at) {
    partner.goodbye(who + " leaves early");
    return std::nullopt;
  }
  std::this_thread::sleep_for(std::chrono::duration<double>(script.work));
  return agreement;
}
/// Greets with another protocol version, by hand; never returns normally.
int play_wrong_version(int argc, char** argv, coupler::Role role);

}  // namespace littoral::mock
