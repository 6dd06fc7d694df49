#include "littoral/coupler/contract.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "littoral/error.hpp"

namespace littoral::coupler {
namespace {

Contract example() {
  Contract contract;
  contract.set("dimension", 2.0).set("gravity", 9.81).set("kind", "imposed").set("c", INFINITY);
  return contract;
}

TEST(ContractTest, EqualContractsHaveNoMismatch) { EXPECT_TRUE(example().compare(example()).empty()); }

TEST(ContractTest, ListsEveryDifferenceWithBothValues) {
  Contract theirs = example();
  theirs.set("gravity", 9.8).set("kind", "forced").set("extra", "yes");
  Contract mine = example();
  mine.set("only mine", 1.0);
  const auto mismatches = mine.compare(theirs);
  ASSERT_EQ(mismatches.size(), 4u);
  EXPECT_EQ(describe(mismatches, "sph_solver", "fv_solver"),
            "  gravity: sph_solver has 9.81, fv_solver has 9.8\n"
            "  kind: sph_solver has imposed, fv_solver has forced\n"
            "  only mine: sph_solver has 1, fv_solver has (absent)\n"
            "  extra: sph_solver has (absent), fv_solver has yes\n");
}

TEST(ContractTest, NumbersAgreeWithinRoundOffOnly) {
  Contract mine, theirs;
  mine.set("a", 0.1 + 0.2);
  EXPECT_TRUE(mine.compare(theirs.set("a", 0.3)).empty());
  EXPECT_FALSE(mine.compare(theirs.set("a", 0.3 * (1 + 1e-9))).empty());
}

TEST(ContractTest, NumberIsNotTheTextThatLooksLikeIt) {
  Contract mine, theirs;
  mine.set("a", 1.0);
  theirs.set("a", "1");
  EXPECT_EQ(mine.compare(theirs).size(), 1u);
}

TEST(ContractTest, NotANumberNeverAgrees) {
  Contract contract;
  contract.set("a", std::numeric_limits<double>::quiet_NaN());
  EXPECT_EQ(contract.compare(contract).size(), 1u);
}

TEST(ContractTest, OptionalEntriesAreComparedOnlyWhereBothGiveThem) {
  Contract mine = example(), theirs = example();
  mine.set("digest", "ab12").make_optional("digest");
  EXPECT_TRUE(mine.compare(theirs).empty());
  EXPECT_TRUE(theirs.compare(mine).empty());
  theirs.set("digest", "cd34");
  EXPECT_EQ(mine.compare(theirs).size(), 1u);
  EXPECT_EQ(theirs.compare(mine).size(), 1u);
}

TEST(ContractTest, OptionalSurvivesPacking) {
  const auto bytes = example().make_optional("kind").pack();
  const Contract back = Contract::unpack(bytes.data(), bytes.size());
  EXPECT_TRUE(back.find("kind")->is_optional);
  EXPECT_FALSE(back.find("dimension")->is_optional);
}

TEST(ContractTest, SettingAKeyAgainReplacesIt) {
  Contract contract;
  contract.set("a", "text").set("a", 2.0);
  ASSERT_EQ(contract.entries().size(), 1u);
  EXPECT_TRUE(contract.find("a")->is_number);
  contract.set("a", "text");
  EXPECT_FALSE(contract.find("a")->is_number);
}

TEST(ContractTest, SurvivesPacking) {
  const auto bytes = example().pack();
  const Contract back = Contract::unpack(bytes.data(), bytes.size());
  EXPECT_TRUE(example().compare(back, 0.0).empty());
}

TEST(ContractTest, RefusesEveryTruncation) {
  const auto bytes = example().pack();
  for (std::size_t n = 0; n < bytes.size(); ++n)
    EXPECT_THROW(Contract::unpack(bytes.data(), n), CouplingError) << n;
}

TEST(ContractTest, RefusesTrailingBytes) {
  auto bytes = example().pack();
  bytes.push_back('x');
  EXPECT_THROW(Contract::unpack(bytes.data(), bytes.size()), CouplingError);
}

}  // namespace
}  // namespace littoral::coupler
