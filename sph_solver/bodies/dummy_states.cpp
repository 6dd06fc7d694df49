#include "bodies/dummy_states.hpp"

#include "bodies/wall_view.hpp"
#include "physics/kernel.hpp"

namespace littoral::sph {
namespace {

template <int D>
constexpr std::size_t k_sums = D + 2;  // weight, p, u

}  // namespace

template <int D>
void DummyStates<D>::build(const WallList<D>& list, const Dummies<D>& dummies) {
  start_.assign(dummies.n_sources() + 1, 0);
  for (std::size_t pair = 0; pair < list.n_pairs(); ++pair) ++start_[dummies.source(list.dummy(pair)) + 1];
  for (std::size_t s = 1; s < start_.size(); ++s) start_[s] += start_[s - 1];
  std::vector<std::size_t> fill(start_.begin(), start_.end() - 1);
  heard_.resize(list.n_pairs());
  for (std::size_t row = 0; row < list.n_rows(); ++row)
    for (std::size_t pair = list.begin(row); pair < list.end(row); ++pair) {
      const std::size_t e = list.dummy(pair);
      heard_[fill[dummies.source(e)]++] = {static_cast<std::int32_t>(e), static_cast<std::int32_t>(row)};
    }
}

template <int D>
void DummyStates<D>::extrapolate(const Particles<D>& particles, const Dummies<D>& dummies,
                                 const WallList<D>& list, const RowAccelerations<D>& mass_force,
                                 double kernel_radius, OtherRanks<D>* others) {
  const Kernel<D> kernel(kernel_radius);
  const auto n_sources = static_cast<std::ptrdiff_t>(dummies.n_sources());
  sums_.assign(dummies.n_sources() * k_sums<D>, 0.0);
#pragma omp parallel for schedule(static)
  for (std::ptrdiff_t s = 0; s < n_sources; ++s) {
    const auto source = static_cast<std::size_t>(s);
    double* sum = sums_.data() + source * k_sums<D>;
    for (std::size_t k = start_[source]; k < start_[source + 1]; ++k) {
      const auto e = static_cast<std::size_t>(heard_[k].dummy), row = static_cast<std::size_t>(heard_[k].row);
      const std::size_t i = list.particle(row);
      double r2 = 0.0, rise = 0.0;  // (f - a_w) . x_iw
      for (std::size_t d = 0; d < D; ++d) {
        const double dx = dummies[e].x[d] - particles.x[d][i];
        r2 += dx * dx;
        rise += (mass_force[row][d] - dummies[e].a[d]) * dx;
      }
      const double weight = particles.V[i] * kernel.value(std::sqrt(r2));
      sum[0] += weight;
      sum[1] += weight * (particles.p[i] + particles.rho[i] * rise);
      for (std::size_t d = 0; d < D; ++d) sum[2 + d] += weight * dummies.sign(e, d) * particles.u[d][i];
    }
  }
  if (others != nullptr) others->take_sum(sums_.data(), sums_.size());

  const auto n = static_cast<std::ptrdiff_t>(dummies.size());
  p_.assign(dummies.size(), 0.0);
  for (auto& column : u_) column.assign(dummies.size(), 0.0);
#pragma omp parallel for schedule(static)
  for (std::ptrdiff_t k = 0; k < n; ++k) {
    const auto e = static_cast<std::size_t>(k);
    const double* sum = sums_.data() + dummies.source(e) * k_sums<D>;
    if (!(sum[0] > 0.0)) continue;  // nobody sees it
    p_[e] = sum[1] / sum[0];
    double into = 0.0;
    for (std::size_t d = 0; d < D; ++d) {
      u_[d][e] = dummies.sign(e, d) * sum[2 + d] / sum[0];
      into += (u_[d][e] - dummies[e].u[d]) * dummies[e].normal[d];
    }
    for (std::size_t d = 0; d < D; ++d) u_[d][e] -= 2.0 * into * dummies[e].normal[d];
  }
}

template <int D>
std::array<double, D> DummyStates<D>::velocity(std::size_t dummy) const {
  return at<D>(u_, dummy);
}

template class DummyStates<2>;
template class DummyStates<3>;

}  // namespace littoral::sph
