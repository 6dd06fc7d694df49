#pragma once

#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "document.hpp"
#include "littoral/support/config.hpp"

namespace littoral::support {

/// Thrown by a key's reader: what is wrong with the value, without place and key.
struct BadValue {
  std::string text;
};

struct Binder::Impl {
  explicit Impl(Mode m) : mode(m) {}

  Mode mode;
  std::optional<Document> document;

  /// The section being declared: its dotted path and, in read mode, its part of the document (null: absent).
  struct Frame {
    std::string path;
    const Value* value = nullptr;
  };
  std::vector<Frame> frames{Frame{}};

  std::map<std::string, std::vector<std::string>> known;  // section path -> names declared there
  std::map<std::string, double> constants;
  std::vector<Problem> problems;
  std::set<std::string> faulty;  // paths that had a problem

  std::vector<std::string> lines;  // of help or resolved text
  int indent = 0;
  bool at_dash = false;  // the next line opens a list item

  std::string path_of(const std::string& name) const;
  /// Records that `name` is a key of the current section and returns its value, null if absent.
  const Value* declare(const std::string& name);
  void report(const Place& place, const std::string& path, const std::string& text);
  void report_missing(const std::string& name, const std::string& expected);
  /// The unknown keys of the whole document.
  std::vector<Problem> unknown_keys() const;
  void find_unknown(const Value& map, const std::string& path, std::vector<Problem>& out) const;

  void write(const std::string& line);
  void write_key(const std::string& name, const std::string& value, const std::string& comment);
};

/// A declared key: what it is, how to read it, how to show it, which numbers its range concerns.
struct Binder::Key::Impl {
  Binder::Impl* binder = nullptr;
  std::string name;
  std::string type;
  std::function<void(const Value&)> read;
  std::function<std::string()> show;  // YAML; empty: no value
  std::function<std::vector<double>()> numbers = [] { return std::vector<double>{}; };
  std::string unit;
  bool required = false;
  bool infinite = false;
  std::optional<double> lowest, above, highest, below;

  ~Impl() {
    if (!closed) close("");
  }
  void close(const std::string& sentence);
  bool closed = false;

 private:
  void read_value();
  void check_range(const Value& value);
  std::string range() const;
};

}  // namespace littoral::support
