#include "grid/plot3d.hpp"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <optional>
#include <sstream>

#include "grid/plot3d_bytes.hpp"
#include "littoral/error.hpp"

namespace littoral::fv {
namespace {

constexpr std::int64_t k_most_nodes = std::int64_t{1} << 31;

int dimensions(const Plot3dDialect& d) { return d.planar ? 2 : 3; }

/// Bytes of one node: its coordinates and its iblank.
std::int64_t node_bytes(const Plot3dDialect& d) {
  return dimensions(d) * (d.single_precision ? 4 : 8) + (d.iblank ? 4 : 0);
}

/// Sizes of the blocks, if these numbers can be that.
std::optional<std::vector<Plot3dBlock>> blocks_of(const std::vector<std::int64_t>& n, int dimensions) {
  std::vector<Plot3dBlock> blocks(n.size() / static_cast<std::size_t>(dimensions));
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    std::int64_t nodes = 1;
    for (int d = 0; d < dimensions; ++d) {
      const std::int64_t count = n[b * static_cast<std::size_t>(dimensions) + static_cast<std::size_t>(d)];
      if (count < 1 || count > k_most_nodes) return {};
      nodes *= count;
      if (nodes > k_most_nodes) return {};
      blocks[b].n[static_cast<std::size_t>(d)] = static_cast<int>(count);
    }
  }
  if (blocks.empty()) return {};
  return blocks;
}

void read_nodes(ByteReader& in, const Plot3dDialect& d, Plot3dBlock& block) {
  const std::size_t nodes = block.nodes();
  for (int k = 0; k < dimensions(d); ++k) {
    auto& x = block.x[static_cast<std::size_t>(k)];
    x.resize(nodes);
    for (double& value : x)
      value = d.single_precision ? static_cast<double>(in.get<float>()) : in.get<double>();
  }
  if (!d.iblank) return;
  block.iblank.resize(nodes);
  for (int& value : block.iblank) value = in.get<std::int32_t>();
}

/// The file read as this dialect, or nothing where lengths do not fit. precision and iblank of a file with
/// records follow from the record's length, otherwise from the dialect.
std::optional<Plot3dFile> try_binary(const std::string& bytes, Plot3dDialect d) {
  ByteReader in(bytes, d.foreign_bytes);
  const auto begin_record = [&](std::int64_t expected) {  // -1: any
    if (!d.records) return true;
    if (in.left() < 4) return false;
    const auto length = in.get<std::int32_t>();
    return expected < 0 || length == expected;
  };
  const auto end_record = [&](std::int64_t expected) {
    if (!d.records) return true;
    if (in.left() < 4) return false;
    const auto length = in.get<std::int32_t>();
    return expected < 0 || length == expected;
  };
  std::int64_t n_blocks = 1;
  if (d.multi_block) {
    if (!begin_record(4) || in.left() < 4) return {};
    n_blocks = in.get<std::int32_t>();
    if (!end_record(4)) return {};
  }
  const std::int64_t size_bytes = 4 * n_blocks * dimensions(d);
  if (n_blocks < 1 || size_bytes > static_cast<std::int64_t>(in.left())) return {};
  if (!begin_record(size_bytes) || size_bytes > static_cast<std::int64_t>(in.left())) return {};
  std::vector<std::int64_t> n;
  for (std::int64_t i = 0; i < n_blocks * dimensions(d); ++i) n.push_back(in.get<std::int32_t>());
  if (!end_record(size_bytes)) return {};
  auto blocks = blocks_of(n, dimensions(d));
  if (!blocks) return {};
  std::int64_t rest = 0;
  for (const auto& block : *blocks)
    rest += static_cast<std::int64_t>(block.nodes()) * node_bytes(d) + (d.records ? 8 : 0);
  if (rest != static_cast<std::int64_t>(in.left())) return {};
  for (auto& block : *blocks) {
    const auto length = static_cast<std::int64_t>(block.nodes()) * node_bytes(d);
    // a record's length is written in 31 bits; of larger records it says nothing
    const std::int64_t said = length <= std::numeric_limits<std::int32_t>::max() ? length : -1;
    if (!begin_record(said)) return {};
    read_nodes(in, d, block);
    if (!end_record(said)) return {};
  }
  return Plot3dFile{std::move(*blocks), d};
}

bool plausible(const Plot3dFile& file) {
  for (const auto& block : file.blocks)
    for (const auto& x : block.x)
      for (double value : x)
        if (!std::isfinite(value) || std::abs(value) > 1e30) return false;
  return true;
}

std::optional<Plot3dFile> read_binary(const std::string& bytes) {
  for (const bool records : {true, false})
    for (const bool foreign : {false, true})
      for (const bool multi : {true, false})
        for (const bool planar : {false, true})
          for (const bool single : {false, true})
            for (const bool iblank : {false, true}) {
              auto file = try_binary(bytes, {false, records, single, multi, iblank, planar, foreign});
              if (file && plausible(*file)) return file;
            }
  return {};
}

/// All numbers of a text, Fortran's repeats (3*1.0) and exponents (1.0D-3) included; nothing where there is
/// anything else.
std::optional<std::vector<double>> numbers_of(const std::string& text) {
  constexpr std::size_t k_most_values = std::size_t{1} << 29;  // 4 GiB: beyond it a repeat is a mistake
  std::vector<double> values;
  std::string word;
  const auto flush = [&] {
    if (word.empty()) return true;
    for (char& c : word)
      if (c == 'd' || c == 'D') c = 'e';
    std::size_t repeats = 1;
    const std::size_t star = word.find('*');
    char* end = nullptr;
    if (star != std::string::npos) {
      repeats = std::strtoul(word.c_str(), &end, 10);
      if (end != word.c_str() + star) return false;
      word = word.substr(star + 1);
    }
    const double value = std::strtod(word.c_str(), &end);
    if (end != word.c_str() + word.size() || word.empty()) return false;
    if (repeats == 0 || repeats > k_most_values - values.size()) return false;
    values.insert(values.end(), repeats, value);
    word.clear();
    return true;
  };
  for (const char c : text) {
    if (c == ' ' || c == '\n' || c == '\t' || c == '\r' || c == ',') {
      if (!flush()) return {};
    } else {
      word.push_back(c);
    }
  }
  if (!flush()) return {};
  return values;
}

std::optional<Plot3dFile> try_text(const std::vector<double>& v, Plot3dDialect d) {
  std::size_t at = 0;
  const auto whole = [&](std::int64_t& value) {
    if (at >= v.size() || v[at] != std::floor(v[at]) || std::abs(v[at]) > 1e15) return false;
    value = static_cast<std::int64_t>(v[at++]);
    return true;
  };
  std::int64_t n_blocks = 1;
  if (d.multi_block && !whole(n_blocks)) return {};
  if (n_blocks < 1 || n_blocks * dimensions(d) > static_cast<std::int64_t>(v.size())) return {};
  std::vector<std::int64_t> n(static_cast<std::size_t>(n_blocks * dimensions(d)));
  for (auto& value : n)
    if (!whole(value)) return {};
  auto blocks = blocks_of(n, dimensions(d));
  if (!blocks) return {};
  std::size_t rest = 0;
  for (const auto& block : *blocks)
    rest += block.nodes() * static_cast<std::size_t>(dimensions(d) + (d.iblank ? 1 : 0));
  if (rest != v.size() - at) return {};
  for (auto& block : *blocks) {
    for (int k = 0; k < dimensions(d); ++k) {
      auto& x = block.x[static_cast<std::size_t>(k)];
      x.assign(v.begin() + static_cast<std::ptrdiff_t>(at),
               v.begin() + static_cast<std::ptrdiff_t>(at + block.nodes()));
      at += block.nodes();
    }
    if (d.iblank)
      for (std::size_t i = 0; i < block.nodes(); ++i) block.iblank.push_back(static_cast<int>(v[at++]));
  }
  return Plot3dFile{std::move(*blocks), d};
}

std::optional<Plot3dFile> read_text(const std::string& text) {
  const auto values = numbers_of(text);
  if (!values) return {};
  for (const bool multi : {true, false})
    for (const bool planar : {false, true})
      for (const bool iblank : {false, true}) {
        auto file = try_text(*values, {true, false, false, multi, iblank, planar, false});
        if (file && plausible(*file)) return file;
      }
  return {};
}

bool looks_like_text(const std::string& bytes) {
  constexpr std::size_t k_enough = 4096;
  for (std::size_t i = 0; i < std::min(bytes.size(), k_enough); ++i) {
    const auto c = static_cast<unsigned char>(bytes[i]);
    if (c < 32 ? !(c == '\n' || c == '\r' || c == '\t') : c > 126) return false;
  }
  return true;
}

bool little_endian_machine() {
  const std::uint16_t one = 1;
  unsigned char first = 0;
  std::memcpy(&first, &one, 1);
  return first == 1;
}

void write_text_block(std::ostream& out, const Plot3dBlock& block, const Plot3dDialect& d) {
  constexpr std::size_t k_per_line = 4;
  out.precision(d.single_precision ? std::numeric_limits<float>::max_digits10
                                   : std::numeric_limits<double>::max_digits10);
  for (int k = 0; k < dimensions(d); ++k) {
    const auto& x = block.x[static_cast<std::size_t>(k)];
    for (std::size_t i = 0; i < x.size(); ++i)
      out << x[i] << ((i + 1) % k_per_line == 0 || i + 1 == x.size() ? '\n' : ' ');
  }
  if (!d.iblank) return;
  for (std::size_t i = 0; i < block.nodes(); ++i)
    out << (block.iblank.empty() ? 1 : block.iblank[i]) << (i + 1 == block.nodes() ? '\n' : ' ');
}

std::string to_text(const Plot3dFile& file) {
  const Plot3dDialect& d = file.dialect;
  std::ostringstream out;
  if (d.multi_block) out << file.blocks.size() << '\n';
  for (const auto& block : file.blocks)
    for (int k = 0; k < dimensions(d); ++k)
      out << block.n[static_cast<std::size_t>(k)] << (k + 1 == dimensions(d) ? '\n' : ' ');
  for (const auto& block : file.blocks) write_text_block(out, block, d);
  return out.str();
}

std::string to_bytes(const Plot3dFile& file) {
  const Plot3dDialect& d = file.dialect;
  std::string bytes;
  const auto record = [&](const std::string& content) {
    const auto length = static_cast<std::int32_t>(content.size());
    if (d.records) put(bytes, length, d.foreign_bytes);
    bytes += content;
    if (d.records) put(bytes, length, d.foreign_bytes);
  };
  std::string content;
  if (d.multi_block) {
    put(content, static_cast<std::int32_t>(file.blocks.size()), d.foreign_bytes);
    record(content);
    content.clear();
  }
  for (const auto& block : file.blocks)
    for (int k = 0; k < dimensions(d); ++k)
      put(content, static_cast<std::int32_t>(block.n[static_cast<std::size_t>(k)]), d.foreign_bytes);
  record(content);
  for (const auto& block : file.blocks) {
    content.clear();
    for (int k = 0; k < dimensions(d); ++k)
      for (const double value : block.x[static_cast<std::size_t>(k)]) {
        if (d.single_precision)
          put(content, static_cast<float>(value), d.foreign_bytes);
        else
          put(content, value, d.foreign_bytes);
      }
    if (d.iblank)
      for (std::size_t i = 0; i < block.nodes(); ++i)
        put(content, static_cast<std::int32_t>(block.iblank.empty() ? 1 : block.iblank[i]), d.foreign_bytes);
    record(content);
  }
  return bytes;
}

}  // namespace

std::string describe(const Plot3dFile& file) {
  const Plot3dDialect& d = file.dialect;
  std::string text = d.formatted ? "formatted"
                     : d.records ? "unformatted (Fortran records)"
                                 : "unformatted (plain stream)";
  if (!d.formatted) {
    text += d.single_precision ? ", single precision" : ", double precision";
    text += little_endian_machine() != d.foreign_bytes ? ", little-endian" : ", big-endian";
  }
  text +=
      d.multi_block ? ", " + std::to_string(file.blocks.size()) + " blocks" : ", one block without a count";
  text += d.planar ? " in a plane" : " in space";
  if (d.iblank) {
    std::size_t holes = 0, nodes = 0;
    for (const auto& block : file.blocks) {
      nodes += block.nodes();
      holes += static_cast<std::size_t>(std::count(block.iblank.begin(), block.iblank.end(), 0));
    }
    text += ", with iblank (" + std::to_string(holes) + " of " + std::to_string(nodes) + " nodes blanked)";
  }
  return text;
}

Plot3dFile read_plot3d(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in) throw IoError(path + ": cannot be read: " + std::strerror(errno));
  std::ostringstream content;
  content << in.rdbuf();
  const std::string bytes = content.str();
  auto file = looks_like_text(bytes) ? read_text(bytes) : read_binary(bytes);
  if (!file)
    throw ConfigError(
        path + ": no PLOT3D grid: its " + std::to_string(bytes.size()) +
        " bytes fit none of formatted or unformatted, Fortran records or stream, single or double "
        "precision, one or several blocks, with or without iblank, either byte order. Is the file "
        "complete, and is it the grid (not the solution)?");
  return std::move(*file);
}

void write_plot3d(const std::string& path, const Plot3dFile& file) {
  std::ofstream out(path, std::ios::binary);
  out << (file.dialect.formatted ? to_text(file) : to_bytes(file));
  out.close();
  if (!out) throw IoError(path + ": cannot be written");
}

}  // namespace littoral::fv
