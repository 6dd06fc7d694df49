#pragma once

#include <array>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "littoral/support/formula.hpp"

namespace littoral::support {

/// A YAML file with the position of every value, and the values set over it from the command line.
/// `--set key=value` with key a dotted path ("time.cfl", "blocks[0].cells") replaces or adds a value.
class Document {
 public:
  /// throws ConfigError if the file is missing or no YAML (file, line, column)
  static Document from_file(const std::string& path);
  static Document from_text(const std::string& text, const std::string& name);
  void set(const std::string& assignment);  ///< "key=value"; throws ConfigError if malformed
  const std::string& name() const;          ///< the file's path, as given
  /// Path of a file named inside the document, resolved against the document's own folder.
  std::string resolve(const std::string& relative) const;

  struct Impl;
  std::shared_ptr<Impl> impl;
};

/// The one place where a key is declared. A configuration struct has `void bind(Binder& b)` that names each
/// key with its type (the member's), unit, range and sentence; the member's value at that moment is the
/// default. The same bind() reads a document, prints the help, and prints the resolved copy.
///
///     b.section("time", [&] {
///       b.key("end", end).unit("s").required().min(0).doc("Physical time at which the run ends.");
///       b.key("cfl", cfl).unit("-").exclusive_min(0).max(2).doc("Factor on the acoustic limit (16).");
///     });
///
/// Problems (unknown key with the nearest known name, wrong type, missing, out of range, bad formula) are
/// collected with file:line; finish() throws one ConfigError with all of them.
class Binder {
 public:
  class Key {
   public:
    Key& unit(const std::string& text);
    Key& required();
    Key& min(double lowest);                ///< value >= lowest (each component, each element)
    Key& exclusive_min(double bound);       ///< value > bound
    Key& max(double highest);               ///< value <= highest
    Key& exclusive_max(double bound);       ///< value < bound
    Key& may_be_infinite();                 ///< `.inf` is a value; without this it is refused
    Key& doc(const std::string& sentence);  ///< closes the declaration: reads, checks and records it

   private:
    friend class Binder;
    struct Impl;
    std::shared_ptr<Impl> impl_;
  };

  enum class Mode { read, help, resolved };

  /// read: values come from the document. Constants named in the document's `constants:` map serve all
  /// formulas.
  explicit Binder(const Document& document);
  /// help or resolved: no document; the text is available from text().
  explicit Binder(Mode mode);
  ~Binder();

  Mode mode() const;

  // Types a key can have. Numbers may also be given as formulas of the constants, as in `4*dx`.
  Key key(const std::string& name, double& value);
  Key key(const std::string& name, int& value);
  Key key(const std::string& name, bool& value);
  Key key(const std::string& name, std::string& value);
  Key key(const std::string& name, std::array<double, 3>& value);
  Key key(const std::string& name, std::array<int, 3>& value);
  Key key(const std::string& name, std::vector<double>& value);
  Key key(const std::string& name, std::vector<std::string>& value);
  Key key(const std::string& name, Formula& value);                 ///< number or text
  Key key(const std::string& name, std::optional<double>& value);   ///< "auto" or absent: no value
  Key key(const std::string& name, std::optional<Formula>& value);  ///< absent: no value
  /// One of a closed set of words.
  template <class Enum>
  Key choice(const std::string& name, Enum& value, const std::vector<std::pair<std::string, Enum>>& words) {
    std::vector<std::pair<std::string, int>> plain;
    for (const auto& w : words) plain.emplace_back(w.first, static_cast<int>(w.second));
    return choice_impl(name, static_cast<int>(value), plain,
                       [&value](int v) { value = static_cast<Enum>(v); });
  }

  /// Two of them, as the lower and the upper side of a direction; one word alone stands for both.
  template <class Enum>
  Key choices(const std::string& name, std::array<Enum, 2>& value,
              const std::vector<std::pair<std::string, Enum>>& words) {
    std::vector<std::pair<std::string, int>> plain;
    for (const auto& w : words) plain.emplace_back(w.first, static_cast<int>(w.second));
    return choices_impl(name, {static_cast<int>(value[0]), static_cast<int>(value[1])}, plain,
                        [&value](std::array<int, 2> v) {
                          value = {static_cast<Enum>(v[0]), static_cast<Enum>(v[1])};
                        });
  }

  /// A map of further keys. `present` (may be null) tells whether the document has it; without it an absent
  /// section is read as empty, so that its required keys are reported.
  void section(const std::string& name, const std::string& doc, const std::function<void()>& body,
               bool* present = nullptr);
  /// A list of maps, each bound by bind_item(item). In help mode one item is shown.
  template <class T>
  void list(const std::string& name, const std::string& doc, std::vector<T>& items,
            const std::function<void(Binder&, T&)>& bind_item) {
    list_impl(
        name, doc, items.size(), [&items](std::size_t n) { items.resize(n); },
        [&](std::size_t i) { bind_item(*this, items[i]); });
  }
  /// A map from free names to numbers (as `constants:`); entries may be formulas of the entries before them.
  /// The map named `constants` serves all formulas declared after it.
  void numbers(const std::string& name, const std::string& doc, std::map<std::string, double>& values);

  /// A further condition between keys; reported at `name`'s line (dotted path from the top). Without effect
  /// where `name` already has a problem, and outside of read mode.
  void check(bool holds, const std::string& name, const std::string& problem);

  /// True if none of these keys, nor anything in them, had a problem so far (then their values can be
  /// compared).
  bool sound(const std::vector<std::string>& paths) const;
  /// True if the document itself has a value at the path.
  bool given(const std::string& path) const;

  /// Constants that formulas of this document may use besides its own (the scene's, for a solver's file).
  void use_constants(const std::map<std::string, double>& constants);

  /// Reports keys nobody declared and throws ConfigError if there was any problem. Read mode only.
  void finish();
  /// The problems so far, without throwing (to show those of several files together).
  std::vector<std::string> problems();
  /// Help text or resolved YAML, according to the mode.
  std::string text() const;

 private:
  Key begin(const std::string& name, const std::string& type);
  Key choice_impl(const std::string& name, int current, const std::vector<std::pair<std::string, int>>& words,
                  const std::function<void(int)>& assign);
  Key choices_impl(const std::string& name, std::array<int, 2> current,
                   const std::vector<std::pair<std::string, int>>& words,
                   const std::function<void(std::array<int, 2>)>& assign);
  void list_impl(const std::string& name, const std::string& doc, std::size_t size,
                 const std::function<void(std::size_t)>& resize,
                 const std::function<void(std::size_t)>& bind_item);
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace littoral::support
