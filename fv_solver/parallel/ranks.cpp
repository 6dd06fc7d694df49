#include "parallel/ranks.hpp"

#include <algorithm>

namespace littoral::fv {
namespace {
constexpr int k_tag_swap = 31;
}

Ranks::Ranks(MPI_Comm comm) : comm_(comm) {
  MPI_Comm_rank(comm_, &rank_);
  MPI_Comm_size(comm_, &size_);
  if (size_ > 1) traffic_ = std::make_shared<Traffic>();
}

void Ranks::sum(double* values, std::size_t n) const {
  if (size_ == 1) return;
  traffic_->sums += 1.0;
  std::vector<double> all(n * static_cast<std::size_t>(size_));
  const int count = static_cast<int>(n);
  MPI_Allgather(values, count, MPI_DOUBLE, all.data(), count, MPI_DOUBLE, comm_);
  std::fill(values, values + n, 0.0);
  for (std::size_t i = 0; i < all.size(); ++i) values[i % n] += all[i];
}

double Ranks::sum(double value) const {
  sum(&value, 1);
  return value;
}

double Ranks::largest(double value) const {
  if (size_ == 1) return value;
  traffic_->sums += 1.0;
  MPI_Allreduce(MPI_IN_PLACE, &value, 1, MPI_DOUBLE, MPI_MAX, comm_);
  return value;
}

bool Ranks::any(bool here) const {
  if (size_ == 1) return here;
  traffic_->sums += 1.0;
  int flag = here ? 1 : 0;
  MPI_Allreduce(MPI_IN_PLACE, &flag, 1, MPI_INT, MPI_MAX, comm_);
  return flag != 0;
}

bool Ranks::agree_on(bool failed, std::string& problem) const {
  if (size_ == 1) return failed;
  traffic_->sums += 1.0;
  int first = failed ? rank_ : size_;
  MPI_Allreduce(MPI_IN_PLACE, &first, 1, MPI_INT, MPI_MIN, comm_);
  if (first == size_) return false;
  int length = static_cast<int>(problem.size());
  MPI_Bcast(&length, 1, MPI_INT, first, comm_);
  problem.resize(static_cast<std::size_t>(length));
  MPI_Bcast(problem.data(), length, MPI_CHAR, first, comm_);
  return true;
}

std::vector<char> Ranks::gather_bytes(const void* mine, std::size_t bytes,
                                      std::vector<std::size_t>* counts) const {
  const char* first = static_cast<const char*>(mine);
  if (size_ == 1) {
    if (counts != nullptr) *counts = {bytes};
    return std::vector<char>(first, first + bytes);
  }
  std::vector<std::vector<char>> out(static_cast<std::size_t>(size_),
                                     std::vector<char>(first, first + bytes));
  std::vector<char> all;
  if (counts != nullptr) counts->clear();
  for (const auto& part : swap_bytes(out)) {
    all.insert(all.end(), part.begin(), part.end());
    if (counts != nullptr) counts->push_back(part.size());
  }
  return all;
}

std::vector<std::vector<char>> Ranks::swap_bytes(const std::vector<std::vector<char>>& mine) const {
  if (size_ == 1) return mine;
  // by messages to each rank, whose lengths need not fit into the displacements of an MPI_Alltoallv
  std::vector<long> gives, takes(mine.size());
  for (const auto& part : mine) gives.push_back(static_cast<long>(part.size()));
  MPI_Alltoall(gives.data(), 1, MPI_LONG, takes.data(), 1, MPI_LONG, comm_);
  std::vector<std::vector<char>> theirs;
  for (const long n : takes) theirs.emplace_back(static_cast<std::size_t>(n));
  std::vector<MPI_Request> requests;
  for (int r = 0; r < size_; ++r) {
    const auto at = static_cast<std::size_t>(r);
    if (r == rank_) {
      theirs[at] = mine[at];
      continue;
    }
    if (takes[at] > 0) {
      requests.emplace_back();
      MPI_Irecv(theirs[at].data(), static_cast<int>(takes[at]), MPI_CHAR, r, k_tag_swap, comm_,
                &requests.back());
    }
    if (gives[at] > 0) {
      requests.emplace_back();
      MPI_Isend(mine[at].data(), static_cast<int>(gives[at]), MPI_CHAR, r, k_tag_swap, comm_,
                &requests.back());
    }
  }
  MPI_Waitall(static_cast<int>(requests.size()), requests.data(), MPI_STATUSES_IGNORE);
  return theirs;
}

}  // namespace littoral::fv
