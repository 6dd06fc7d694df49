#pragma once

#include <array>
#include <string>
#include <vector>

#include "config.hpp"
#include "grid/block.hpp"

namespace littoral::fv {

/// How a block stands among others.
struct Neighbourhood {
  bool automatic = true;  // faces by the scene join what they meet
  bool alone = true;      // one block only: a periodic direction of the scene is its own
};

/// What the configuration says of a block's faces, by the block's own directions.
template <int D>
struct FaceConditions {
  struct Patch {  // a part of a face; later ones win
    int direction = 0, side = 0;
    std::array<int, D> from{}, to{};  // cells; entry [direction] is not used
    FaceConfig condition;
  };
  std::array<std::array<FaceConfig, 2>, D> faces;
  std::vector<Patch> patches;
  /// Axis of space whose sides in the scene a direction's faces stand for; -1: none, a face by the scene is
  /// then one that joins another.
  std::array<int, D> scene_axis = none();
  std::array<double, D> length{};  // [m] of the block along that axis

  static std::array<int, D> none() {
    std::array<int, D> a;
    a.fill(-1);
    return a;
  }
};

/// Directions in which the block closes on itself. Before its metrics are set.
/// block: name and face names. throws ConfigError: periodic on one side only
template <int D>
std::array<bool, D> periodic_directions(const Block<D>& block, const FaceConditions<D>& conditions,
                                        const support::Scene& scene, const Neighbourhood& others);

/// Windows of all faces: each cut along the edges of its patches, each piece with the last patch over it.
/// Joins are requested, not found yet (find_joins). throws ConfigError: faces without condition, patches
/// outside their face, gravity along a periodic direction
template <int D>
void add_windows(Block<D>& block, const FaceConditions<D>& conditions, const support::Scene& scene,
                 const Neighbourhood& others);

}  // namespace littoral::fv
