#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>

namespace littoral::fv {

/// Numbers out of a byte string, in either byte order.
class ByteReader {
 public:
  ByteReader(const std::string& bytes, bool foreign) : bytes_(bytes), foreign_(foreign) {}
  std::size_t at = 0;
  std::size_t left() const { return bytes_.size() - at; }

  template <class T>
  T get() {
    unsigned char raw[sizeof(T)];
    for (std::size_t i = 0; i < sizeof(T); ++i)
      raw[i] = static_cast<unsigned char>(bytes_[at + (foreign_ ? sizeof(T) - 1 - i : i)]);
    at += sizeof(T);
    T value;
    std::memcpy(&value, raw, sizeof(T));
    return value;
  }

 private:
  const std::string& bytes_;
  bool foreign_;
};

template <class T>
void put(std::string& bytes, T value, bool foreign) {
  char raw[sizeof(T)];
  std::memcpy(raw, &value, sizeof(T));
  for (std::size_t i = 0; i < sizeof(T); ++i) bytes.push_back(raw[foreign ? sizeof(T) - 1 - i : i]);
}

}  // namespace littoral::fv
