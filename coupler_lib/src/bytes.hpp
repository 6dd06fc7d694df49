#pragma once

#include <cstdint>
#include <cstring>
#include <memory>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "littoral/error.hpp"

namespace littoral::coupler {

/// Leaves new elements uninitialised: a message buffer that shrinks and grows again is not cleared each time.
template <class T>
struct UninitializedAllocator : std::allocator<T> {
  template <class U>
  struct rebind {
    using other = UninitializedAllocator<U>;
  };
  template <class U>
  void construct(U*) noexcept {}
  template <class U, class... Arguments>
  void construct(U* at, Arguments&&... arguments) {
    ::new (static_cast<void*>(at)) U(std::forward<Arguments>(arguments)...);
  }
};
using Bytes = std::vector<char, UninitializedAllocator<char>>;

/// Appends to a buffer that keeps its memory from message to message.
template <class Buffer>
class ByteWriter {
 public:
  explicit ByteWriter(Buffer& bytes) : bytes_(bytes) {}
  template <class T>
  void value(const T& v) {
    static_assert(std::is_trivially_copyable_v<T>);
    std::memcpy(reserve(sizeof v), &v, sizeof v);
  }
  void text(const std::string& text) {
    value(static_cast<std::uint32_t>(text.size()));
    if (!text.empty()) std::memcpy(reserve(text.size()), text.data(), text.size());
  }
  template <class T>
  void column(const T* values, std::size_t n) {
    if (n > 0) std::memcpy(reserve(n * sizeof(T)), values, n * sizeof(T));
  }
  template <class T>
  void column(const std::vector<T>& values) {
    column(values.data(), values.size());
  }
  /// Room for `count` bytes, to be filled by the caller at once.
  char* reserve(std::size_t count) {
    const std::size_t at = bytes_.size();
    bytes_.resize(at + count);
    return bytes_.data() + at;
  }

 private:
  Buffer& bytes_;
};

/// Reads forward and never past the end. throws CouplingError "<what>: ..."
class ByteReader {
 public:
  ByteReader(const char* bytes, std::size_t count, const char* what)
      : at_(bytes), left_(count), what_(what) {}
  const char* take(std::size_t count) {
    if (count > left_) refuse("the message ends too early");
    const char* begin = at_;
    at_ += count;
    left_ -= count;
    return begin;
  }
  template <class T>
  T value() {
    static_assert(std::is_trivially_copyable_v<T>);
    T result;
    std::memcpy(&result, take(sizeof result), sizeof result);
    return result;
  }
  std::string text() {
    const auto length = value<std::uint32_t>();
    return std::string(take(length), length);
  }
  template <class T>
  void column(T* values, std::size_t n) {
    if (n > left_ / sizeof(T)) refuse("a column is longer than the message");
    const char* begin = take(n * sizeof(T));
    if (n > 0) std::memcpy(values, begin, n * sizeof(T));
  }
  template <class T>
  void column(std::vector<T>& values, std::size_t n) {
    if (n > left_ / sizeof(T)) refuse("a column is longer than the message");  // before memory is asked for
    values.resize(n);
    column(values.data(), n);
  }
  std::size_t left() const { return left_; }
  void expect_end() const {
    if (left_ != 0) refuse("bytes follow the end");
  }
  [[noreturn]] void refuse(const char* why) const { throw CouplingError(std::string(what_) + ": " + why); }

 private:
  const char* at_;
  std::size_t left_;
  const char* what_;
};

}  // namespace littoral::coupler
