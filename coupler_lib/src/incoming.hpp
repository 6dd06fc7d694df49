#pragma once

#include <mpi.h>

#include <cstdint>
#include <string>
#include <vector>

#include "bytes.hpp"
#include "wire.hpp"

namespace littoral::coupler {

/// Where a piece of a message belongs.
struct Slot {
  char* at = nullptr;
  std::size_t bytes = 0;
  bool numbers = false;    // doubles, which are looked through on arrival, while the cache holds them
  bool all_finite = true;  // what was found
};

/// A message that is awaited of one rank of the partner. With `slots` its content goes piece by piece where
/// it belongs and is not copied again; without them it is in the buffer, behind the header.
class Incoming {
 public:
  std::vector<Slot> slots;

  /// Before it is looked for. `who`: the sender, in error messages
  void expect(MPI_Comm intercomm, int rank, const Expected& expected, std::string who);
  /// Moves it as far as it goes now; true when it is here. throws CouplingError: it is not what is due
  bool progress();
  bool here() const { return state_ == State::here; }
  /// Bytes are on their way.
  bool moving() const { return state_ == State::whole || state_ == State::piece; }
  /// Before an error leaves: true when MPI no longer writes into our memory.
  bool settled();

  const Header& header() const { return header_; }
  const char* content() const { return buffer_.data() + sizeof(Header); }
  std::size_t content_size() const { return buffer_.size() - sizeof(Header); }
  Bytes& buffer() { return buffer_; }

 private:
  enum class State : std::uint8_t { awaited, whole, asked, piece, here };
  void begin();        // something has come
  void take_whole();   // a short message is here
  void begin_piece();  // of the rest of a long one

  MPI_Comm intercomm_ = MPI_COMM_NULL;
  int rank_ = 0;
  Expected expected_;
  std::string who_;
  State state_ = State::here;
  MPI_Request request_ = MPI_REQUEST_NULL;
  Bytes buffer_;
  Header header_;
  std::size_t piece_ = 0;  // the one that is due
};

/// Puts a content that came in one piece where it belongs. throws CouplingError: other lengths than the
/// slots'
void scatter(const char* content, std::size_t count, std::vector<Slot>& slots, const std::string& who,
             const std::string& what);

}  // namespace littoral::coupler
