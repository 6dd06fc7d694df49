// The keys of the grid: blocks, rings, plates, files, and the conditions on their faces.
#include "config.hpp"

namespace littoral::fv {
namespace {

using support::Binder;

const std::vector<std::pair<std::string, int>> k_conditions = {
    {"scene", static_cast<int>(FaceConfig::Kind::by_scene)},
    {"wall", static_cast<int>(Condition::wall)},
    {"slip", static_cast<int>(Condition::slip)},
    {"symmetry", static_cast<int>(Condition::symmetry)},
    {"inflow", static_cast<int>(Condition::inflow)},
    {"outflow", static_cast<int>(Condition::outflow)},
    {"far_field", static_cast<int>(Condition::far_field)},
    {"state", static_cast<int>(Condition::state)},
    {"periodic", static_cast<int>(Condition::periodic)},
    {"fringe", static_cast<int>(Condition::fringe)},
    {"join", static_cast<int>(Condition::join)},
    {"overset", static_cast<int>(Condition::overset)},
    {"convective", static_cast<int>(Condition::convective)}};

const std::array<std::string, 3> k_axes = {"x", "y", "z"};
const std::vector<std::pair<std::string, int>> k_faces = {{"x_lower", 0}, {"x_upper", 1}, {"y_lower", 2},
                                                          {"y_upper", 3}, {"z_lower", 4}, {"z_upper", 5}};
/// Faces of any block: a box's by axis, others' by direction.
std::vector<std::pair<std::string, int>> faces_or_any() {
  auto words = k_faces;
  for (int d = 0; d < 3; ++d)
    for (int side = 0; side < 2; ++side)
      words.emplace_back(std::string(1, "ijk"[d]) + (side == 0 ? "_lower" : "_upper"),
                         FaceConfig::k_first_direction + 2 * d + side);
  words.emplace_back("any", -1);
  return words;
}

/// Faces by the block's own directions.
std::vector<std::pair<std::string, int>> faces_by_direction() {
  std::vector<std::pair<std::string, int>> words;
  for (int d = 0; d < 3; ++d)
    for (int side = 0; side < 2; ++side)
      words.emplace_back(std::string(1, "ijk"[d]) + (side == 0 ? "_lower" : "_upper"), 2 * d + side);
  return words;
}

}  // namespace

void Spacing::bind(Binder& b) {
  b.choice("kind", kind, {{"uniform", Kind::uniform}, {"geometric", Kind::geometric}, {"tanh", Kind::tanh}})
      .doc(
          "uniform: equal cells; geometric: each a fixed factor wider than the next; tanh: smooth, finest at "
          "the ends.");
  b.key("ratio", ratio).min(1.0).doc("geometric: width of the widest cell over the narrowest.");
  b.key("strength", strength)
      .exclusive_min(0)
      .max(20)
      .doc("tanh: argument at the ends; larger is finer there.");
  b.key("first_cell", first_cell)
      .unit("m")
      .exclusive_min(0)
      .doc("Width of the narrowest cell, from which ratio or strength then follow; auto: they are given.");
  b.choice("toward", toward, {{"lower", Toward::lower}, {"upper", Toward::upper}, {"both", Toward::both}})
      .doc("Where the narrow cells are.");
}

void Stretching::bind(Binder& b) {
  Spacing::bind(b);
  b.list<Section>("sections", "Sections from the lower end to the upper one, instead of one law for all.",
                  sections, [](Binder& item, Section& section) {
                    item.key("to", section.to).unit("m").required().doc("Where the section ends.");
                    item.key("cells", section.cells).required().min(1).doc("Its cells.");
                    section.spacing.bind(item);
                  });
}

void SpanConfig::bind(Binder& b) {
  b.key("lower", lower).unit("m").doc("Lower end.");
  b.key("upper", upper).unit("m").doc("Upper end.");
  b.key("cells", cells).min(1).doc("Equal cells.");
  b.section("lower_face", "Condition at the lower end.", [&] { faces[0].bind(b); });
  b.section("upper_face", "Condition at the upper end.", [&] { faces[1].bind(b); });
}

void RingConfig::bind(Binder& b) {
  b.key("name", name).doc("For messages, fields and faces.");
  b.key("centre", centre).unit("m").doc("A point on the cylinder's axis.");
  b.key("radius", radius).unit("m").required().exclusive_min(0).doc("Of the cylinder.");
  b.key("outer_radius", outer_radius).unit("m").doc("Where the ring ends; this or thickness.");
  b.key("thickness", thickness).unit("m").exclusive_min(0).doc("Outer less inner radius.");
  b.key("around", around).required().min(3).doc("Equal cells around.");
  b.key("outward", outward).required().min(1).doc("Cells from the cylinder outward.");
  b.section("spacing", "Of the cells outward.", [&] { spacing.bind(b); });
  b.key("start_angle", start_angle).unit("degree").doc("Where the cells around begin, from x towards z.");
  b.section("span", "Extent along y; 3-D only.", [&] { span.bind(b); });
  b.section("inner", "Condition on the cylinder.", [&] { faces[inner].bind(b); });
  b.section("outer", "Condition on the outer edge.", [&] { faces[outer].bind(b); });
  b.list<Patch>(
      "patches", "Parts of a face with another condition; later ones win.", patches,
      [](Binder& item, Patch& patch) {
        item.choice("face", patch.face,
                    {{"inner", static_cast<int>(inner)}, {"outer", static_cast<int>(outer)}})
            .doc("Which face.");
        item.key("from", patch.from).min(0).doc("First cell around, outward (not used), along the span.");
        item.key("to", patch.to).min(0).doc("One past the last cell.");
        patch.condition.bind(item);
      });
  if (b.mode() != Binder::Mode::read) return;
  b.check(outer_radius.has_value() != thickness.has_value(), "rings",
          "give outer_radius or thickness, one of them.");
  b.check(!outer_radius || *outer_radius > radius, "rings", "outer_radius is not larger than radius.");
}

void GridFileConfig::bind(Binder& b) {
  b.key("name", name).doc("Of the blocks, with their number where there are several.");
  b.key("file", file)
      .required()
      .doc("PLOT3D grid, relative to this file; its dialect is found out and told.");
  b.key("scale", scale).exclusive_min(0).doc("Metres in a unit of the file.");
  b.section("span", "Extent along y of a planar file in 3-D.", [&] { span.bind(b); });
  b.list<Face>(
      "faces", "Conditions; faces not named here join what they meet. Later ones win.", faces,
      [](Binder& item, Face& face) {
        item.key("block", face.block).min(1).doc("Number of the block in the file, from 1.");
        item.choice("face", face.face, faces_by_direction()).doc("Which face, in the file's own directions.");
        item.key("from", face.from)
            .min(0)
            .doc("First cell along i, j, k; the face's own direction is not used.");
        item.key("to", face.to).min(-1).doc("One past the last cell; -1: up to the end.");
        face.condition.bind(item);
      });
}

void PlateConfig::bind(Binder& b) {
  const std::vector<std::string> parts = {"upstream", "downstream", "below", "above"};
  b.key("name", name).doc("Of the wall, and of the blocks as NAME.below, NAME.above, ...");
  b.key("centre", centre).unit("m").doc("Middle of the plate.");
  b.key("chord", chord).unit("m").required().exclusive_min(0).doc("Length of the plate.");
  b.key("thickness", thickness).unit("m").min(0).doc("0: a sheet.");
  b.key("angle", angle).unit("degree").doc("Of the chord, and of the whole grid, from x towards z.");
  for (std::size_t i = 0; i < 4; ++i)
    b.section(parts[i], "Grid beyond the plate on this side.", [&] {
      b.key("reach", reach[i]).unit("m").required().exclusive_min(0).doc("From the plate's edge or face.");
      b.key("cells", cells[i]).required().min(1).doc("In that direction.");
      b.section("face", "Condition there.", [&] { faces[i].bind(b); });
    });
  b.key("along", along).required().min(1).doc("Cells along the chord.");
  b.key("through", through).min(1).doc("Cells through the thickness.");
  b.key("first_cell", first_cell)
      .unit("m")
      .exclusive_min(0)
      .doc("Height of the cells at the faces; auto: equal cells.");
  b.key("edge_cell", edge_cell)
      .unit("m")
      .exclusive_min(0)
      .doc("Length of the cells at the edges, on both sides of each; auto: equal cells.");
  b.key("width", width).unit("m").exclusive_min(0).doc("Along y, 3-D only; auto: the whole span.");
  b.key("side_cells", side_cells).min(1).doc("Cells along y on each side of a plate of finite width.");
  b.section("span", "Extent along y, 3-D only; its cells are those along the plate.", [&] { span.bind(b); });
  b.section("wall", "Condition on the plate; left out: no slip.", [&] { wall.bind(b); });
}

void FaceConfig::bind(Binder& b) {
  b.choice("condition", condition, k_conditions)
      .doc(
          "scene: what the scene says of this side of the domain (open inside a coupled region: fringe); "
          "wall: no "
          "slip, u v w slide it; slip; symmetry; inflow: u v w given; outflow: p given; far_field: all "
          "given; "
          "state: all given in two layers of ghosts; periodic; fringe: none, for faces whose cells the "
          "particles impose or blank; join: the faces of another block (or of this one) that lie at the same "
          "place, in any orientation; see join; overset: the cells beside the face take their values from "
          "the grids below; convective: p and u are carried out with wave_speed, for wakes and vortices, and "
          "p "
          "returns slowly to the given one.");
  b.key("name", name).doc("Of the wall or opening, for forces and messages; left out: block.face.");
  b.key("u", u).unit("m/s").doc("Velocity along x on the face.");
  b.key("v", v).unit("m/s").doc("Velocity along y on the face; 3-D only.");
  b.key("w", w).unit("m/s").doc("Velocity along z on the face.");
  b.key("p", p).unit("Pa").doc(
      "Pressure on the face; left out: that of water at rest under `surface`, in a scene without a surface "
      "p0 at the origin.");
  b.key("surface", surface)
      .doc(
          "Free surface beyond the face: a formula < 0 in water, 0 on the surface; left out: the scene's "
          "initial.surface. inflow, far_field and state hold it; outflow and convective, through which the "
          "surface leaves, have their pressure from it.");
  b.key("wave_speed", wave_speed)
      .unit("m/s")
      .min(0)
      .doc(
          "far_field: speed of the Riemann problem; of the order of the stream's; 0: that of the given "
          "velocity. convective: speed with which the flow leaves; 0: the pseudo sound speed.");
  b.section("join", "With whom, condition join only. The orientation follows from the nodes and is reported.",
            [&] {
              b.key("block", join.block).doc("Name of the other block; left out: whichever is met.");
              b.choice("face", join.face, faces_or_any())
                  .doc("Face of that block: x, y, z of a box, else i, j, k.");
              b.key("offset", join.offset)
                  .unit("m")
                  .doc("A place here is one there plus this: joins any pair of faces as periodic.");
            });
}

void BlockConfig::bind(Binder& b) {
  b.key("name", name).doc("For messages, fields and faces.");
  b.key("lower", lower).unit("m").required().doc("Lower corner of the box.");
  b.key("upper", upper).unit("m").required().doc("Upper corner of the box.");
  b.key("cells", cells).required().min(1).doc("Cells along x, y, z; in 2-D the middle one is not used.");
  b.section("stretching", "Widths of the cells along each direction.", [&] {
    for (std::size_t d = 0; d < 3; ++d)
      b.section(k_axes[d], "Along " + k_axes[d] + ".", [&] { stretching[d].bind(b); });
  });
  b.section("mapping", "Deforms the box: formulas of its coordinates x, y, z; left out: the box itself.",
            [&] {
              for (std::size_t d = 0; d < 3; ++d)
                b.key(k_axes[d], mapping[d]).unit("m").doc("Coordinate " + k_axes[d] + " of a node.");
            });
  b.section("faces", "Condition on each face.", [&] {
    for (const auto& face : k_faces)
      b.section(face.first, "Face " + face.first + ".",
                [&] { faces[static_cast<std::size_t>(face.second)].bind(b); });
  });
  b.list<PatchConfig>("patches", "Parts of a face with another condition; later ones win.", patches,
                      [](Binder& item, PatchConfig& patch) {
                        item.choice("face", patch.face, k_faces).doc("Which face.");
                        item.key("from", patch.from)
                            .min(0)
                            .doc("First cell along x, y, z; the face's own direction is not used.");
                        item.key("to", patch.to).min(0).doc("One past the last cell along x, y, z.");
                        patch.condition.bind(item);
                      });
}

}  // namespace littoral::fv
