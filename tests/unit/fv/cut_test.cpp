#include "parallel/cut.hpp"

#include <gtest/gtest.h>

#include <numeric>

#include "divided_grids.hpp"
#include "littoral/error.hpp"

// Cutting blocks into pieces: who gets what, and that no cell notices.
namespace littoral::fv {
namespace {

template <int D>
CutPlanes<D> planes(const std::array<int, D>& cells) {
  CutPlanes<D> p;
  p.cells = cells;
  for (std::size_t d = 0; d < D; ++d) p.may[d].assign(static_cast<std::size_t>(cells[d]) + 1, 1);
  return p;
}

template <int D>
std::vector<double> loads(const std::vector<Piece<D>>& pieces, int n_ranks) {
  std::vector<double> cells(static_cast<std::size_t>(n_ranks), 0.0);
  for (const Piece<D>& piece : pieces)
    cells[static_cast<std::size_t>(piece.rank)] += static_cast<double>(piece.cells());
  return cells;
}

TEST(DealTest, EveryCellGoesToOneRankAndLoadsAreEqual) {
  const std::vector<std::vector<CutPlanes<2>>> grids = {
      {planes<2>({128, 96})},
      {planes<2>({200, 100}), planes<2>({64, 64}), planes<2>({30, 10})},
      {planes<2>({97, 53}), planes<2>({12, 400})}};
  for (const auto& grid : grids)
    for (const int n_ranks : {1, 2, 3, 4, 5, 7, 16}) {
      const auto pieces = deal<2>(grid, n_ranks);
      for (std::size_t b = 0; b < grid.size(); ++b) {
        std::vector<int> count(static_cast<std::size_t>(grid[b].cells[0] * grid[b].cells[1]), 0);
        for (const Piece<2>& piece : pieces)
          if (piece.whole == b)
            for_each_index<2>(piece.lower, piece.upper, [&](const std::array<int, 2>& i) {
              ++count[static_cast<std::size_t>(i[0] + grid[b].cells[0] * i[1])];
            });
        EXPECT_EQ(*std::min_element(count.begin(), count.end()), 1);
        EXPECT_EQ(*std::max_element(count.begin(), count.end()), 1);
      }
      const std::vector<double> cells = loads<2>(pieces, n_ranks);
      const double mean = std::accumulate(cells.begin(), cells.end(), 0.0) / n_ranks;
      EXPECT_LT(*std::max_element(cells.begin(), cells.end()), 1.15 * mean) << n_ranks << " ranks";
    }
}

TEST(DealTest, ACutKeepsHalvingsAndSmallFaces) {
  for (const Piece<2>& piece : deal<2>({planes<2>({128, 96})}, 2)) {
    EXPECT_EQ(piece.upper[1] - piece.lower[1], 96);  // across the longer direction
    EXPECT_EQ(piece.upper[0] - piece.lower[0], 64);
  }
  // 50 would be the middle
  for (const Piece<2>& piece : deal<2>({planes<2>({100, 20})}, 2)) EXPECT_EQ(piece.lower[0] % 8, 0);
}

TEST(DealTest, LayersAreNotCut) {
  Block<2> thin = make_block<2>("thin", {16, 64}, {}, [](const std::array<int, 2>& i) {
    const double s = i[1] / 64.0;
    return std::array<double, 2>{i[0] / 16.0, std::expm1(6.0 * s) / std::expm1(6.0)};
  });
  EXPECT_TRUE(cut_planes<2>({thin}, false)[0].may[1][8]);  // thin, but at no wall
  close_with<2>(thin, Condition::wall);
  for (const bool layers : {false, true}) {
    const auto planes = cut_planes<2>({thin}, layers);
    EXPECT_EQ(planes[0].may[1][8] != 0, layers);  // h/64 of the width
    EXPECT_TRUE(planes[0].may[0][8]);             // lines stay whole
  }
}

TEST(DealTest, MoreRanksThanPiecesAreRefused) {
  EXPECT_THROW(deal<2>({planes<2>({8, 6})}, 5), ConfigError);
  EXPECT_NO_THROW(deal<2>({planes<2>({8, 6})}, 2));
}

/// Pieces on one rank: what passes between blocks is copied, no message is sent.
template <int D>
std::vector<Piece<D>> here(std::vector<Piece<D>> pieces) {
  for (Piece<D>& piece : pieces) piece.rank = 0;
  return pieces;
}

template <int D>
double worst_of(const test::WholeGrid<D>& whole) {
  double worst = 0.0;
  for (const int n : {2, 3, 4, 6})
    worst = std::max(worst, test::residual_difference<D>(whole, here<D>(test::dealt<D>(whole, n)), {}));
  return worst;
}

TEST(CutTest, ResidualsAreThoseOfTheWholeBlocks) {
  // sums of the same numbers; join metrics differ in the last digits across an offset
  constexpr double k_round_off = 2e-13;
  for (unsigned seed = 0; seed < 4; ++seed) EXPECT_LT(worst_of<2>(test::turned_blocks<2>(seed)), k_round_off);
  EXPECT_LT(worst_of<3>(test::turned_blocks<3>(3)), k_round_off);
  EXPECT_LT(worst_of<2>(test::periodic_block<2>()), k_round_off);
  EXPECT_LT(worst_of<3>(test::periodic_block<3>()), k_round_off);
  EXPECT_LT(worst_of<2>(test::ring_over_box<2>()), k_round_off);
}

TEST(CutTest, AStepOfThePiecesIsThatOfTheWhole) {
  const auto whole = test::ring_over_box<2>();
  InnerTolerance tolerance;
  tolerance.drop = 1e-9;
  const auto step = [&](Stepper<2>& stepper) {
    stepper.initialise(test::smooth_flow<2>, 0.0);
    StepReport report;
    for (int i = 0; i < 2; ++i) report = stepper.advance(0.02);
    EXPECT_TRUE(report.converged);
    return report.cycles;
  };
  Stepper<2> one(whole.blocks, test::thin_water<2>(), std::make_unique<MultigridSolver<2>>(), tolerance,
                 whole.overset);
  const int cycles = step(one);
  test::PartGrid<2> part = test::part_of_rank<2>(whole, here<2>(test::dealt<2>(whole, 4)), {});
  Stepper<2> many(std::move(part.blocks), std::move(part.exchange), test::thin_water<2>(),
                  std::make_unique<MultigridSolver<2>>(), tolerance);
  EXPECT_LE(step(many), cycles + 4);
  const test::PartGrid<2> shape = test::part_of_rank<2>(whole, here<2>(test::dealt<2>(whole, 4)), {});
  for (std::size_t k = 0; k < 2; ++k)
    EXPECT_LT(test::largest_difference<2>(
                  shape, whole.blocks, [&](std::size_t i) -> const Field& { return many.state()[i].u[k]; },
                  [&](std::size_t w) -> const Field& { return one.state()[w].u[k]; }),
              1e-7);
}

TEST(CutTest, GatheredFieldsAreThoseOfTheWholeBlocks) {
  const auto whole = test::turned_blocks<3>(1);
  const auto part = test::part_of_rank<3>(whole, here<3>(test::dealt<3>(whole, 5)), {});
  std::vector<const Field*> own;
  for (const Block<3>& block : part.blocks) own.push_back(&block.centre[1]);
  const std::vector<Field> gathered = gather_whole<3>(part.exchange.layout(), own);
  ASSERT_EQ(gathered.size(), whole.blocks.size());
  for (std::size_t w = 0; w < gathered.size(); ++w) EXPECT_EQ(gathered[w], whole.blocks[w].centre[1]);
  for (std::size_t b = 0; b < part.blocks.size(); ++b)
    EXPECT_EQ(part_of<3>(part.exchange.layout(), b, gathered[part.exchange.layout().part[b].whole]),
              part.blocks[b].centre[1]);
}

}  // namespace
}  // namespace littoral::fv
