#pragma once

#include <memory>
#include <string>
#include <vector>

#include "config.hpp"
#include "dual_time/stepper.hpp"
#include "level_set/elevation.hpp"
#include "littoral/coupler/donor_search.hpp"

namespace littoral::fv {

/// The gauges of a run: columns `<gauge>.<quantity>` and their values now, the same on all ranks.
/// comm collective: construction, values
template <int D>
class Gauges {
 public:
  /// throws ConfigError: a point outside the grid or in blanked cells, a wall nobody has, an elevation
  /// where there is no free surface
  Gauges(const std::vector<GaugeConfig>& gauges, const Stepper<D>& stepper);
  std::vector<std::string> columns() const;
  std::vector<double> values(const Stepper<D>& stepper) const;
  bool empty() const { return gauges_.empty(); }

 private:
  struct Place {  // of a point gauge: cells of the corners and their weights
    std::vector<std::size_t> block, cell;
    std::vector<double> weight;
  };
  using Searches = std::vector<std::unique_ptr<coupler::DonorSearch>>;  // one a block
  /// The place of a point in the blocks of this rank, and how good it is, the same on any number of ranks: at
  /// best without ghosts that stand for nothing, then in the uppermost grid. worth -1: there is none
  Place find(const Stepper<D>& stepper, const Searches& searches, coupler::Vec3 at, double& worth) const;

  std::vector<GaugeConfig> gauges_;
  std::vector<Place> places_;  // one a gauge; empty for forces, and where another rank reads it
  std::vector<std::vector<ElevationLine<D>>> lines_;  // [elevation gauge, in their order][block of this rank]
};

}  // namespace littoral::fv
