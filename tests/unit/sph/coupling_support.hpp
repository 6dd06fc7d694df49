#pragma once

#include <cmath>
#include <functional>
#include <optional>

#include "coupling/exterior.hpp"
#include "coupling/zones.hpp"
#include "particles/particles.hpp"
#include "physics/eos.hpp"

namespace littoral::sph::test {

/// FV's solution by formula; a state is absent where the formula gives none.
class FormulaExterior final : public Exterior {
 public:
  using Formula = std::function<std::optional<coupler::DonorState>(const coupler::Vec3&, double)>;
  explicit FormulaExterior(Formula formula, bool with_phi = false)
      : formula_(std::move(formula)), with_phi_(with_phi) {}
  std::optional<coupler::DonorState> at(const coupler::Vec3& x, double time, std::int64_t&) const override {
    return formula_(x, time);
  }
  bool with_phi() const override { return with_phi_; }

 private:
  Formula formula_;
  bool with_phi_;
};

/// A unit box, open on the sides asked for, with layers outside.
template <int D>
Layers<D> unit_box(std::array<std::array<bool, 2>, D> open, double blending, double driven) {
  RegionBox<D> box;
  box.lower.fill(0.0);
  box.upper.fill(1.0);
  box.open = open;
  return Layers<D>({box}, blending, driven);
}

template <int D>
std::array<std::array<bool, 2>, D> all_open() {
  std::array<std::array<bool, 2>, D> open;
  for (auto& direction : open) direction = {true, true};
  return open;
}

/// Lattice of spacing dx filling [lower, upper], with pressure and velocity by formula.
template <int D>
Particles<D> lattice(const Point<D>& lower, const Point<D>& upper, double dx, const LinearEos& eos,
                     const FormulaExterior& field, double time = 0.0) {
  Particles<D> particles;
  std::array<std::size_t, D> n{}, c{};
  for (std::size_t d = 0; d < D; ++d)
    n[d] = static_cast<std::size_t>(std::lround((upper[d] - lower[d]) / dx));
  double V = 1.0;
  for (std::size_t d = 0; d < D; ++d) V *= dx;
  while (c[D - 1] < n[D - 1]) {
    NewParticle<D> born;
    for (std::size_t d = 0; d < D; ++d) born.x[d] = lower[d] + (static_cast<double>(c[d]) + 0.5) * dx;
    std::int64_t hint = -1;
    const auto state = field.at(to_vec3<D>(born.x), time, hint);
    born.V = V;
    born.p = state->p;
    born.m = eos.density(state->p) * V;
    born.u = from_vec3<D>(state->u);
    particles.append(born);
    std::size_t d = 0;
    while (d < D && ++c[d] == n[d] && d + 1 < D) c[d++] = 0;
  }
  return particles;
}

}  // namespace littoral::sph::test
