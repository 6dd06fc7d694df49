#include "littoral/support/formula.hpp"

#include <muParser.h>

#include <cmath>
#include <vector>

#include "littoral/error.hpp"
#include "nearest.hpp"
#include "numbers.hpp"

namespace littoral::support {

struct Formula::Parser {
  mu::Parser expression;
  std::map<std::string, double> constants;
  double x = 0.0, y = 0.0, z = 0.0, t = 0.0;

  Parser(const std::string& text, const std::map<std::string, double>& names) : constants(names) {
    expression.DefineVar("x", &x);
    expression.DefineVar("y", &y);
    expression.DefineVar("z", &z);
    expression.DefineVar("t", &t);
    expression.DefineConst("pi", std::acos(-1.0));
    expression.DefineConst("e", std::exp(1.0));
    expression.DefineFun("floor", static_cast<double (*)(double)>(std::floor));
    expression.DefineFun("mod", static_cast<double (*)(double, double)>(std::fmod));
    for (const auto& [name, value] : names)
      if (name != "pi" && name != "e") expression.DefineConst(name, value);
    expression.SetExpr(text);
  }
  Parser(const Parser& other) : Parser(other.expression.GetExpr(), other.constants) {}
  Parser& operator=(const Parser&) = delete;

  std::vector<std::string> names() const {
    std::vector<std::string> out{"x", "y", "z", "t", "pi", "e"};
    for (const auto& [name, value] : constants) out.push_back(name);
    return out;
  }
};

namespace {

[[noreturn]] void refuse(const std::string& text, std::size_t position, const std::string& reason) {
  throw ConfigError("formula '" + text + "', character " + std::to_string(position + 1) + ": " + reason);
}

/// '=' is not an operator of a field: muParser would assign to x.
void refuse_assignment(const std::string& text) {
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '=') continue;
    const bool follows = i > 0 && std::string("=!<>").find(text[i - 1]) != std::string::npos;
    const bool precedes = i + 1 < text.size() && text[i + 1] == '=';
    if (!follows && !precedes) refuse(text, i, "'=' assigns nothing here. Compare with '=='.");
  }
}

std::string lower_first(std::string message) {
  // muParser ends its messages with the position it counts; ours comes first and counts from one
  const std::size_t tail = message.rfind(" at position");
  if (tail != std::string::npos) message.erase(tail);
  if (message.size() > 1 && message[0] >= 'A' && message[0] <= 'Z' && message[1] >= 'a')
    message[0] = static_cast<char>(message[0] - 'A' + 'a');
  while (!message.empty() && (message.back() == '.' || message.back() == ' ')) message.pop_back();
  return message + ".";
}

}  // namespace

Formula::Formula() : Formula(0.0) {}
Formula::Formula(double constant) : text_(format_number(constant)), constant_(constant) {}

Formula::Formula(const std::string& text, const std::map<std::string, double>& constants) : text_(text) {
  if (const auto number = parse_number(text)) {
    constant_ = *number;
    return;
  }
  if (text.find_first_not_of(" \t\n") == std::string::npos) throw ConfigError("formula '' is empty.");
  refuse_assignment(text);
  parser_ = std::make_unique<Parser>(text, constants);
  try {
    int n_results = 0;
    const double* results = parser_->expression.Eval(n_results);
    if (n_results > 1)
      refuse(text, text.find(','),
             "a field has one value; found " + std::to_string(n_results) + " separated by commas.");
    if (parser_->expression.GetUsedVar().empty()) {
      constant_ = results[0];
      parser_.reset();
    }
  } catch (const mu::ParserError& problem) {
    const std::string token = problem.GetToken();
    auto position = static_cast<std::size_t>(std::max(0, problem.GetPos()));
    position = std::min(position, text.size());
    if (problem.GetCode() != mu::ecUNASSIGNABLE_TOKEN || token.empty())
      refuse(text, position, lower_first(problem.GetMsg()));
    // the token is all of the rest; its first word is what nobody knows
    const std::string word = token.substr(
        0, token.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ_0123456789"));
    const std::string shown = word.empty() ? token.substr(0, 1) : word;
    std::vector<std::string> known = parser_->names();
    std::vector<std::string> candidates = known;
    for (const auto& [name, function] : parser_->expression.GetFunDef()) candidates.push_back(name);
    const std::string guess = nearest(shown, candidates);
    refuse(text, position,
           "unknown name '" + shown + "'." + (guess.empty() ? "" : " Did you mean '" + guess + "'?") +
               " Known names: " + joined(known) + ".");
  }
}

Formula::Formula(const Formula& other)
    : parser_(other.parser_ ? std::make_unique<Parser>(*other.parser_) : nullptr),
      text_(other.text_),
      constant_(other.constant_) {}

Formula& Formula::operator=(const Formula& other) {
  if (this != &other) *this = Formula(other);
  return *this;
}

Formula::Formula(Formula&&) noexcept = default;
Formula& Formula::operator=(Formula&&) noexcept = default;
Formula::~Formula() = default;

double Formula::operator()(double x, double y, double z, double t) const {
  if (!parser_) return constant_;
  parser_->x = x;
  parser_->y = y;
  parser_->z = z;
  parser_->t = t;
  return parser_->expression.Eval();
}

bool Formula::is_constant() const { return !parser_; }
const std::string& Formula::text() const { return text_; }

}  // namespace littoral::support
