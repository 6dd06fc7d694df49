#pragma once

#include <cstddef>
#include <vector>

#include "bytes.hpp"

namespace littoral::coupler {

/// Bytes that are sent from where they lie.
struct Piece {
  const char* at = nullptr;
  std::size_t bytes = 0;
};

/// A message of columns. A short one is whole in `message`. Of a long one that holds the header and what
/// stands before the columns; the columns follow, each a piece: the caller's own memory where a column is
/// sent in one run, else `gathered`.
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
    for (const Piece& column : columns) writer.column(column.at, column.bytes);
    columns.clear();
  }
};

}  // namespace littoral::coupler
