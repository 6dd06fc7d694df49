#include "littoral/coupler/donor_search.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "littoral/error.hpp"
#include "patch_search.hpp"
#include "validate.hpp"

namespace littoral::coupler {

namespace {

/// The coordinates a planar patch extends in: (x, z) in a planar run, else all but its thinnest.
std::array<std::size_t, 2> plane_of(const DonorPatch& patch, int dimension) {
  if (dimension == 2) return {0, 2};
  std::array<double, 3> extent{};
  const std::array<const std::vector<double>*, 3> coordinate{&patch.x, &patch.y, &patch.z};
  for (std::size_t d = 0; d < 3; ++d) {
    const auto [low, high] = std::minmax_element(coordinate[d]->begin(), coordinate[d]->end());
    extent[d] = *high - *low;
  }
  const auto thin = static_cast<std::size_t>(std::min_element(extent.begin(), extent.end()) - extent.begin());
  return {thin == 0 ? 1u : 0u, thin == 2 ? 1u : 2u};
}

template <int A>
Donor donor_of(const PatchSearch<A>& patch, const Candidate<A>& candidate,
               const typename PatchSearch<A>::Point& x) {
  using Map = Multilinear<A>;
  std::array<double, Map::k_corners> weights;
  std::array<bool, Map::k_corners> usable;
  for (std::size_t k = 0; k < Map::k_corners; ++k) usable[k] = patch.usable(patch.corner(candidate.cell, k));
  if (candidate.kind == Candidate<A>::Kind::fitted)
    linear_fit_weights<A>(patch.corners(candidate.cell), usable, x, weights);
  else
    weights = Map::weights(candidate.xi);
  Donor donor;
  std::size_t spare = 0;  // a usable corner: stands where a corner is not used
  while (!usable[spare]) ++spare;
  for (std::size_t k = 0; k < 8; ++k) {
    const bool used = k < Map::k_corners && usable[k];
    donor.cell[k] =
        static_cast<std::int32_t>(patch.offset() + patch.corner(candidate.cell, used ? k : spare));
    donor.weight[k] = used ? weights[k] : 0.0;
  }
  donor.found = true;
  return donor;
}

template <int A>
Donor find_in(const std::vector<PatchSearch<A>>& patches, const Vec3& x, std::int64_t& hint) {
  if (patches.empty()) return {};
  if (hint >= 0) {
    for (const auto& patch : patches) {
      const auto local = static_cast<std::size_t>(hint) - patch.offset();
      if (static_cast<std::size_t>(hint) < patch.offset() || local >= patch.size()) continue;
      Candidate<A> found;
      const auto point = patch.project(x);
      if (!patch.walk(point, local, found)) break;
      hint = static_cast<std::int64_t>(patch.offset() + found.cell);
      return donor_of(patch, found, point);
    }
  }
  Candidate<A> best;
  const PatchSearch<A>* owner = nullptr;
  for (const auto& patch : patches) {
    Candidate<A> candidate;
    patch.search(patch.project(x), candidate);
    if (candidate.better_than(best)) {
      best = candidate;
      owner = &patch;
    }
  }
  if (!owner) return {};
  hint = static_cast<std::int64_t>(owner->offset() + best.cell);
  return donor_of(*owner, best, owner->project(x));
}

}  // namespace

struct DonorSearch::Impl {
  std::vector<PatchSearch<2>> planar;
  std::vector<PatchSearch<3>> solid;
};

DonorSearch::DonorSearch(const DonorGeometry& geometry, int dimension) : impl_(std::make_unique<Impl>()) {
  if (geometry.size() > static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max()))
    throw CouplingError("more donor cells on one rank than a 32-bit index can name");
  std::size_t offset = 0;
  for (const auto& patch : geometry.patches) {
    const auto extended = std::count_if(patch.n.begin(), patch.n.end(), [](int n) { return n > 1; });
    const bool empty = patch.size() == 0;
    if (!empty && dimension == 2 && extended == 3)
      throw CouplingError("a donor patch of a planar run has more than one cell in each of three directions");
    // a single row of centres spans no dual cell: it can serve nothing
    if (!empty && extended == 2) impl_->planar.emplace_back(patch, plane_of(patch, dimension), offset);
    if (!empty && extended == 3)
      impl_->solid.emplace_back(patch, std::array<std::size_t, 3>{0, 1, 2}, offset);
    offset += patch.size();
  }
  for (auto& patch : impl_->planar) patch.mark_shared(impl_->planar);
  for (auto& patch : impl_->solid) patch.mark_shared(impl_->solid);
}

DonorSearch::~DonorSearch() = default;
DonorSearch::DonorSearch(DonorSearch&&) noexcept = default;
DonorSearch& DonorSearch::operator=(DonorSearch&&) noexcept = default;

Donor DonorSearch::find(const Vec3& x, std::int64_t& hint) const {
  if (impl_->planar.empty()) return find_in(impl_->solid, x, hint);
  Donor donor = find_in(impl_->solid, x, hint);
  return donor.found ? donor : find_in(impl_->planar, x, hint);
}

DonorState interpolate(const DonorValues& values, const Donor& donor, double time) {
  if (!donor.found) throw CouplingError("interpolation without a donor");
  // times are sums of substeps: one that ends a round-off late is still inside
  const double slack = 1e-9 * (values.horizon_end - values.horizon_begin) +
                       4 * std::numeric_limits<double>::epsilon() * std::abs(time);
  if (!(time >= values.horizon_begin - slack && time <= values.horizon_end + slack))
    throw CouplingError("donors asked for t = " + text_of(time) + " s, but they hold from " +
                        text_of(values.horizon_begin) + " to " + text_of(values.horizon_end) +
                        " s; a longer substep than agreed?");
  const double dt = time - values.time;
  const bool with_phi = !values.phi.empty();
  DonorState state;
  if (!with_phi) state.phi = k_deep;
  for (std::size_t k = 0; k < donor.cell.size(); ++k) {
    const auto c = static_cast<std::size_t>(donor.cell[k]);
    const double w = donor.weight[k];
    state.p += w * (values.p[c] + dt * values.dp_dt[c]);
    state.u[0] += w * (values.u[c] + dt * values.du_dt[c]);
    state.u[1] += w * (values.v[c] + dt * values.dv_dt[c]);
    state.u[2] += w * (values.w[c] + dt * values.dw_dt[c]);
    if (with_phi) state.phi += w * (values.phi[c] + dt * values.dphi_dt[c]);
  }
  return state;
}

}  // namespace littoral::coupler
