#include "littoral/support/body.hpp"

namespace littoral::support {
namespace {

const std::vector<std::pair<std::string, BodySpec::Shape>> k_shapes = {
    {"box", BodySpec::Shape::box},       {"cylinder", BodySpec::Shape::cylinder},
    {"sphere", BodySpec::Shape::sphere}, {"wedge", BodySpec::Shape::wedge},
    {"plate", BodySpec::Shape::plate},   {"stl", BodySpec::Shape::stl}};
const std::vector<std::pair<std::string, BodySpec::Fluid>> k_fluids = {{"outside", BodySpec::Fluid::outside},
                                                                       {"inside", BodySpec::Fluid::inside}};
const std::vector<std::pair<std::string, BodySpec::Slip>> k_slips = {{"free", BodySpec::Slip::free},
                                                                     {"none", BodySpec::Slip::none}};

}  // namespace

void BodySpec::bind(Binder& b) {
  b.key("name", name).required().doc("Names its columns in scalars.csv.");
  b.choice("shape", shape, k_shapes)
      .doc(
          "Its form; 2-D scenes see the section with the plane y = 0. plate: without thickness, wet on both "
          "sides; stl: a closed surface of triangles from a file, 3-D only.");
  b.key("size", size)
      .unit("m")
      .min(0)
      .doc(
          "Box: lengths along x, y, z; wedge: base, width, height; plate: length along x and width along y "
          "before it is turned. 2-D: the second is ignored.");
  b.key("apex", apex).unit("m").doc("Wedge: x of the apex; 0: above the middle of the base.");
  b.key("radius", radius).unit("m").min(0).doc("Of a cylinder or sphere.");
  b.key("length", length).unit("m").min(0).doc("Of a cylinder, along y before it is turned; 2-D: ignored.");
  b.key("file", file).doc("Of shape stl, binary or text; relative to this file.");
  b.key("scale", scale).unit("m").exclusive_min(0).doc("Length that a unit of an STL file stands for.");
  b.key("position", position).unit("m").doc("Of its origin: centre, or the middle of a wedge's base.");
  b.key("rotation", rotation).unit("deg").doc("About x, then y, then z, before it is placed.");
  b.choice("fluid", fluid, k_fluids).doc("Which side of its surface is wet; inside: a tank.");
  b.choice("slip", slip, k_slips).doc("none: the water sticks to it (needs a viscosity).");
  b.section(
      "motion", "Prescribed; formulas of t.",
      [&] {
        b.key("u", motion.u).unit("m/s").doc("Velocity of its origin along x.");
        b.key("v", motion.v).unit("m/s").doc("Along y; 3-D only.");
        b.key("w", motion.w).unit("m/s").doc("Along z.");
        b.key("x", motion.x).unit("m").doc("Or its displacement along x.");
        b.key("y", motion.y).unit("m").doc("Along y; 3-D only.");
        b.key("z", motion.z).unit("m").doc("Along z.");
        b.key("rate_x", motion.rate_x).unit("rad/s").doc("Rotation about x through its origin; 3-D only.");
        b.key("rate_y", motion.rate_y).unit("rad/s").doc("About y; positive turns z towards x.");
        b.key("rate_z", motion.rate_z).unit("rad/s").doc("About z; 3-D only.");
      },
      &motion.given);
}

}  // namespace littoral::support
