#pragma once

#include <array>
#include <cstdint>

#include "littoral/coupler/fields.hpp"
#include "littoral/coupler/window.hpp"

namespace littoral::coupler {

/// The calls of FvPartner and SphPartner, as a record counts them.
enum class CallKind : std::uint8_t {
  announce = 0,  // announce() or offer()
  agree = 1,
  receive = 2,
  send = 3,
  particles = 4,  // send_particles() or receive_particles()
  exchange = 5,
  goodbye = 6
};
inline constexpr std::array<const char*, 7> k_call_names = {"announce",  "agree",    "receive", "send",
                                                            "particles", "exchange", "goodbye"};
inline const char* name(CallKind kind) { return k_call_names.at(static_cast<std::size_t>(kind)); }

struct Call {
  CallKind kind = CallKind::announce;
  Window window;           // agree: the one agreed upon; announce, goodbye: zeros
  std::int64_t count = 0;  // values that cross, per column; agree and goodbye: letters of the reason
};

/// Names a structure's columns once, for writing and for reading: visit(name, column).
template <class Values, class Visit>
void each_donor_column(Values& d, Visit&& visit) {
  visit("p", d.p), visit("u", d.u), visit("v", d.v), visit("w", d.w);
  visit("dp_dt", d.dp_dt), visit("du_dt", d.du_dt), visit("dv_dt", d.dv_dt), visit("dw_dt", d.dw_dt);
  visit("phi", d.phi), visit("dphi_dt", d.dphi_dt);
}
template <class Values, class Visit>
void each_sample_column(Values& s, Visit&& visit) {
  visit("p", s.p), visit("u", s.u), visit("v", s.v), visit("w", s.w), visit("phi", s.phi);
  visit("coverage", s.coverage), visit("status", s.status);
}
template <class Values, class Visit>
void each_particle_column(Values& s, Visit&& visit) {
  visit("x", s.x), visit("y", s.y), visit("z", s.z), visit("u", s.u), visit("v", s.v), visit("w", s.w);
  visit("p", s.p), visit("V", s.V), visit("on_surface", s.on_surface);
  visit("nx", s.nx), visit("ny", s.ny), visit("nz", s.nz);
}
template <class Values, class Visit>
void each_patch_column(Values& patch, Visit&& visit) {
  visit("x", patch.x), visit("y", patch.y), visit("z", patch.z), visit("usable", patch.usable);
}
template <class Values, class Visit>
void each_target_column(Values& t, Visit&& visit) {
  visit("x", t.x), visit("y", t.y), visit("z", t.z), visit("wants", t.wants);
}

inline constexpr std::array<double Ledger::*, 9> k_ledger_members = {
    &Ledger::mass_inside,  &Ledger::mass_on_faces, &Ledger::mass_injected,
    &Ledger::mass_removed, &Ledger::mass_flux,     &Ledger::fv_mass_flux,
    &Ledger::n_injected,   &Ledger::n_removed,     &Ledger::defect};

inline constexpr std::array<bool Agreement::*, 5> k_agreement_flags = {
    &Agreement::write, &Agreement::checkpoint, &Agreement::stop, &Agreement::region_changed,
    &Agreement::wants_particles};

}  // namespace littoral::coupler
