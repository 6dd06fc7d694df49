#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "littoral/coupler/types.hpp"

namespace littoral::coupler {

/// Structured patch of donor cell centres, i fastest. A planar grid has n = 1 in its thin direction. Ghost
/// cells (periodic images, mirrored walls) may be part of a patch, so that particles beside a boundary find
/// eight donors.
struct DonorPatch {
  std::array<int, 3> n{0, 0, 0};
  std::vector<double> x, y, z;       // [m] (n0*n1*n2)
  std::vector<std::uint8_t> usable;  // 1 where the cell holds a state (computed or fringe), 0 where blanked
  std::size_t size() const { return x.size(); }
};

/// What one rank offers or receives; the order of patches and cells is the order of DonorValues.
struct DonorGeometry {
  std::int64_t epoch = 0;
  std::vector<DonorPatch> patches;
  std::size_t size() const {
    std::size_t n = 0;
    for (const auto& patch : patches) n += patch.size();
    return n;
  }
};

/// p, u, phi at the donors and their time derivatives: q(t) = q + dq_dt (t - time), (24), for
/// horizon_begin <= t <= horizon_end only. Interpolation between two FV results has the same form.
struct DonorValues {
  double time = 0.0;                               // [s]
  double horizon_begin = 0.0;                      // [s]
  double horizon_end = 0.0;                        // [s]
  std::vector<double> p, u, v, w;                  // [Pa], [m/s] (DonorGeometry::size())
  std::vector<double> dp_dt, du_dt, dv_dt, dw_dt;  // [Pa/s], [m/s^2]
  std::vector<double> phi, dphi_dt;                // [m], [m/s]; empty: no level set in the scene
  void resize(std::size_t n, bool with_phi);
};

/// Points where FV wants SPH values. `wants`: what for.
enum TargetWants : std::uint8_t { wants_state = 1, wants_phi = 2 };
struct Targets {
  std::int64_t epoch = 0;
  std::vector<double> x, y, z;      // [m]
  std::vector<std::uint8_t> wants;  // TargetWants
  std::size_t size() const { return x.size(); }
};

/// ok: a value; dry: in the region, but no water there; uncovered: outside the region or too few particles.
enum class SampleStatus : std::uint8_t { ok = 0, dry = 1, uncovered = 2 };

struct Samples {
  double time = 0.0;               // [s]
  std::vector<double> p, u, v, w;  // [Pa], [m/s] (Targets::size())
  std::vector<double> phi;         // [m]; < 0 in water; empty if no target wants it
  std::vector<double> coverage;    // sum of V_j W_j: about 1 inside, 1/2 on a flat surface, 0 in air
  std::vector<SampleStatus> status;
  void resize(std::size_t n, bool with_phi);
};

/// Interface particles, on request.
struct ParticleStates {
  double time = 0.0;
  std::vector<double> x, y, z, u, v, w, p, V;  // [m] [m/s] [Pa] [m^D]
  std::vector<std::uint8_t> on_surface;
  std::vector<double> nx, ny, nz;  // unit normal out of the water where on_surface
  std::size_t size() const { return x.size(); }
};

/// Mass through the SPH region's open faces, since the start. Summed over the program's ranks by the partner.
struct Ledger {
  double mass_inside = 0.0;    // [kg] (per metre in 2-D) in particles
  double mass_on_faces = 0.0;  // carried by the face elements: integrated, not yet injected
  double mass_injected = 0.0;  // as particles
  double mass_removed = 0.0;   // as particles
  double mass_flux = 0.0;  // integral of rho u.n over faces and time, into the region (SPH's own count, (18))
  double fv_mass_flux = 0.0;  // FV's flux through its interface faces, into the SPH region
  double n_injected = 0.0, n_removed = 0.0;
  /// mass_inside + mass_on_faces - (start) - mass_flux: round-off if nothing was lost.
  double defect = 0.0;
};

}  // namespace littoral::coupler
