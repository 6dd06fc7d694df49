#pragma once

#include <mpi.h>

#include <array>
#include <cstddef>
#include <memory>
#include <string>
#include <vector>

namespace littoral::fv {

/// What a rank has sent to others since the start.
struct Traffic {
  double messages = 0.0, bytes = 0.0;  // of halos
  double sums = 0.0;                   // over all ranks: sums, maxima, votes
};

/// The ranks of this program. Made without a communicator it is one rank, and no function needs MPI.
/// Every function is collective where there are several ranks: called by all of them in the same order.
class Ranks {
 public:
  Ranks() = default;
  explicit Ranks(MPI_Comm comm);

  int rank() const { return rank_; }
  int size() const { return size_; }
  bool several() const { return size_ > 1; }
  bool root() const { return rank_ == 0; }
  MPI_Comm comm() const { return comm_; }

  /// Shared by all copies; none on one rank.
  const std::shared_ptr<Traffic>& traffic() const { return traffic_; }

  /// Each value becomes the sum over all ranks, added in their order: the same bits everywhere and again.
  void sum(double* values, std::size_t n) const;
  template <std::size_t N>
  void sum(std::array<double, N>& values) const {
    sum(values.data(), N);
  }
  double sum(double value) const;
  double largest(double value) const;
  bool any(bool here) const;

  /// What all ranks give, one after the other; counts: of each rank, if wanted.
  template <class T>
  std::vector<T> gather(const std::vector<T>& mine, std::vector<std::size_t>* counts = nullptr) const {
    return cast<T>(gather_bytes(mine.data(), mine.size() * sizeof(T), counts), sizeof(T), counts);
  }
  /// mine[r] goes to rank r; returns what each rank gave.
  template <class T>
  std::vector<std::vector<T>> swap(const std::vector<std::vector<T>>& mine) const;

  /// Runs body on every rank. Where it throws Error on any, all throw the message of the lowest of those.
  template <class Error, class Body>
  void together(Body&& body) const {
    std::string problem;
    bool failed = false;
    try {
      body();
    } catch (const Error& error) {
      if (size_ == 1) throw;
      problem = error.what();
      failed = true;
    }
    if (size_ > 1 && agree_on(failed, problem)) throw Error(problem);
  }

 private:
  std::vector<char> gather_bytes(const void* mine, std::size_t bytes, std::vector<std::size_t>* counts) const;
  std::vector<std::vector<char>> swap_bytes(const std::vector<std::vector<char>>& mine) const;
  /// True where any rank failed; `problem` then is that of the lowest.
  bool agree_on(bool failed, std::string& problem) const;
  template <class T>
  static std::vector<T> cast(const std::vector<char>& bytes, std::size_t size,
                             std::vector<std::size_t>* counts) {
    if (counts != nullptr)
      for (std::size_t& n : *counts) n /= size;
    const T* first = reinterpret_cast<const T*>(bytes.data());
    return std::vector<T>(first, first + bytes.size() / size);
  }

  MPI_Comm comm_ = MPI_COMM_NULL;
  int rank_ = 0, size_ = 1;
  std::shared_ptr<Traffic> traffic_;
};

template <class T>
std::vector<std::vector<T>> Ranks::swap(const std::vector<std::vector<T>>& mine) const {
  std::vector<std::vector<char>> out;
  for (const auto& part : mine) {
    const char* first = reinterpret_cast<const char*>(part.data());
    out.emplace_back(first, first + part.size() * sizeof(T));
  }
  std::vector<std::vector<T>> theirs;
  for (const auto& bytes : swap_bytes(out)) theirs.push_back(cast<T>(bytes, sizeof(T), nullptr));
  return theirs;
}

}  // namespace littoral::fv
