#pragma once

#include <map>
#include <memory>
#include <string>

namespace littoral::support {

/// A field given by the user as text in x, y, z [m], t [s] and the scene's constants, as in "a*cos(k*x)".
/// Parsed once (muParser), evaluated many times. Copies are independent, so each thread can own one.
/// throws ConfigError where the text cannot be parsed or names an unknown variable (with the position)
class Formula {
 public:
  Formula();  ///< the constant 0
  explicit Formula(double constant);
  Formula(const std::string& text, const std::map<std::string, double>& constants = {});
  Formula(const Formula&);
  Formula& operator=(const Formula&);
  Formula(Formula&&) noexcept;
  Formula& operator=(Formula&&) noexcept;
  ~Formula();

  double operator()(double x, double y, double z, double t) const;
  bool is_constant() const;  ///< true if no variable occurs
  const std::string& text() const;

 private:
  struct Parser;
  std::unique_ptr<Parser> parser_;
  std::string text_;
  double constant_ = 0.0;
};

}  // namespace littoral::support
