#include "document.hpp"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <sstream>

#include "littoral/error.hpp"

namespace littoral::support {
namespace {

constexpr std::size_t k_max_bytes = std::size_t{16}
                                    << 20;  // far more than a scene; stops a read of a data file

/// YAML is text in UTF-8; a data file given by mistake is named as such before the parser stumbles on it.
void require_text(const std::string& bytes, const std::string& name) {
  int follow = 0;  // continuation bytes still due
  int line = 1;
  for (const char c : bytes) {
    const auto byte = static_cast<unsigned char>(c);
    bool good = true;
    if (follow > 0) {
      good = (byte & 0xC0U) == 0x80U;
      --follow;
    } else if (byte >= 0x80U) {
      follow = byte >= 0xF0U ? 3 : byte >= 0xE0U ? 2 : 1;
      good = byte >= 0xC2U && byte <= 0xF4U;
    } else {
      good = byte >= 0x20U || c == '\t' || c == '\n' || c == '\r';
    }
    if (!good)
      throw ConfigError(name + ":" + std::to_string(line) + ": not a text file (byte " +
                        std::to_string(byte) + "). Expected YAML in UTF-8.");
    if (c == '\n') ++line;
  }
}

}  // namespace

Document Document::from_text(const std::string& text, const std::string& name) {
  require_text(text, name);
  Document document;
  document.impl = std::make_shared<Impl>();
  document.impl->name = name;
  Value& root = document.impl->root;
  root = parse_yaml(text, name, document.impl->problems);
  if (root.kind == Value::Kind::null)
    throw ConfigError(name + ": the file is empty. Expected keys and values, as in 'title: My wave'.");
  if (root.kind != Value::Kind::map)
    throw ConfigError(name + ": holds " + root.description() +
                      " at the top. Expected keys and values, as in 'title: My wave'.");
  return document;
}

Document Document::from_file(const std::string& path) {
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored))
    throw ConfigError(path + ": is a folder. Expected a YAML file.");
  errno = 0;
  std::ifstream file(path, std::ios::binary);
  if (!file) throw ConfigError(path + ": cannot open: " + std::strerror(errno) + ".");
  std::string text;
  std::string chunk(std::size_t{1} << 16, '\0');
  while (file.read(chunk.data(), static_cast<std::streamsize>(chunk.size())) || file.gcount() > 0) {
    text.append(chunk, 0, static_cast<std::size_t>(file.gcount()));
    if (text.size() > k_max_bytes)
      throw ConfigError(path + ": larger than 16 MB. Expected a YAML configuration, not a data file.");
  }
  return from_text(text, path);
}

void Document::set(const std::string& assignment) {
  const std::string where = "--set " + assignment;
  const std::size_t equals = assignment.find('=');
  if (equals == std::string::npos || equals == 0)
    throw ConfigError(where + ": expected KEY=VALUE, as in --set time.end=2.5");
  require_text(assignment, where);
  const Place place{where, std::numeric_limits<int>::max() / 2 + impl->n_settings++};
  put(impl->root, assignment.substr(0, equals), parse_setting_value(assignment.substr(equals + 1), place),
      where);
}

const std::string& Document::name() const { return impl->name; }

std::string Document::resolve(const std::string& relative) const {
  const std::filesystem::path path(relative);
  if (path.is_absolute()) return relative;
  return (std::filesystem::path(impl->name).parent_path() / path).lexically_normal().string();
}

}  // namespace littoral::support
