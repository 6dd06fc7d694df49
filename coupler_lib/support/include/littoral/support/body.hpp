#pragma once

#include <array>
#include <optional>
#include <string>

#include "littoral/coupler/types.hpp"
#include "littoral/support/config.hpp"
#include "littoral/support/formula.hpp"

namespace littoral::support {

/// A solid in the flow, as scene.yaml gives it. Shapes lie about their own origin: box centred, the
/// cylinder's axis along y, the wedge's base on z = 0 and its apex on z = height, the plate centred in the
/// plane z = 0; a file has an origin of its own. They are turned about x, then y, then z, and then placed. In
/// 2-D the section with the plane y = 0 counts.
struct BodySpec {
  enum class Shape { box, cylinder, sphere, wedge, plate, stl };
  enum class Fluid { outside, inside };
  enum class Slip { free, none };

  std::string name;
  Shape shape = Shape::box;
  /// [m] box: lengths; wedge: base, width along y, height; plate: length, width
  coupler::Vec3 size = {0, 0, 0};
  double apex = 0.0;                   // [m] wedge: x of the apex, 0 above the middle of the base
  double radius = 0.0;                 // [m] cylinder, sphere
  double length = 0.0;                 // [m] cylinder
  std::string file;                    // stl: path, relative to scene.yaml
  double scale = 1.0;                  // stl: [m] that a unit of the file stands for
  coupler::Vec3 position = {0, 0, 0};  // [m]
  coupler::Vec3 rotation = {0, 0, 0};  // [deg] about x, then y, then z
  Fluid fluid = Fluid::outside;
  Slip slip = Slip::free;

  /// Prescribed motion; formulas of t. Of the origin either velocities or displacements from `position`.
  struct Motion {
    std::optional<Formula> u, v, w;                 // [m/s]
    std::optional<Formula> x, y, z;                 // [m]
    std::optional<Formula> rate_x, rate_y, rate_z;  // [rad/s] about the body's origin
    bool given = false;
  } motion;

  void bind(Binder& b);
};

}  // namespace littoral::support
