#include "config.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

namespace littoral::sph {
namespace {

class FidelityTest : public ::testing::Test {
 protected:
  FidelityTest()
      : folder_(std::filesystem::path(::testing::TempDir()) /
                ::testing::UnitTest::GetInstance()->current_test_info()->name()) {
    std::filesystem::create_directories(folder_);
    std::ofstream(folder_ / "scene.yaml") << "dimension: 2\nfluid: {sound_speed: 10}\n"
                                             "domain: {lower: [0, 0, 0], upper: [1, 0, 1]}\ntime: {end: 1}\n";
    std::ofstream(folder_ / "sph.yaml") << "spacing: 0.1\n";
  }
  ~FidelityTest() override { std::filesystem::remove_all(folder_); }

  Numerics<2> read(const std::vector<std::string>& settings) {
    return numerics_of<2>(read_config((folder_ / "sph.yaml").string(), settings, {}));
  }

  std::filesystem::path folder_;
};

TEST_F(FidelityTest, SetsDefaultsAndKeysGoBeforeThem) {
  const auto standard = read({}), draft = read({"fidelity=draft"}), reference = read({"fidelity=reference"});
  EXPECT_NEAR(standard.kernel_radius, 0.4, 1e-15);
  EXPECT_NEAR(draft.kernel_radius, 0.3, 1e-15);
  EXPECT_EQ(standard.riemann, RiemannSolver::linearised);
  EXPECT_EQ(reference.riemann, RiemannSolver::low_dissipation);
  const auto mixed = read({"fidelity=reference", "riemann=linearised", "kernel_radius=5"});
  EXPECT_EQ(mixed.riemann, RiemannSolver::linearised);
  EXPECT_NEAR(mixed.kernel_radius, 0.5, 1e-15);
}

TEST_F(FidelityTest, IsTheScenesWhereNoneIsGiven) {
  const auto read_of = [&](const std::vector<std::string>& own) {
    return read_config((folder_ / "sph.yaml").string(), own, {"fidelity=draft"}).sph.fidelity;
  };
  EXPECT_EQ(read_of({}), Fidelity::draft);
  EXPECT_EQ(read_of({"fidelity=reference"}), Fidelity::reference);
}

TEST_F(FidelityTest, ResolvedFileReadsBackTheSame) {
  auto config =
      read_config((folder_ / "sph.yaml").string(), {"fidelity=reference", "riemann=linearised"}, {});
  const std::string text = resolved_text(config);
  std::ofstream(folder_ / "again.yaml") << text.substr(0, text.find("---"));
  const auto again = read_config((folder_ / "again.yaml").string(), {}, {});
  EXPECT_EQ(again.sph.riemann, RiemannSolver::linearised);
  EXPECT_EQ(again.sph.fidelity, Fidelity::reference);
}

}  // namespace
}  // namespace littoral::sph
