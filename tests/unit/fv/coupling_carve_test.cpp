#include <gtest/gtest.h>

#include "coupling/carve.hpp"
#include "coupling_models.hpp"
#include "divided_grids.hpp"
#include "littoral/coupler/donor_search.hpp"
#include "littoral/error.hpp"

namespace littoral::fv {
namespace {

using test::scene_with;
using test::water_box;

template <class Error, class F>
std::string message_of(F&& f) {
  try {
    f();
  } catch (const Error& error) {
    return error.what();
  }
  return "nothing was thrown";
}

TEST(CarveTest, RegionInTheMiddleGetsFringeAroundItsHole) {
  std::vector<Block<2>> blocks{water_box<2>(20, false)};
  const Carving carving = carve(blocks, scene_with(2, {{0.2, 0, 0.2}, {0.8, 0, 0.8}}));
  // 12 x 12 cells inside, two rings of fringe
  EXPECT_EQ(carving.n_fringe, 144 - 64);
  EXPECT_EQ(carving.n_blanked, 64);
  EXPECT_TRUE(carving.notes.empty());
  EXPECT_EQ(carving.column_depth, 0.0);  // without gravity there is no column
  const Block<2>& block = blocks[0];
  const auto status = [&](int i, int k) {
    return block.status[static_cast<std::size_t>(block.extent.at({i, k}))];
  };
  EXPECT_EQ(status(3, 10), CellStatus::computed);
  EXPECT_EQ(status(4, 10), CellStatus::fringe);
  EXPECT_EQ(status(5, 10), CellStatus::fringe);
  EXPECT_EQ(status(6, 10), CellStatus::blanked);
  EXPECT_EQ(status(5, 5), CellStatus::fringe);  // diagonals count
  EXPECT_EQ(block.solved[static_cast<std::size_t>(block.extent.at({4, 10}))], 0.0);
}

TEST(CarveTest, PeriodicNeighboursCount) {
  std::vector<Block<2>> blocks{water_box<2>(16, true)};
  const auto scene = test::top_scene(0.0);
  const Carving carving = carve(blocks, scene);
  EXPECT_EQ(carving.n_fringe, 2 * 16);
  EXPECT_EQ(carving.n_blanked, 6 * 16);
}

TEST(CarveTest, ColumnIsAllTheWaterAlongGravity) {
  auto scene = test::top_scene(9.81);
  std::vector<Block<2>> blocks{water_box<2>(16, true)};
  EXPECT_NEAR(carve(blocks, scene).column_depth, 2.0, 1e-12);  // not the .5 m of grid below the region
  scene.initial.surface = support::Formula("z-1.6", {});
  EXPECT_NEAR(carve(blocks, scene).column_depth, 1.6, 2e-3);  // found to a 1000th of the line
}

TEST(CarveTest, FaceBetweenCellFacesIsReported) {
  std::vector<Block<2>> blocks{water_box<2>(20, false)};
  const Carving carving = carve(blocks, scene_with(2, {{0.2, 0, 0.21}, {0.8, 0, 0.8}}));
  ASSERT_EQ(carving.notes.size(), 1u);
  EXPECT_NE(carving.notes[0].find("0.01 m above"), std::string::npos) << carving.notes[0];
}

TEST(CarveTest, RegionOutsideTheGridIsRefused) {
  std::vector<Block<2>> blocks{water_box<2>(20, false)};
  const std::string what = message_of<ConfigError>([&] {
    carve(blocks, scene_with(2, {{2, 0, 2}, {3, 0, 3}}));
  });
  EXPECT_NE(what.find("holds no cell of the grid, which reaches from (0, 0, 0) to (1, 0, 1)"),
            std::string::npos)
      << what;
}

TEST(CarveTest, GridThatEndsTooEarlyInTheRegionIsRefused) {
  std::vector<Block<2>> blocks{water_box<2>(20, false)};
  const std::string what = message_of<ConfigError>([&] {
    carve(blocks, scene_with(2, {{-1, 0, 0.95}, {2, 0, 2}}));
  });
  EXPECT_NE(what.find("has only 1 in direction z: let the block reach further"), std::string::npos) << what;
}

TEST(CarveTest, ForcedRegionIsForcedThroughout) {
  std::vector<Block<3>> blocks{water_box<3>(10, false)};
  auto scene = scene_with(3, {{0.2, 0.2, 0.2}, {0.8, 0.8, 0.8}});
  scene.coupling.kind = support::Scene::CouplingKind::forced;
  const Carving carving = carve(blocks, scene);
  EXPECT_EQ(carving.n_forced, 216);
  EXPECT_EQ(carving.n_fringe + carving.n_blanked, 0);
}

/// The region lies across cuts and their crossing: statuses are those of the undivided block.
TEST(CarveTest, LayersGoOnBehindJoins) {
  const auto scene = scene_with(2, {{-1, 0, 0.3}, {0.7, 0, 0.8}});
  test::WholeGrid<2> whole{{water_box<2>(32, true)}, {}};
  for (const int n : {2, 4, 6}) {
    std::vector<Piece<2>> pieces = test::dealt<2>(whole, n);
    for (auto& piece : pieces) piece.rank = 0;
    test::PartGrid<2> part = test::part_of_rank<2>(whole, pieces, {});
    std::vector<Block<2>> one = whole.blocks;
    const Carving of_one = carve(one, scene), of_many = carve<2>(part.blocks, part.exchange, scene);
    EXPECT_EQ(of_one.n_fringe, of_many.n_fringe);
    EXPECT_EQ(of_one.n_blanked, of_many.n_blanked);
    EXPECT_GT(of_one.n_blanked, 0);
    for (std::size_t b = 0; b < part.blocks.size(); ++b)
      for_each_index<2>({}, part.blocks[b].extent.n, [&](std::array<int, 2> index) {
        const auto c = static_cast<std::size_t>(part.blocks[b].extent.at(index));
        for (std::size_t d = 0; d < 2; ++d) index[d] += pieces[b].lower[d];
        EXPECT_EQ(part.blocks[b].status[c], one[0].status[static_cast<std::size_t>(one[0].extent.at(index))]);
      });
  }
}

/// The region cuts through the overlap of a ring and a box: what it blanks is nobody's donor any more.
TEST(CarveTest, DonorsAreSoughtOutsideOfWhatTheRegionBlanks) {
  auto whole = test::ring_over_box<2>();
  const auto scene = scene_with(2, {{0.4, 0, -9}, {9, 0, 9}});
  Exchange<2> exchange(whole.blocks, whole.overset);
  carve<2>(whole.blocks, exchange, scene);
  exchange.seek_donors(whole.blocks);
  std::vector<State<2>> q(2);
  long n_interpolated = 0;
  const auto value = [&](std::size_t b, std::size_t c) {
    return 1.0 + 2.0 * whole.blocks[b].centre[0][c] - 3.0 * whole.blocks[b].centre[1][c];
  };
  for (std::size_t b = 0; b < 2; ++b) {
    Block<2>& block = whole.blocks[b];
    q[b].resize(block.extent.size);
    block.reference_pressure.assign(block.extent.size, 0.0);
    evaluate_windows(block, Equations<2>{}, 0.0);
    for (std::size_t c = 0; c < block.extent.size; ++c) {
      const bool state =
          block.status[c] != CellStatus::blanked && block.status[c] != CellStatus::interpolated;
      q[b].p[c] = state ? value(b, c) : std::numeric_limits<double>::quiet_NaN();
    }
  }
  exchange.states(whole.blocks, q);
  for (std::size_t b = 0; b < 2; ++b)
    for_each_index<2>({}, whole.blocks[b].extent.n, [&](const std::array<int, 2>& index) {
      const auto c = static_cast<std::size_t>(whole.blocks[b].extent.at(index));
      if (whole.blocks[b].status[c] != CellStatus::interpolated) return;
      ++n_interpolated;
      EXPECT_NEAR(q[b].p[c], value(b, c), 1e-11);
    });
  EXPECT_GT(n_interpolated, 100);
}

TEST(DonorOfferTest, PointsBesideAPeriodicFaceFindDonorsWithTheImagesValues) {
  auto block = water_box<2>(10, true);
  const auto scene = scene_with(2, {{-1, 0, 0.6}, {2, 0, 2}});
  const auto flow = [](const std::array<double, 2>& x, double) {
    return PointState<2>{x[1], {std::sin(6.283185307179586 * x[0]), 0.0}};
  };
  auto stepper = test::stepper_for<2>({block}, scene, flow);
  carve(stepper.blocks(), scene);
  const DonorOffer<2> offer(stepper.blocks(), stepper.exchange());
  ASSERT_EQ(offer.geometry().patches.size(), 1u);
  EXPECT_EQ(offer.geometry().patches[0].n, (std::array<int, 3>{12, 1, 12}));
  coupler::DonorValues values;
  offer.put_state(stepper, values);
  offer.put_rates(stepper, values);
  values.horizon_end = 1.0;
  const coupler::DonorSearch search(offer.geometry(), 2);
  std::int64_t hint = -1;
  const coupler::Donor donor =
      search.find({0.0, 0.0, 0.3}, hint);  // on the face, between cell 0 and its ghost
  ASSERT_TRUE(donor.found);
  const coupler::DonorState s = coupler::interpolate(values, donor, 0.0);
  EXPECT_NEAR(s.u[0], 0.0, 1e-12);
  EXPECT_NEAR(s.p, 0.3, 1e-12);
  // deep inside the hole there is nothing
  EXPECT_FALSE(search.find({0.5, 0.0, 0.95}, hint).found);
}

TEST(DonorOfferTest, LayersBeyondTheGridAreRefused) {
  const auto block = water_box<2>(20, false);
  auto scene = scene_with(2, {{0.2, 0, 0.2}, {0.8, 0, 0.8}});
  std::vector<Block<2>> blocks{block};
  carve(blocks, scene);
  const DonorOffer<2> offer(blocks, Exchange<2>(blocks));
  EXPECT_NO_THROW(check_layers_covered<2>(offer.geometry(), scene));
  scene.coupling.driven_width = 0.3;
  const std::string what = message_of<ConfigError>([&] { check_layers_covered<2>(offer.geometry(), scene); });
  EXPECT_NE(what.find("its driven layer ends at x = -0.15 m"), std::string::npos) << what;
}

}  // namespace
}  // namespace littoral::fv
