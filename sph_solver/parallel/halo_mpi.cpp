#include "parallel/halo_mpi.hpp"

#include <algorithm>
#include <cstring>
#include <limits>

namespace littoral::sph {
namespace {

constexpr int k_tag_count = 11, k_tag_halo = 12;

template <int D>
RankBox<D> box_of(const Particles<D>& particles) {
  RankBox<D> box;
  box.lower.fill(std::numeric_limits<double>::infinity());
  box.upper.fill(-std::numeric_limits<double>::infinity());
  for (std::size_t d = 0; d < D; ++d)
    for (std::size_t i = 0; i < particles.n_owned; ++i) {
      box.lower[d] = std::min(box.lower[d], particles.x[d][i]);
      box.upper[d] = std::max(box.upper[d], particles.x[d][i]);
    }
  return box;
}

int as_int(std::size_t n) { return static_cast<int>(n); }

}  // namespace

template <int D>
void Halo<D>::find_links(const Particles<D>& particles, double reach, const RankBox<D>& wants) {
  int size = 1, rank = 0;
  MPI_Comm_size(comm_, &size);
  MPI_Comm_rank(comm_, &rank);
  const HaloBoxes<D> mine{box_of(particles), wants};
  std::vector<HaloBoxes<D>> boxes(static_cast<std::size_t>(size));
  constexpr int k_numbers = 4 * D;
  static_assert(sizeof(HaloBoxes<D>) == k_numbers * sizeof(double), "boxes cross as plain numbers");
  MPI_Allgather(&mine, k_numbers, MPI_DOUBLE, boxes.data(), k_numbers, MPI_DOUBLE, comm_);

  std::size_t n = 0;
  std::vector<Link> old = std::move(links_);  // their buffers are kept
  links_.clear();
  for (int other = 0; other < size; ++other) {
    if (other == rank) continue;
    const auto& theirs = boxes[static_cast<std::size_t>(other)];
    bool meets = false;
    for (const auto& shift : shifts_)
      meets = meets || may_reach<D>(mine.holds, shift, theirs.wants, reach) ||
              may_reach<D>(theirs.holds, shift, mine.wants, reach);
    if (!meets) continue;
    if (n < old.size()) {
      links_.push_back(std::move(old[n]));
    } else {
      links_.emplace_back();
    }
    ++n;
    Link& link = links_.back();
    link.rank = other;
    link.gives.clear();
    choose_halo<D>(particles, mine, shifts_, theirs.wants, reach, link.gives);
  }

  std::vector<std::int64_t> counts_out(links_.size()), counts_in(links_.size());
  requests_.assign(2 * links_.size(), MPI_REQUEST_NULL);
  for (std::size_t k = 0; k < links_.size(); ++k) {
    counts_out[k] = static_cast<std::int64_t>(links_[k].gives.size());
    MPI_Irecv(&counts_in[k], 1, MPI_INT64_T, links_[k].rank, k_tag_count, comm_, &requests_[2 * k]);
    MPI_Isend(&counts_out[k], 1, MPI_INT64_T, links_[k].rank, k_tag_count, comm_, &requests_[2 * k + 1]);
  }
  MPI_Waitall(as_int(requests_.size()), requests_.data(), MPI_STATUSES_IGNORE);
  n_halo_ = 0;
  for (std::size_t k = 0; k < links_.size(); ++k) {
    links_[k].takes = static_cast<std::size_t>(counts_in[k]);
    links_[k].first = n_halo_;
    n_halo_ += links_[k].takes;
  }
}

template <int D>
template <class Pack, class Unpack>
void Halo<D>::exchange(std::size_t width, const Pack& pack, const Unpack& unpack) {
  const double begin = MPI_Wtime();
  requests_.assign(2 * links_.size(), MPI_REQUEST_NULL);
  for (std::size_t k = 0; k < links_.size(); ++k) {
    Link& link = links_[k];
    if (link.takes == 0) continue;
    link.in.resize(std::max(link.in.size(), width * link.takes));
    MPI_Irecv(link.in.data(), as_int(width * link.takes), MPI_DOUBLE, link.rank, k_tag_halo, comm_,
              &requests_[2 * k]);
  }
  for (std::size_t k = 0; k < links_.size(); ++k) {
    Link& link = links_[k];
    if (link.gives.empty()) continue;
    link.out.resize(std::max(link.out.size(), width * link.gives.size()));
    double* place = link.out.data();
    const auto n = static_cast<std::ptrdiff_t>(link.gives.size());
#pragma omp parallel for schedule(static)
    for (std::ptrdiff_t e = 0; e < n; ++e)
      pack(link.gives[static_cast<std::size_t>(e)], place + static_cast<std::size_t>(e) * width);
    MPI_Isend(link.out.data(), as_int(width * link.gives.size()), MPI_DOUBLE, link.rank, k_tag_halo, comm_,
              &requests_[2 * k + 1]);
    ++traffic_.messages;
    traffic_.bytes += static_cast<double>(sizeof(double) * width * link.gives.size());
  }
  MPI_Waitall(as_int(requests_.size()), requests_.data(), MPI_STATUSES_IGNORE);
  for (const Link& link : links_) {
    const double* place = link.in.data();
    const auto n = static_cast<std::ptrdiff_t>(link.takes);
#pragma omp parallel for schedule(static)
    for (std::ptrdiff_t c = 0; c < n; ++c)
      unpack(link.first + static_cast<std::size_t>(c), place + static_cast<std::size_t>(c) * width);
  }
  ++traffic_.refreshes;
  traffic_.seconds += MPI_Wtime() - begin;
}

template <int D>
std::size_t Halo<D>::create(Particles<D>& particles, double reach, const RankBox<D>& wants) {
  find_links(particles, reach, wants);
  particles.resize_ghosts(n_halo_);
  const std::size_t n = particles.n_owned;
  exchange(
      2,
      [&](const HaloEntry& entry, double* to) {
        const auto i = static_cast<std::size_t>(entry.particle);
        to[0] = particles.m[i];
        std::memcpy(to + 1, &particles.id[i], sizeof(double));
      },
      [&](std::size_t h, const double* from) {
        particles.m[n + h] = from[0];
        std::memcpy(&particles.id[n + h], from + 1, sizeof(double));
      });
  refresh(particles);
  return n_halo_;
}

template <int D>
void Halo<D>::refresh(Particles<D>& particles) {
  const std::size_t n = particles.n_owned;
  exchange(
      2 * D + 3,
      [&](const HaloEntry& entry, double* to) {
        const auto i = static_cast<std::size_t>(entry.particle);
        const auto& shift = shifts_[static_cast<std::size_t>(entry.shift)];
        for (std::size_t d = 0; d < D; ++d) *to++ = particles.x[d][i] + shift[d];
        for (std::size_t d = 0; d < D; ++d) *to++ = particles.u[d][i];
        *to++ = particles.V[i];
        *to++ = particles.rho[i];
        *to++ = particles.p[i];
      },
      [&](std::size_t h, const double* from) {
        for (std::size_t d = 0; d < D; ++d) particles.x[d][n + h] = *from++;
        for (std::size_t d = 0; d < D; ++d) particles.u[d][n + h] = *from++;
        particles.V[n + h] = *from++;
        particles.rho[n + h] = *from++;
        particles.p[n + h] = *from++;
      });
}

template <int D>
template <class Real>
void Halo<D>::refresh(PairRows<D, Real>& rows) {
  using Rows = PairRows<D, Real>;
  constexpr std::size_t k_numbers = Rows::k_n_face - Rows::k_grad_p;
  constexpr std::size_t k_width = (k_numbers * sizeof(Real) + sizeof(double) - 1) / sizeof(double);
  exchange(
      k_width,
      [&](const HaloEntry& entry, double* to) {
        std::memcpy(to, rows.face(static_cast<std::size_t>(entry.particle)).q + Rows::k_grad_p,
                    k_numbers * sizeof(Real));
      },
      [&](std::size_t h, const double* from) {
        std::memcpy(rows.face(rows.n_owned() + h).q + Rows::k_grad_p, from, k_numbers * sizeof(Real));
      });
}

template <int D>
void Halo<D>::refresh(const std::vector<std::vector<double>*>& columns, std::size_t n_owned) {
  exchange(
      columns.size(),
      [&](const HaloEntry& entry, double* to) {
        for (const auto* column : columns) *to++ = (*column)[static_cast<std::size_t>(entry.particle)];
      },
      [&](std::size_t h, const double* from) {
        for (auto* column : columns) (*column)[n_owned + h] = *from++;
      });
}

template class Halo<2>;
template class Halo<3>;
template void Halo<2>::refresh(PairRows<2, double>&);
template void Halo<2>::refresh(PairRows<2, float>&);
template void Halo<3>::refresh(PairRows<3, double>&);
template void Halo<3>::refresh(PairRows<3, float>&);

}  // namespace littoral::sph
