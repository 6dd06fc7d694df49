#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <set>

#include "clouds.hpp"
#include "io/gauges_mpi.hpp"
#include "neighbors/neighbor_list.hpp"
#include "parallel/halo.hpp"
#include "parallel/migrate.hpp"
#include "parallel/regions.hpp"

namespace littoral::sph {
namespace {

constexpr double k_end = std::numeric_limits<double>::max();

/// Left half, lower right quarter, upper right quarter.
Regions<2> three_regions() {
  return Regions<2>(
      {{{-k_end, -k_end}, {5.0, k_end}}, {{5.0, -k_end}, {k_end, 2.0}}, {{5.0, 2.0}, {k_end, k_end}}});
}

TEST(RegionsTest, LowerFaceBelongsToABoxUpperFaceToTheNext) {
  const auto regions = three_regions();
  for (std::size_t hint = 0; hint < 3; ++hint) {
    EXPECT_EQ(regions.owner({4.999, 7.0}, hint), 0u);
    EXPECT_EQ(regions.owner({5.0, 1.0}, hint), 1u);
    EXPECT_EQ(regions.owner({5.0, 2.0}, hint), 2u);
    EXPECT_EQ(regions.owner({1e9, -1e9}, hint), 1u);
  }
}

TEST(RegionsTest, WhereBoxesOverlapTheLowestRankOwnsThePlaceWhoeverAsks) {
  const Regions<2> regions({{{-k_end, -k_end}, {5.0, k_end}}, {{3.0, -k_end}, {k_end, k_end}}});
  for (std::size_t hint = 0; hint < 2; ++hint) {
    EXPECT_EQ(regions.owner({4.0, 0.0}, hint), 0u);
    EXPECT_EQ(regions.owner({6.0, 0.0}, hint), 1u);
  }
}

TEST(RegionsTest, ComeBackFromACheckpoint) {
  const auto regions = three_regions();
  const auto again = Regions<2>::unpack(regions.pack());
  ASSERT_EQ(again.size(), 3u);
  EXPECT_EQ(again.pack(), regions.pack());
}

TEST(MigratePlanTest, SendsWhatStandsElsewhereAndNothingElse) {
  const auto particles = test::cloud<2>({10, 4}, 1.0);
  const auto plan = plan_migration(particles, three_regions(), 0);
  EXPECT_TRUE(plan.to[0].empty());
  EXPECT_EQ(plan.to[1].size(), 10u);  // five columns, two rows
  EXPECT_EQ(plan.to[2].size(), 10u);
  EXPECT_EQ(plan.n_leaving, 20u);
  for (std::size_t i = 0; i < particles.n_owned; ++i)
    EXPECT_EQ(plan.leaves[i] != 0, particles.x[0][i] >= 5.0);
}

template <int D>
void expect_particles_survive_the_journey() {
  std::array<int, D> n;
  n.fill(4);
  auto sent = test::cloud<D>(n, 1.0, 0.3);
  for (std::size_t i = 0; i < sent.n_owned; ++i) {
    sent.p[i] = 10.0 + static_cast<double>(i);
    sent.surface[i] = SurfaceFlag::near;
    sent.zone[i] = Zone::blending;
    sent.normal[D - 1][i] = 0.5;
    sent.donor_hint[i] = 77;
  }
  std::vector<std::int32_t> which = {3, 1, 12};
  std::vector<char> bytes;
  pack_particles(sent, which, bytes);
  EXPECT_EQ(bytes.size(), 3 * particle_bytes(D));
  auto got = test::cloud<D>(n, 1.0);
  const std::size_t before = got.n_owned;
  EXPECT_EQ(unpack_particles(bytes.data(), 3, got), bytes.data() + bytes.size());
  ASSERT_EQ(got.n_owned, before + 3);
  for (std::size_t k = 0; k < 3; ++k) {
    const auto i = static_cast<std::size_t>(which[k]), j = before + k;
    for (std::size_t d = 0; d < D; ++d) EXPECT_EQ(got.x[d][j], sent.x[d][i]);
    EXPECT_EQ(got.id[j], sent.id[i]);
    EXPECT_EQ(got.p[j], sent.p[i]);
    EXPECT_EQ(got.zone[j], Zone::blending);
    EXPECT_EQ(got.surface[j], SurfaceFlag::near);
    EXPECT_EQ(got.normal[D - 1][j], 0.5);
    EXPECT_EQ(got.donor_hint[j], -1) << "another rank has other donor cells";
  }
}

TEST(MigratePlanTest, ParticlesSurviveTheJourney) {
  expect_particles_survive_the_journey<2>();
  expect_particles_survive_the_journey<3>();
}

template <int D>
DomainBox<D> periodic_box(double length) {
  DomainBox<D> box;
  for (std::size_t d = 0; d < D; ++d) {
    box.upper[d] = length;
    box.sides[d] = {support::Scene::Side::periodic, support::Scene::Side::periodic};
  }
  return box;
}

TEST(HaloPlanTest, AnImageForEverySideEdgeAndCorner) {
  EXPECT_EQ(periodic_shifts(periodic_box<2>(8.0)).size(), 9u);
  EXPECT_EQ(periodic_shifts(periodic_box<3>(8.0)).size(), 27u);
  DomainBox<3> closed = periodic_box<3>(8.0);
  closed.sides[1] = {support::Scene::Side::symmetry, support::Scene::Side::open};
  const auto shifts = periodic_shifts(closed);
  EXPECT_EQ(shifts.size(), 9u);
  EXPECT_EQ(shifts[0], (std::array<double, 3>{0.0, 0.0, 0.0}));
  for (const auto& shift : shifts) EXPECT_EQ(shift[1], 0.0);
}

/// Two ranks share a periodic cloud; what each gets with its own images must be all that lies near its
/// particles.
template <int D>
void expect_halo_complete() {
  const double length = 12.0, reach = 2.5;
  std::array<int, D> n;
  n.fill(12);
  const auto all = test::cloud<D>(n, 1.0, 0.3);
  const auto shifts = periodic_shifts(periodic_box<D>(length));
  auto left = all, right = all;
  std::vector<char> leaves(all.n_owned);
  for (std::size_t i = 0; i < all.n_owned; ++i) leaves[i] = all.x[0][i] >= 5.0;
  left.remove(leaves);
  for (auto& leave : leaves) leave = !leave;
  right.remove(leaves);
  const auto box_of = [](const Particles<D>& some) {
    RankBox<D> box;
    for (std::size_t d = 0; d < D; ++d) {
      box.lower[d] = *std::min_element(some.x[d].begin(), some.x[d].end());
      box.upper[d] = *std::max_element(some.x[d].begin(), some.x[d].end());
    }
    return box;
  };
  const HaloBoxes<D> sender{box_of(right), box_of(right)};
  std::vector<HaloEntry> entries;
  choose_halo<D>(right, sender, shifts, box_of(left), reach, entries);
  std::set<std::pair<std::int32_t, std::int32_t>> given;
  for (const auto& entry : entries)
    EXPECT_TRUE(given.insert({entry.particle, entry.shift}).second) << "twice";
  for (std::size_t s = 0; s < shifts.size(); ++s)
    for (std::size_t j = 0; j < right.n_owned; ++j)
      for (std::size_t i = 0; i < left.n_owned; ++i) {
        double r2 = 0.0;
        for (std::size_t d = 0; d < D; ++d) {
          const double r = right.x[d][j] + shifts[s][d] - left.x[d][i];
          r2 += r * r;
        }
        if (r2 >= reach * reach) continue;
        ASSERT_EQ(given.count({static_cast<std::int32_t>(j), static_cast<std::int32_t>(s)}), 1u)
            << "particle " << j << " is a neighbour and does not come";
        break;
      }
  EXPECT_LT(entries.size(), right.n_owned * shifts.size() / 2) << "hardly chosen";
}

TEST(HaloPlanTest, EveryNeighbourComesOnceThroughEverySide) {
  expect_halo_complete<2>();
  expect_halo_complete<3>();
}

TEST(HaloPlanTest, ARankWithoutParticlesGetsAndGivesNothing) {
  const auto particles = test::cloud<2>({4, 4}, 1.0);
  const double inf = std::numeric_limits<double>::infinity();
  const RankBox<2> nobody{{inf, inf}, {-inf, -inf}}, all{{0.0, 0.0}, {4.0, 4.0}};
  EXPECT_FALSE(may_reach<2>(all, {0.0, 0.0}, nobody, 10.0));
  EXPECT_FALSE(may_reach<2>(nobody, {0.0, 0.0}, all, 10.0));
  std::vector<HaloEntry> entries;
  choose_halo<2>(particles, {all, all}, {{0.0, 0.0}}, nobody, 10.0, entries);
  EXPECT_TRUE(entries.empty());
}

/// Ids of a row of neighbours, in the order in which its sums run.
template <int D>
std::vector<std::int64_t> row_of(const Particles<D>& particles, std::int64_t id) {
  NeighborList<D> neighbors(2.5, 0.3);
  neighbors.build(particles, 0.0, neighbors.least_cell_side());
  std::vector<std::int64_t> row;
  for (std::size_t i = 0; i < particles.n_owned; ++i)
    if (particles.id[i] == id)
      for (std::size_t k = neighbors.start()[i]; k < neighbors.start()[i + 1]; ++k)
        row.push_back(particles.id[static_cast<std::size_t>(neighbors.list()[k])]);
  return row;
}

TEST(NeighborOrderTest, DoesNotDependOnWhoElseIsThereAndInWhichOrder) {
  const auto all = test::cloud<3>({11, 11, 11}, 1.0, 0.4);
  auto part = all;  // without what is far away, which moves the corner of the grid, and in another order
  std::vector<char> far(all.n_owned);
  for (std::size_t i = 0; i < all.n_owned; ++i) far[i] = all.x[0][i] < 1.9 || all.x[2][i] > 9.1;
  part.remove(far);
  std::vector<std::int32_t> backwards(part.n_owned);
  std::iota(backwards.rbegin(), backwards.rend(), 0);
  part.permute(backwards);
  const std::int64_t middle = 5 * 121 + 5 * 11 + 5;
  const auto row = row_of(all, middle);
  EXPECT_GT(row.size(), 50u);
  EXPECT_EQ(row_of(part, middle), row);
}

TEST(GaugesOnRootTest, ChoosesWhatIsNearAPointOrALineAlsoThroughAnImage) {
  auto box = periodic_box<2>(10.0);
  box.sides[1] = {support::Scene::Side::symmetry, support::Scene::Side::open};
  const auto particles = test::cloud<2>({10, 10}, 1.0);
  GaugeConfig point{"p", GaugeConfig::Kind::point, {0.1, 0.0, 5.0}};
  std::set<std::pair<double, double>> found;
  for (const auto i : near_gauges<2>({point}, particles, box, 1.0))
    found.insert({particles.x[0][static_cast<std::size_t>(i)], particles.x[1][static_cast<std::size_t>(i)]});
  EXPECT_EQ(found, (std::set<std::pair<double, double>>{{0.5, 4.5}, {0.5, 5.5}, {9.5, 4.5}, {9.5, 5.5}}));
  GaugeConfig line{"l", GaugeConfig::Kind::elevation, {4.6, 0.0, 0.0}};
  EXPECT_EQ(near_gauges<2>({line}, particles, box, 1.0).size(), 20u);  // two columns
}

}  // namespace
}  // namespace littoral::sph
