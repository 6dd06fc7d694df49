// Claims that hold for any input, tried on random ones.
#include <gtest/gtest.h>
// needs gtest before it
#include <rapidcheck/gtest.h>

#include <cmath>
#include <cstring>

#include "littoral/support/config.hpp"
#include "littoral/support/scene.hpp"
#include "support_test.hpp"

namespace littoral::support {
namespace {

struct Values {
  double number = 0.0;
  std::string text;
  std::vector<double> list;
  std::vector<std::string> words;
  std::map<std::string, double> constants;
  void bind(Binder& b) {
    b.numbers("constants", "", constants);
    b.key("number", number).may_be_infinite().doc("");
    b.key("text", text).doc("");
    b.key("list", list).may_be_infinite().doc("");
    b.key("words", words).doc("");
  }
};

/// Any bit pattern that is a number.
double any_double(std::uint64_t bits) {
  double value = 0.0;
  std::memcpy(&value, &bits, sizeof bits);
  return std::isnan(value) ? 0.0 : value;
}

std::string printable(const std::string& text) {
  std::string out;
  for (const char c : text)
    if (c > 0) out += c;
  return out;
}

RC_GTEST_PROP(ConfigProperty, ResolvedTextReadsBackTheSame,
              (std::uint64_t bits, const std::vector<std::uint64_t>& more, const std::string& text,
               const std::vector<std::string>& words)) {
  Values v;
  v.number = any_double(bits);
  for (const auto b : more) v.list.push_back(any_double(b));
  v.text = printable(text);
  for (const auto& word : words) v.words.push_back(printable(word));
  v.constants = {{"a", std::isfinite(v.number) ? v.number : 1.0}};
  Binder writer(Binder::Mode::resolved);
  v.bind(writer);
  Binder reader(Document::from_text(writer.text(), "resolved.yaml"));
  Values again;
  again.bind(reader);
  reader.finish();
  RC_ASSERT(std::memcmp(&again.number, &v.number, sizeof(double)) == 0);
  RC_ASSERT(again.list == v.list);
  RC_ASSERT(again.text == v.text);
  RC_ASSERT(again.words == v.words);
  RC_ASSERT(again.constants == v.constants);
}

RC_GTEST_PROP(ConfigProperty, DamagedSceneIsReadOrRefusedCleanly, ()) {
  std::string text =
      "dimension: 2\nconstants: {a: 0.05, k: pi}\nfluid: {density: 1.0, sound_speed: 10.0}\n"
      "domain:\n  lower: [0, 0, -1]\n  upper: [2, 0, 0.5]\n  x: [periodic, periodic]\n"
      "initial: {u: \"a*cos(k*x)\", surface: z}\nregions:\n- lower: [0, 0, -0.5]\n  upper: [2, 0, 0.5]\n"
      "coupling: {kind: imposed, blending_width: 0.08, driven_width: 0.08}\ntime: {end: 17.8}\n";
  const int n = *rc::gen::inRange(1, 4);
  for (int i = 0; i < n; ++i) {
    const auto at = *rc::gen::inRange<std::size_t>(0, text.size());
    const auto length = *rc::gen::inRange<std::size_t>(0, 4);
    const auto piece =
        *rc::gen::element<std::string>("", ":", "{", "]", "\t", "- ", "&a", "*a", "\n", "#", "\"", "|", "!!x",
                                       "e", "-", "%", "? ", "\xff", "(", "^", ",", "1e999");
    text.replace(at, length, piece);
  }
  try {
    Binder binder(Document::from_text(text, "scene.yaml"));
    Scene scene;
    scene.bind(binder);
    binder.finish();
    scene.resolved();
  } catch (const ConfigError&) {
    return;  // anything else fails the property
  }
}

}  // namespace
}  // namespace littoral::support
