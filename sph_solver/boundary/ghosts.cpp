#include "boundary/ghosts.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "littoral/error.hpp"

namespace littoral::sph {
namespace {

using Side = support::Scene::Side;

template <int D>
[[noreturn]] void report_lost(const Particles<D>& particles, std::size_t i, double time, const char* what) {
  std::ostringstream text;
  text << "t = " << time << " s: particle " << particles.id[i] << " at (";
  for (std::size_t d = 0; d < D; ++d) text << (d ? ", " : "") << particles.x[d][i];
  text << ") m, velocity (";
  for (std::size_t d = 0; d < D; ++d) text << (d ? ", " : "") << particles.u[d][i];
  text << ") m/s, " << what << ". Try a lower time.cfl or a smaller spacing.";
  throw StabilityError(text.str());
}

}  // namespace

template <int D>
std::size_t Ghosts<D>::bring_back(Particles<D>& particles, double tolerance, double time) const {
  std::size_t n_mirrored = 0;
  for (std::size_t d = 0; d < D; ++d) {
    const double lower = box_.lower[d], upper = box_.upper[d], length = box_.length(d);
    auto& x = particles.x[d];
    for (std::size_t i = 0; i < particles.n_owned; ++i) {
      if (x[i] >= lower && x[i] < upper) continue;
      const bool below = x[i] < lower;
      const double outside = below ? lower - x[i] : x[i] - upper;
      switch (box_.sides[d][below ? 0 : 1]) {
        case Side::periodic:
          if (!(outside < length)) report_lost(particles, i, time, "jumped over the whole periodic domain");
          x[i] += below ? length : -length;
          if (x[i] >= upper) x[i] = lower;  // round-off of a value just below the lower face
          break;
        case Side::symmetry:
          if (!(outside <= tolerance)) report_lost(particles, i, time, "went through a symmetry plane");
          if (outside == 0.0) break;
          x[i] = 2.0 * (below ? lower : upper) - x[i];
          particles.u[d][i] = -particles.u[d][i];
          ++n_mirrored;
          break;
        case Side::open:
          if (!(outside < length))
            report_lost(particles, i, time, "is lost: further outside than the domain is long");
          break;
      }
    }
  }
  return n_mirrored;
}

template <int D>
void Ghosts<D>::add(std::size_t parent, std::size_t n_owned, std::size_t d, double sign, double offset) {
  const bool original = parent < n_owned + n_halo_;
  const std::size_t g = parent - n_owned;
  source_.push_back(original ? static_cast<std::int32_t>(parent) : source_[g]);
  for (std::size_t e = 0; e < D; ++e) {
    double s = original ? 1.0 : sign_[e][g];
    double o = original ? 0.0 : offset_[e][g];
    if (e == d) {
      s *= sign;
      o = sign * o + offset;
    }
    sign_[e].push_back(s);
    offset_[e].push_back(o);
  }
}

template <int D>
void Ghosts<D>::create_halo(Particles<D>& particles, double reach) {
  auto lower = interest_lower_, upper = interest_upper_;
  const bool nothing = lower[0] > upper[0];
  for (std::size_t d = 0; d < D; ++d) {
    if (nothing) lower[d] = std::numeric_limits<double>::infinity(), upper[d] = -lower[d];
    double low = lower[d], high = upper[d];
    for (std::size_t i = 0; i < particles.n_owned; ++i) {
      low = std::min(low, particles.x[d][i]);
      high = std::max(high, particles.x[d][i]);
    }
    // what strays beyond a plane is as near to its neighbours' images as its own image is to the neighbours
    if (box_.sides[d][0] == Side::symmetry && low < box_.lower[d])
      high = std::max(high, 2.0 * box_.lower[d] - low);
    if (box_.sides[d][1] == Side::symmetry && high > box_.upper[d])
      low = std::min(low, 2.0 * box_.upper[d] - high);
    lower[d] = low, upper[d] = high;
  }
  n_halo_ = others_->create_halo(particles, reach, lower, upper);
  for (std::size_t h = 0; h < n_halo_; ++h) {
    source_.push_back(static_cast<std::int32_t>(particles.n_owned + h));
    for (std::size_t d = 0; d < D; ++d) {
      sign_[d].push_back(1.0);
      offset_[d].push_back(0.0);
    }
  }
}

/// Copies across the two sides of direction d, of all copies made before as well.
template <int D>
void Ghosts<D>::copy_across(const Particles<D>& particles, std::size_t d, double reach, bool periodic) {
  const double lower = box_.lower[d], upper = box_.upper[d], length = box_.length(d);
  const std::size_t n = particles.n_owned, n_parents = n + source_.size();
  for (std::size_t k = 0; k < n_parents; ++k) {
    if (periodic && k >= n && k < n + n_halo_) continue;  // their images are in the halo
    const double x =
        k < n ? particles.x[d][k] : sign_[d][k - n] * particles.x[d][source(k - n)] + offset_[d][k - n];
    if (periodic) {
      if (x < lower + reach) add(k, n, d, 1.0, length);
      if (x > upper - reach) add(k, n, d, 1.0, -length);
      continue;
    }
    if (box_.sides[d][0] == Side::symmetry && x < lower + reach) add(k, n, d, -1.0, 2.0 * lower);
    if (box_.sides[d][1] == Side::symmetry && x > upper - reach) add(k, n, d, -1.0, 2.0 * upper);
  }
}

template <int D>
void Ghosts<D>::create(Particles<D>& particles, double reach) {
  particles.drop_ghosts();
  n_halo_ = 0;
  source_.clear();
  for (std::size_t d = 0; d < D; ++d) {
    sign_[d].clear();
    offset_[d].clear();
  }
  if (others_ != nullptr) create_halo(particles, reach);
  // A particle may have strayed outside in the middle of a step; its neighbours' copies lie that much further
  // out.
  double strayed = 0.0;
  for (std::size_t d = 0; d < D; ++d) {
    if (box_.sides[d][0] == Side::open && box_.sides[d][1] == Side::open) continue;
    for (std::size_t i = 0; i < particles.n_owned; ++i) {
      if (box_.sides[d][0] != Side::open) strayed = std::max(strayed, box_.lower[d] - particles.x[d][i]);
      if (box_.sides[d][1] != Side::open) strayed = std::max(strayed, particles.x[d][i] - box_.upper[d]);
    }
  }
  reach += strayed;
  // Direction after direction, each copying the copies made before it: that fills edges and corners. The
  // periodic ones first, because the halo's periodic images are there from the beginning.
  for (std::size_t d = 0; d < D; ++d)
    if (box_.is_periodic(d)) copy_across(particles, d, reach, true);
  for (std::size_t d = 0; d < D; ++d)
    if (!box_.is_periodic(d) && (box_.sides[d][0] != Side::open || box_.sides[d][1] != Side::open))
      copy_across(particles, d, reach, false);
  particles.resize_ghosts(source_.size());
  for (std::size_t g = n_halo_; g < source_.size(); ++g) {
    particles.m[particles.n_owned + g] = particles.m[source(g)];
    particles.id[particles.n_owned + g] = particles.id[source(g)];
  }
  refresh_images(particles);
}

template <int D>
void Ghosts<D>::refresh(Particles<D>& particles) const {
  if (others_ != nullptr) others_->refresh(particles);
  refresh_images(particles);
}

template <int D>
void Ghosts<D>::refresh_images(Particles<D>& particles) const {
  const std::size_t first = particles.n_owned;
  const auto n = static_cast<std::ptrdiff_t>(source_.size());
#pragma omp parallel for schedule(static)
  for (auto k = static_cast<std::ptrdiff_t>(n_halo_); k < n; ++k) {
    const auto g = static_cast<std::size_t>(k);
    const std::size_t from = source(g), to = first + g;
    for (std::size_t d = 0; d < D; ++d) {
      particles.x[d][to] = sign_[d][g] * particles.x[d][from] + offset_[d][g];
      particles.u[d][to] = sign_[d][g] * particles.u[d][from];
    }
    particles.V[to] = particles.V[from];
    particles.rho[to] = particles.rho[from];
    particles.p[to] = particles.p[from];
  }
}

template <int D>
template <class Real>
void Ghosts<D>::refresh(PairRows<D, Real>& rows) const {
  using Rows = PairRows<D, Real>;
  if (others_ != nullptr) others_->refresh(rows);
  const auto n = static_cast<std::ptrdiff_t>(source_.size());
#pragma omp parallel for schedule(static)
  for (auto k = static_cast<std::ptrdiff_t>(n_halo_); k < n; ++k) {
    const auto g = static_cast<std::size_t>(k);
    const Real* from = rows.face(source(g)).q;
    Real* to = rows.face(rows.n_owned() + g).q;
    std::size_t next = Rows::k_strain;
    for (std::size_t a = 0; a < D; ++a) {
      const auto sign = static_cast<Real>(sign_[a][g]);
      to[Rows::k_grad_p + a] = sign * from[Rows::k_grad_p + a];
      for (std::size_t b = a; b < D; ++b, ++next)
        to[next] = sign * static_cast<Real>(sign_[b][g]) * from[next];
    }
  }
}

template <int D>
void Ghosts<D>::refresh_scalar(std::vector<double>& column, std::size_t n_owned) const {
  if (others_ != nullptr) others_->refresh_scalar(column, n_owned);
  for (std::size_t g = n_halo_; g < source_.size(); ++g) column[n_owned + g] = column[source(g)];
}

template <int D>
void Ghosts<D>::refresh_vector(std::array<std::vector<double>, D>& columns, std::size_t n_owned) const {
  if (others_ != nullptr) others_->refresh_vector(columns, n_owned);
  for (std::size_t d = 0; d < D; ++d)
    for (std::size_t g = n_halo_; g < source_.size(); ++g)
      columns[d][n_owned + g] = sign_[d][g] * columns[d][source(g)];
}

template class Ghosts<2>;
template class Ghosts<3>;
template void Ghosts<2>::refresh(PairRows<2, double>&) const;
template void Ghosts<2>::refresh(PairRows<2, float>&) const;
template void Ghosts<3>::refresh(PairRows<3, double>&) const;
template void Ghosts<3>::refresh(PairRows<3, float>&) const;

}  // namespace littoral::sph
