#include <gtest/gtest.h>
#include <mpi.h>

#include <filesystem>

#include "divided_grids.hpp"
#include "io/checkpoint.hpp"
#include "littoral/error.hpp"

// Run by mpirun: every rank also computes the whole grid alone, and its own part must agree. Expectations
// only, no assertions: a rank that left would keep the others waiting.
namespace littoral::fv {
namespace {

Ranks world() { return Ranks(MPI_COMM_WORLD); }

TEST(RanksTest, SumsAreTheSameOnAllRanks) {
  const Ranks ranks = world();
  const double share = ranks.sum(0.1 * (ranks.rank() + 1));
  EXPECT_NEAR(share, 0.05 * ranks.size() * (ranks.size() + 1), 1e-14);
  for (const double other : ranks.gather(std::vector<double>{share})) EXPECT_EQ(other, share);
  EXPECT_EQ(ranks.largest(ranks.rank()), ranks.size() - 1);
  EXPECT_EQ(ranks.any(ranks.rank() == ranks.size() - 1), true);
}

TEST(RanksTest, AnErrorOnOneIsThatOfAll) {
  const Ranks ranks = world();
  std::string what;
  try {
    ranks.together<StabilityError>([&] {
      if (ranks.rank() == ranks.size() - 1) throw StabilityError("the last one's");
    });
  } catch (const StabilityError& error) {
    what = error.what();
  }
  EXPECT_NE(what.find("the last one's"), std::string::npos);
}

TEST(RanksTest, ResidualsAreThoseOfOneRank) {
  constexpr double k_round_off = 2e-13;
  const Ranks ranks = world();
  const auto difference = [&](const auto& whole) {
    return test::residual_difference(whole, test::dealt(whole, ranks.size()), ranks);
  };
  for (unsigned seed = 0; seed < 4; ++seed) EXPECT_LT(difference(test::turned_blocks<2>(seed)), k_round_off);
  EXPECT_LT(difference(test::turned_blocks<3>(3)), k_round_off);
  EXPECT_LT(difference(test::periodic_block<2>()), k_round_off);
  EXPECT_LT(difference(test::periodic_block<3>()), k_round_off);
  EXPECT_LT(difference(test::ring_over_box<2>()), k_round_off);
  EXPECT_LT(difference(test::ring_over_box<3>()), k_round_off);
}

InnerTolerance tight() {
  InnerTolerance tolerance;
  tolerance.drop = 1e-9;
  return tolerance;
}

template <int D>
Stepper<D> alone(const test::WholeGrid<D>& whole) {
  return Stepper<D>(whole.blocks, test::thin_water<D>(), std::make_unique<MultigridSolver<D>>(), tight(),
                    whole.overset);
}

template <int D>
Stepper<D> together(const test::WholeGrid<D>& whole) {
  test::PartGrid<D> part = test::part_of_rank<D>(whole, test::dealt<D>(whole, world().size()), world());
  return Stepper<D>(std::move(part.blocks), std::move(part.exchange), test::thin_water<D>(),
                    std::make_unique<MultigridSolver<D>>(), tight());
}

/// Largest difference of u and p between the ranks' parts and the whole.
template <int D>
double state_difference(const test::WholeGrid<D>& whole, const Stepper<D>& many, const Stepper<D>& one) {
  const test::PartGrid<D> shape =
      test::part_of_rank<D>(whole, test::dealt<D>(whole, world().size()), world());
  double worst = test::largest_difference<D>(
      shape, whole.blocks, [&](std::size_t i) -> const Field& { return many.state()[i].p; },
      [&](std::size_t w) -> const Field& { return one.state()[w].p; });
  for (std::size_t k = 0; k < D; ++k)
    worst = std::max(
        worst, test::largest_difference<D>(
                   shape, whole.blocks, [&](std::size_t i) -> const Field& { return many.state()[i].u[k]; },
                   [&](std::size_t w) -> const Field& { return one.state()[w].u[k]; }));
  return worst;
}

template <int D>
void compare_runs(const test::WholeGrid<D>& whole, int steps, int more_cycles) {
  Stepper<D> one = alone<D>(whole), many = together<D>(whole);
  int cycles_one = 0, cycles_many = 0;
  for (Stepper<D>* stepper : {&one, &many}) {
    stepper->initialise(test::smooth_flow<D>, 0.0);
    for (int i = 0; i < steps; ++i) {
      const StepReport report = stepper->advance(0.02);
      EXPECT_TRUE(report.converged);
      (stepper == &one ? cycles_one : cycles_many) += report.cycles;
    }
  }
  EXPECT_LE(cycles_many, cycles_one + steps * more_cycles) << cycles_one << " cycles on one rank";
  EXPECT_LT(state_difference<D>(whole, many, one), 1e-6);  // a drop of 1e-9 each
}

TEST(RanksTest, RunsAgreeToTheInnerTolerance) {
  compare_runs<2>(test::turned_blocks<2>(2), 3, 3);
  compare_runs<3>(test::turned_blocks<3>(3), 2, 3);
  compare_runs<2>(test::periodic_block<2>(), 3, 3);
  compare_runs<2>(test::ring_over_box<2>(), 3, 3);
  compare_runs<3>(test::ring_over_box<3>(), 1, 4);
}

/// A checkpoint of these ranks continues here to the bit, and on one rank to the inner tolerance; one of a
/// single rank continues here.
TEST(RanksTest, CheckpointsGoFromAnyNumberOfRanksToAny) {
  const auto whole = test::ring_over_box<2>();
  const Ranks ranks = world();
  // of all ranks at once, as one launch has it, and of this one
  const std::string many_path = "many.h5", one_path = "one_" + std::to_string(ranks.rank()) + ".h5";
  const support::Scene scene;
  Stepper<2> one = alone<2>(whole), many = together<2>(whole);
  for (Stepper<2>* stepper : {&one, &many}) {
    stepper->initialise(test::smooth_flow<2>, 0.0);
    for (int i = 0; i < 2; ++i) stepper->advance(0.02);
  }
  write_checkpoint<2>(many_path, many, 2, scene);
  write_checkpoint<2>(one_path, one, 2, scene);
  ranks.any(true);  // the root has written
  Stepper<2> many_again = together<2>(whole), one_from_many = alone<2>(whole),
             many_from_one = together<2>(whole);
  EXPECT_EQ(read_checkpoint<2>(many_path, many_again, scene), 2);
  EXPECT_EQ(read_checkpoint<2>(many_path, one_from_many, scene), 2);
  EXPECT_EQ(read_checkpoint<2>(one_path, many_from_one, scene), 2);
  for (Stepper<2>* stepper : {&one, &many, &many_again, &one_from_many, &many_from_one})
    for (int i = 0; i < 2; ++i) stepper->advance(0.02);
  for (std::size_t b = 0; b < many.blocks().size(); ++b) {
    EXPECT_EQ(many.state()[b].p, many_again.state()[b].p);
    EXPECT_EQ(many.state()[b].u, many_again.state()[b].u);
  }
  EXPECT_LT(state_difference<2>(whole, many, one_from_many), 1e-6);
  EXPECT_LT(state_difference<2>(whole, many_from_one, one), 1e-6);
}

}  // namespace
}  // namespace littoral::fv

int main(int argc, char** argv) {
  MPI_Init(&argc, &argv);
  testing::InitGoogleTest(&argc, argv);
  const int status = RUN_ALL_TESTS();
  MPI_Finalize();
  return status;
}
