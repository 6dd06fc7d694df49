#include "implicit/line_operator.hpp"

#include <type_traits>

namespace littoral::fv {

namespace {

/// r -= a x
template <int D, class V>
inline void subtract_product(const SmallMatrix<D, V>& a, const V* x, V* r) {
  for (std::size_t i = 0; i <= D; ++i)
    for (std::size_t j = 0; j <= D; ++j) r[i] -= a[i][j] * x[j];
}

/// r = a x
template <int D, class V>
inline void assign_product(const SmallMatrix<D, V>& a, const V* x, V* r) {
  for (std::size_t i = 0; i <= D; ++i) {
    V sum = a[i][0] * x[0];
    for (std::size_t j = 1; j <= D; ++j) sum += a[i][j] * x[j];
    r[i] = sum;
  }
}

template <LanePattern S, class Fields, class V>
inline void load_all(const Fields& q, const std::array<std::ptrdiff_t, k_lanes>& first, std::ptrdiff_t shift,
                     V* x) {
  for (std::size_t i = 0; i < q.size(); ++i) load<S>(q[i].data() + shift, first, x[i]);
}

template <LanePattern S, class Fields, class V>
inline void store_all(const V* x, const std::array<std::ptrdiff_t, k_lanes>& first, std::ptrdiff_t shift,
                      Fields& q) {
  for (std::size_t i = 0; i < q.size(); ++i) store<S>(x[i], first, q[i].data() + shift);
}

/// body(spacing as a constant)
template <class Body>
inline void with_spacing(LanePattern spacing, Body&& body) {
  switch (spacing) {
    case LanePattern::one:
      body(std::integral_constant<LanePattern, LanePattern::one>{});
      break;
    case LanePattern::two:
      body(std::integral_constant<LanePattern, LanePattern::two>{});
      break;
    case LanePattern::any:
      body(std::integral_constant<LanePattern, LanePattern::any>{});
      break;
  }
}

}  // namespace

template <int D, class Real>
template <LanePattern S>
void LineOperator<D, Real>::residual_bundle(std::size_t bundle, const Correction<D, Real>& b,
                                            const Correction<D, Real>& e, Correction<D, Real>& r) const {
  const auto& first = layout_.bundles[bundle].first;
  const int n = layout_.length;
  for (int k = 0; k < n; ++k) {
    const std::ptrdiff_t shift = k * layout_.stride;
    const std::size_t at = slot(bundle, k);
    Lanes<Real> rest[N], x[N];
    load_all<S>(b.q, first, shift, rest);
    load_all<S>(e.q, first, shift, x);
    subtract_product<D>(diagonal_[at], x, rest);
    load_all<S>(e.q, first, shift - layout_.stride, x);
    subtract_product<D>(forward_[at].lower, x, rest);
    load_all<S>(e.q, first, shift + layout_.stride, x);
    subtract_product<D>(upper_[at], x, rest);
    for (std::size_t c = 0; c < k_cross; ++c) {
      load_all<S>(e.q, first, shift + cross_shift_[c], x);
      subtract_product<D>(forward_[at].cross[c], x, rest);
    }
    store_all<S>(rest, first, shift, r.q);
  }
}

template <int D, class Real>
void LineOperator<D, Real>::residual(const Correction<D, Real>& b, const Correction<D, Real>& e,
                                     Correction<D, Real>& r) const {
#pragma omp parallel for schedule(static) if (worth_threads(layout_.bundles.size()))
  for (std::size_t bundle = 0; bundle < layout_.bundles.size(); ++bundle)
    with_spacing(layout_.bundles[bundle].spacing,
                 [&](auto spacing) { residual_bundle<decltype(spacing)::value>(bundle, b, e, r); });
}

template <int D, class Real>
template <LanePattern S>
void LineOperator<D, Real>::cross_residual_bundle(std::size_t bundle, const Correction<D, Real>& e,
                                                  Correction<D, Real>& r) const {
  const auto& first = layout_.bundles[bundle].first;
  for (int k = 0; k < layout_.length; ++k) {
    const std::ptrdiff_t shift = k * layout_.stride;
    const Forward& cell = forward_[slot(bundle, k)];
    Lanes<Real> rest[N] = {}, x[N];
    for (std::size_t c = 0; c < k_cross; ++c) {
      load_all<S>(e.q, first, shift + cross_shift_[c], x);
      subtract_product<D>(cell.cross[c], x, rest);
    }
    store_all<S>(rest, first, shift, r.q);
  }
}

template <int D, class Real>
void LineOperator<D, Real>::residual_after_sweep(const Correction<D, Real>& e, Correction<D, Real>& r) const {
  const std::size_t last = layout_.colour_begin(1);
#pragma omp parallel for schedule(static) if (worth_threads(layout_.bundles.size()))
  for (std::size_t bundle = 0; bundle < layout_.bundles.size(); ++bundle)
    with_spacing(layout_.bundles[bundle].spacing, [&](auto spacing) {
      constexpr LanePattern s = decltype(spacing)::value;
      if (bundle < last) {
        cross_residual_bundle<s>(bundle, e, r);
        return;
      }
      const Lanes<Real> zero[N] = {};
      for (int k = 0; k < layout_.length; ++k)
        store_all<s>(zero, layout_.bundles[bundle].first, k * layout_.stride, r.q);
    });
}

template <int D, class Real>
template <LanePattern S, bool FromZero>
void LineOperator<D, Real>::smooth_bundle(std::size_t bundle, const Correction<D, Real>& b,
                                          Correction<D, Real>& e, Column* y) const {
  const auto& first = layout_.bundles[bundle].first;
  const int n = layout_.length;
  const int open = layout_.cyclic ? n - 1 : n;
  Lanes<Real> x[N];
  for (int k = 0; k < n; ++k) {  // right side and forward elimination
    const std::ptrdiff_t shift = k * layout_.stride;
    const std::size_t at = slot(bundle, k);
    const Forward& cell = forward_[at];
    Lanes<Real> rest[N];
    load_all<S>(b.q, first, shift, rest);
    if constexpr (!FromZero) {
      for (std::size_t c = 0; c < k_cross; ++c) {
        load_all<S>(e.q, first, shift + cross_shift_[c], x);
        subtract_product<D>(cell.cross[c], x, rest);
      }
      if (!layout_.cyclic && k == 0) {  // a linked block beyond the line's ends; zero blocks elsewhere
        load_all<S>(e.q, first, shift - layout_.stride, x);
        subtract_product<D>(cell.lower, x, rest);
      }
      if (!layout_.cyclic && k == n - 1) {
        load_all<S>(e.q, first, shift + layout_.stride, x);
        subtract_product<D>(upper_[at], x, rest);
      }
    }
    if (k == open) {  // the cut cell of a cyclic line waits for its Schur complement
      for (std::size_t i = 0; i < N; ++i) y[k].x[i] = rest[i];
      continue;
    }
    if (k > 0) subtract_product<D>(cell.lower, y[k - 1].x, rest);
    assign_product<D>(cell.inverse, rest, y[k].x);
  }
  for (int k = open - 2; k >= 0; --k) subtract_product<D>(back_[slot(bundle, k)], y[k + 1].x, y[k].x);
  if (layout_.cyclic) {
    const std::size_t last = slot(bundle, n - 1);
    subtract_product<D>(forward_[last].lower, y[n - 2].x, y[n - 1].x);
    subtract_product<D>(upper_[last], y[0].x, y[n - 1].x);
    assign_product<D>(forward_[last].inverse, y[n - 1].x, x);
    for (std::size_t i = 0; i < N; ++i) y[n - 1].x[i] = x[i];
    for (int k = 0; k < n - 1; ++k) subtract_product<D>(closing_[slot(bundle, k)], x, y[k].x);
  }
  // no two lines of a colour are neighbours, and only one colour is written at a time
  for (int k = 0; k < n; ++k)
    for (std::size_t i = 0; i < N; ++i)
      store_between<S>(y[k].x[i], first, e.q[i].data() + k * layout_.stride);
}

template <int D, class Real>
void LineOperator<D, Real>::smooth(int colour, const Correction<D, Real>& b, Correction<D, Real>& e,
                                   bool from_zero) const {
  const std::size_t begin = layout_.colour_begin(colour),
                    end = layout_.colour_end[static_cast<std::size_t>(colour)];
#pragma omp parallel if (worth_threads(end - begin))
  {
    std::vector<Column> y(static_cast<std::size_t>(layout_.length));
#pragma omp for schedule(static)
    for (std::size_t bundle = begin; bundle < end; ++bundle)
      with_spacing(layout_.bundles[bundle].spacing, [&](auto spacing) {
        constexpr LanePattern s = decltype(spacing)::value;
        if (from_zero)
          smooth_bundle<s, true>(bundle, b, e, y.data());
        else
          smooth_bundle<s, false>(bundle, b, e, y.data());
      });
  }
}

template void LineOperator<2, float>::residual(const Correction<2, float>&, const Correction<2, float>&,
                                               Correction<2, float>&) const;
#define LITTORAL_LINE_OPERATOR(D, Real)                                                                    \
  template void LineOperator<D, Real>::residual_after_sweep(const Correction<D, Real>&,                    \
                                                            Correction<D, Real>&) const;                   \
  template void LineOperator<D, Real>::smooth(int, const Correction<D, Real>&, Correction<D, Real>&, bool) \
      const
template void LineOperator<2, double>::residual(const Correction<2, double>&, const Correction<2, double>&,
                                                Correction<2, double>&) const;
template void LineOperator<3, float>::residual(const Correction<3, float>&, const Correction<3, float>&,
                                               Correction<3, float>&) const;
template void LineOperator<3, double>::residual(const Correction<3, double>&, const Correction<3, double>&,
                                                Correction<3, double>&) const;
LITTORAL_LINE_OPERATOR(2, float);
LITTORAL_LINE_OPERATOR(2, double);
LITTORAL_LINE_OPERATOR(3, float);
LITTORAL_LINE_OPERATOR(3, double);
#undef LITTORAL_LINE_OPERATOR

}  // namespace littoral::fv
