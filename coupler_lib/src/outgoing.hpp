#pragma once

#include <cstddef>
#include <cstring>
#include <vector>

#include "bytes.hpp"
#include "clip.hpp"

namespace littoral::coupler {

/// Bytes to be sent from where they lie. A column of several runs is brought together just before, while the
/// receiver still fetches the piece in front of it.
struct Piece {
  const char* at = nullptr;
  std::size_t bytes = 0;
  const std::vector<Run>* runs = nullptr;  // null: it lies there already
  const double* column = nullptr;          // what the runs are of
  char* gathered = nullptr;                // the same place as `at`

  Piece(const char* place, std::size_t count) : at(place), bytes(count) {}
  Piece(char* place, std::size_t count, const std::vector<Run>& runs_of, const double* values)
      : at(place), bytes(count), runs(&runs_of), column(values), gathered(place) {}

  void gather() const {
    if (runs == nullptr) return;
    char* to = gathered;
    for (const Run& run : *runs) {
      std::memcpy(to, column + run.first, run.n * sizeof(double));
      to += run.n * sizeof(double);
    }
  }
};

/// A message of columns. A short one is whole in `message`. Of a long one that holds the header and what
/// stands before the columns; the columns follow, each a piece: the caller's own memory where a column is
/// sent in one run, else a part of `gathered`.
struct Outgoing {
  Bytes message, gathered;
  std::vector<Piece> columns;

  std::size_t size() const {
    std::size_t bytes = message.size();
    for (const Piece& column : columns) bytes += column.bytes;
    return bytes;
  }
  /// Columns behind what stands before them.
  void join() {
    ByteWriter writer(message);
    for (const Piece& column : columns) {
      column.gather();
      writer.column(column.at, column.bytes);
    }
    columns.clear();
  }
};

}  // namespace littoral::coupler
