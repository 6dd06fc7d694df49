#include "littoral/support/formula.hpp"

#include <cmath>
#include <thread>
#include <vector>

#include "support_test.hpp"

namespace littoral::support {
namespace {

TEST(FormulaTest, NumberIsConstant) {
  EXPECT_TRUE(Formula("2.5").is_constant());
  EXPECT_EQ(Formula("2.5")(1, 2, 3, 4), 2.5);
  EXPECT_EQ(Formula("-1e-3")(0, 0, 0, 0), -1e-3);
  EXPECT_EQ(Formula()(1, 1, 1, 1), 0.0);
}

TEST(FormulaTest, FoldsWhatDependsOnConstantsOnly) {
  const Formula f("2*H + pi - e", {{"H", 3.0}});
  EXPECT_TRUE(f.is_constant());
  // the same two constants and operations: equal to round-off
  EXPECT_NEAR(f(0, 0, 0, 0), 6.0 + std::acos(-1.0) - std::exp(1.0), 1e-14);
}

TEST(FormulaTest, EvaluatesEveryVariable) {
  const Formula f("a*cos(k*x) + 10*y + 100*z + 1000*t", {{"a", 0.5}, {"k", 2.0}});
  EXPECT_FALSE(f.is_constant());
  EXPECT_NEAR(f(0.3, 1, 2, 3), 0.5 * std::cos(0.6) + 10 + 200 + 3000, 1e-11);
}

TEST(FormulaTest, KeepsTheText) { EXPECT_EQ(Formula("x + 1").text(), "x + 1"); }

TEST(FormulaTest, PowerBindsTighterThanSign) {
  EXPECT_EQ(Formula("-x^2")(3, 0, 0, 0), -9.0);
  EXPECT_EQ(Formula("x < 0 ? 1 : 2")(1, 0, 0, 0), 2.0);
}

TEST(FormulaTest, StepsAndRemainders) {
  EXPECT_EQ(Formula("floor(x)")(-2.5, 0, 0, 0), -3.0);
  EXPECT_EQ(Formula("mod(x, 2)")(5.5, 0, 0, 0), 1.5);
}

TEST(FormulaTest, CopiesAreIndependent) {
  Formula a("x + b", {{"b", 1.0}});
  Formula b = a;
  EXPECT_EQ(a(1, 0, 0, 0), 2.0);
  EXPECT_EQ(b(5, 0, 0, 0), 6.0);
  a = Formula("7*x");
  EXPECT_EQ(b(5, 0, 0, 0), 6.0);
  b = a;
  EXPECT_EQ(b(2, 0, 0, 0), 14.0);
}

TEST(FormulaTest, EachThreadUsesItsCopy) {
  const Formula shared("sin(x) * z + t");
  std::vector<int> wrong(4, 0);
  std::vector<std::thread> threads;
  for (int id = 0; id < 4; ++id)
    threads.emplace_back([&wrong, id, own = shared] {
      for (int i = 0; i < 20000; ++i) {
        const double x = 1e-3 * i + id;
        // equal up to the last digits of sin
        if (std::abs(own(x, 0, 2, id) - (std::sin(x) * 2 + id)) > 1e-12)
          ++wrong[static_cast<std::size_t>(id)];
      }
    });
  for (auto& thread : threads) thread.join();
  EXPECT_EQ(wrong, std::vector<int>(4, 0));
}

std::string refusal(const std::string& text) {
  return message_of<ConfigError>([&] { Formula(text, {{"H", 1.0}, {"amplitude", 2.0}}); });
}

TEST(FormulaTest, NamesTheUnknownWordAndItsPlace) {
  EXPECT_EQ(refusal("2*amplitud + x"),
            "formula '2*amplitud + x', character 3: unknown name 'amplitud'. Did you mean 'amplitude'? Known "
            "names: x, y, z, t, pi, e, H, amplitude.");
  EXPECT_CONTAINS(refusal("a*cso(x)"), "character 1: unknown name 'a'");
  EXPECT_CONTAINS(refusal("5 % 3"), "character 3: unknown name '%'.");
  EXPECT_CONTAINS(refusal("2*cso(x)"), "character 3: unknown name 'cso'. Did you mean 'cos'?");
}

TEST(FormulaTest, RefusesWhatIsNoExpression) {
  EXPECT_CONTAINS(refusal(""), "is empty");
  EXPECT_CONTAINS(refusal("  "), "is empty");
  EXPECT_CONTAINS(refusal("1 +"), "formula '1 +', character 4:");
  EXPECT_CONTAINS(refusal("(x + 1"), "formula '(x + 1', character 7:");
  EXPECT_CONTAINS(refusal("sin(x, 1)"), "formula 'sin(x, 1)', character ");
  EXPECT_CONTAINS(refusal("x = 3"), "character 3: '=' assigns nothing here");
  EXPECT_CONTAINS(refusal("x, z"), "character 2: a field has one value; found 2");
  EXPECT_CONTAINS(refusal("\"text\""), "formula");
  EXPECT_EQ(refusal("x >= 1 && z == 2 || t != 0"), "no exception");
}

}  // namespace
}  // namespace littoral::support
