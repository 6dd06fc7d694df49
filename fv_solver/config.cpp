#include "config.hpp"

#include "littoral/error.hpp"
#include "littoral/support/both_files.hpp"

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
  b.key("p", p).unit("Pa").doc("Pressure on the face; left out: hydrostatic.");
  b.key("surface", surface)
      .doc(
          "Free surface beyond the face: a formula < 0 in water, 0 on the surface. inflow, far_field and "
          "state "
          "only; left out: the scene's initial.surface.");
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

void SpongeConfig::bind(Binder& b) {
  b.choice("axis", axis, {{"x", 0}, {"y", 1}, {"z", 2}, {"radius", 3}})
      .doc("Along which the damping grows; radius: the distance from `centre`.");
  b.key("centre", centre).unit("m").doc("Of the distance; radius only. In 2-D y is not used.");
  b.key("from", from).required().unit("m").doc("Where the damping begins, from 0.");
  b.key("to", to).required().unit("m").doc(
      "Where it reaches `rate`; below `from` for a zone at the lower side.");
  b.key("rate", rate)
      .required()
      .unit("1/s")
      .min(0)
      .doc("Of the difference from the given velocity, at `to`.");
  b.key("power", power).min(0).doc("With which the damping grows between from and to.");
  b.key("u", u).unit("m/s").doc("Velocity along x to damp towards; left out: 0.");
  b.key("v", v).unit("m/s").doc("Velocity along y; 3-D only.");
  b.key("w", w).unit("m/s").doc("Velocity along z.");
  b.key("surface", surface)
      .doc(
          "Free surface to damp towards: a formula < 0 in water, 0 on it; left out: the surface itself is "
          "not "
          "damped.");
}

/// Values that the preset gives where the file says nothing; measured in tests/validation/fv_choices.
void FvConfig::apply_fidelity() {
  dual_time.drop = fidelity == Fidelity::draft ? 1e-2 : fidelity == Fidelity::standard ? 1e-3 : 1e-5;
  flux = fidelity == Fidelity::reference ? FluxScheme::central4 : FluxScheme::upwind3;
}

void FvConfig::bind(Binder& b) {
  b.key("scene", scene).doc("The scene's file, relative to this one.");
  b.choice("fidelity", fidelity,
           {{"draft", Fidelity::draft}, {"standard", Fidelity::standard}, {"reference", Fidelity::reference}})
      .doc(
          "Preset of dual_time.drop and flux, which may still be given: draft 1e-2, upwind3; standard 1e-3, "
          "upwind3; reference 1e-5, central4.");
  if (b.mode() == Binder::Mode::read) apply_fidelity();
  b.choice("joins", joins, {{"auto", Joins::automatic}, {"listed", Joins::listed}})
      .doc(
          "auto: faces without a condition of their own are joined where their nodes meet those of another "
          "face; listed: only faces with condition join are.");
  b.list<BlockConfig>("blocks", "Blocks of the grid.", blocks,
                      [](Binder& item, BlockConfig& block) { block.bind(item); });
  b.list<RingConfig>("rings", "O-grids around cylinders.", rings,
                     [](Binder& item, RingConfig& ring) { ring.bind(item); });
  b.list<PlateConfig>("plates", "Blocks around plates.", plates,
                      [](Binder& item, PlateConfig& plate) { plate.bind(item); });
  b.list<GridFileConfig>("grid_files", "Blocks from PLOT3D files.", grid_files,
                         [](Binder& item, GridFileConfig& file) { file.bind(item); });
  b.section("overset", "Overlapping grids: blocks listed later lie over earlier ones.", [&] {
    b.key("fringe_layers", overset.fringe_layers)
        .min(2)
        .max(4)
        .doc("Layers of cells at overset faces, and around holes, that take their values from another grid.");
    b.key("overlap", overset.overlap)
        .min(0)
        .max(50)
        .doc("Cells of the upper grid, at least, between its own fringe and that of the hole it cuts below.");
  });
  b.section("ranks", "A run on several MPI ranks: blocks are cut where need be and dealt by their cells.",
            [&] {
              b.key("cut_layers", ranks.cut_layers)
                  .doc(
                      "Allow cuts through thin cells, as in layers at walls, too: more equal loads, but "
                      "lines across the "
                      "layer are then solved in parts, which costs inner cycles.");
            });
  b.section("time", "Steps of a run without partner, and bounds on the windows of a coupled one.", [&] {
    b.key("dt", time.dt).unit("s").exclusive_min(0).doc("Time step.");
    b.key("cfl", time.cfl)
        .exclusive_min(0)
        .doc("Time step by the Courant number of the flow speed (at least reference_velocity).");
  });
  b.section("dual_time", "The inner iteration of a step.", [&] {
    using Method = DualTime::Method;
    b.choice("method", dual_time.method,
             {{"multigrid", Method::multigrid}, {"plain", Method::plain}, {"prescribed", Method::prescribed}})
        .doc(
            "multigrid: linear multigrid correction; plain: explicit pseudo-time steps, slow; prescribed: no "
            "equations, u is the scene's initial formulas at every time and only the free surface moves.");
    b.key("drop", dual_time.drop)
        .exclusive_min(0)
        .exclusive_max(1)
        .doc("Residual over that of the step's start at which the iteration ends.");
    b.key("floor", dual_time.floor)
        .unit("m/s")
        .min(0)
        .doc(
            "Residual, as a velocity, below which nothing more is asked for; auto: 1e-9 of the reference "
            "velocity.");
    b.key("max_cycles", dual_time.max_cycles)
        .min(1)
        .doc("Cycles after which the step goes on all the same, with a warning.");
    b.key("pseudo_cfl", dual_time.pseudo_cfl)
        .exclusive_min(0)
        .doc("Courant number of the pseudo-time step; plain only.");
    b.key("kappa", dual_time.kappa)
        .min(0)
        .max(1)
        .doc("Wave speed of the mass flux: at least kappa h/dt; above .5 small steps become unstable.");
    b.key("pseudo_sound_speed", dual_time.pseudo_sound_speed)
        .unit("m/s")
        .exclusive_min(0)
        .doc("sqrt(beta), of the order of the flow speed; auto: the scene's reference velocity.");
    using Precision = DualTime::Precision;
    b.choice("precision", dual_time.precision,
             {{"single", Precision::single}, {"double", Precision::twofold}})
        .doc("Of the multigrid's blocks and corrections; the state is always double.");
    b.key("print_history", dual_time.print_history).doc("Log the residual after each cycle.");
  });
  b.choice("flux", flux, {{"upwind3", FluxScheme::upwind3}, {"central4", FluxScheme::central4}})
      .doc(
          "upwind3: momentum is carried with the third-order value upwind; central4: with the fourth-order "
          "central one and a quarter of the third-difference dissipation.");
  b.choice("limiter", limiter, {{"none", Limiter::none}, {"van_albada", Limiter::van_albada}})
      .doc("Of the third-order reconstruction.");
  b.key("forcing_constant", forcing_constant)
      .exclusive_min(0)
      .doc("K of the forcing in overlapped cells; O(10).");
  b.section("level_set", "The free surface; only where the scene's initial.surface leaves cells in the air.",
            [&] {
              b.key("layers", level_set.layers)
                  .min(5)
                  .max(50)
                  .doc("Layers of cells on each side of the surface in which phi is the distance from it.");
              b.key("extension_layers", level_set.extension_layers)
                  .min(3)
                  .max(50)
                  .doc("Layers of air cells that hold a velocity; the surface may cross fewer in a step.");
              b.key("sweeps", level_set.sweeps).min(1).doc("Of the equation of phi in each inner cycle.");
            });
  partner.bind(b, coupler::Role::fv);
  b.section("source", "Sources per volume, formulas of x, y, z, t.", [&] {
    b.key("mass", source.mass).unit("kg/(m^3 s)").doc("Of the mass balance.");
    b.key("u", source.u).unit("N/m^3").doc("Force along x.");
    b.key("v", source.v).unit("N/m^3").doc("Force along y; 3-D only.");
    b.key("w", source.w).unit("N/m^3").doc("Force along z.");
  });
  b.list<SpongeConfig>("sponges", "Zones that damp the flow towards a given velocity.", sponges,
                       [](Binder& item, SpongeConfig& sponge) { sponge.bind(item); });
  b.list<GaugeConfig>("gauges", "Values written to gauges.csv.", gauges, [](Binder& item, GaugeConfig& g) {
    item.key("name", g.name).required().doc("Column prefix.");
    item.choice("kind", g.kind,
                {{"point", GaugeConfig::Kind::point},
                 {"elevation", GaugeConfig::Kind::elevation},
                 {"force", GaugeConfig::Kind::force},
                 {"y_plus", GaugeConfig::Kind::y_plus}})
        .doc(
            "point: p, u, v, w at a place; elevation: height of the free surface, against gravity, on the "
            "line "
            "through a place (nan where there is none); force: force and moment on a wall, in all, without "
            "the "
            "hydrostatic "
            "part (dynamic), of pressure and of friction; y_plus: largest and mean distance of a wall's "
            "first "
            "centres in wall units.");
    item.key("at", g.at).unit("m").doc("Place; point and elevation.");
    item.key("wall", g.wall).doc("Name of the wall; force and y_plus.");
    item.key("moment_about", g.moment_about).unit("m").doc("Centre of the moments; force only.");
  });
  b.section("output", "What is written besides gauges.", [&] {
    b.key("fields", output.fields).doc("XDMF fields at the scene's field_interval.");
    b.key("vorticity", output.vorticity).doc("Vorticity among the fields.");
    b.key("q_criterion", output.q_criterion)
        .doc("Q = |E|^2 - |Omega|^2 among the fields: negative inside vortices, as in the paper.");
    b.key("scalars_every", output.scalars_every)
        .min(1)
        .doc("Steps between rows of scalars.csv and gauges.csv.");
  });
  if (b.mode() != Binder::Mode::read) return;
  b.check(n_parts() > 0, "blocks", "a grid needs at least one of blocks, rings, plates, grid_files.");
  b.check(!(time.dt && time.cfl), "time.cfl", "given together with time.dt; give one of them.");
  for (const auto& s : sponges)
    b.check(s.from != s.to, "sponges", "from and to of a sponge are the same place.");
  for (const auto& g : gauges)
    b.check(g.kind == GaugeConfig::Kind::point || g.kind == GaugeConfig::Kind::elevation || !g.wall.empty(),
            "gauges", "a force or y_plus gauge needs a wall: its name.");
  b.check(
      level_set.extension_layers < level_set.layers, "level_set.extension_layers",
      "not less than level_set.layers: the band must be wider than the part of it that holds a velocity.");
}

FvConfig FvConfig::from_file(const std::string& path, const std::vector<std::string>& settings,
                             const std::vector<std::string>& scene_settings, support::Scene& scene) {
  support::Document document = support::Document::from_file(path);
  for (const auto& setting : settings) document.set(setting);
  FvConfig config;
  scene = support::read_both_files(document, scene_settings, [&](Binder& binder) { config.bind(binder); });
  if (scene.has_body_force())
    throw ConfigError(document.resolve(config.scene) +
                      ": body_force acts on particles only; give the grid its force per volume in fv.yaml, "
                      "source.u, source.v, source.w, and leave body_force out.");
  for (GridFileConfig& grid : config.grid_files) grid.file = document.resolve(grid.file);
  return config;
}

std::vector<std::string> FvConfig::face_names() const {
  std::vector<std::string> names;
  const auto add = [&](const FaceConfig& face) {
    if (!face.name.empty()) names.push_back(face.name);
  };
  for (const BlockConfig& block : blocks) {
    for (const FaceConfig& face : block.faces) add(face);
    for (const PatchConfig& patch : block.patches) add(patch.condition);
  }
  for (const RingConfig& ring : rings) {
    for (const FaceConfig& face : ring.faces) add(face);
    for (const FaceConfig& face : ring.span.faces) add(face);
    for (const RingConfig::Patch& patch : ring.patches) add(patch.condition);
  }
  for (const PlateConfig& plate : plates) {
    names.push_back(plate.wall.name.empty() ? plate.name : plate.wall.name);
    for (const FaceConfig& face : plate.faces) add(face);
    for (const FaceConfig& face : plate.span.faces) add(face);
  }
  for (const GridFileConfig& grid : grid_files) {
    for (const FaceConfig& face : grid.span.faces) add(face);
    for (const GridFileConfig::Face& face : grid.faces) add(face.condition);
  }
  return names;
}

std::string FvConfig::resolved() const {
  Binder binder(Binder::Mode::resolved);
  FvConfig copy = *this;  // bind() takes references to members; in this mode it only reads them
  copy.bind(binder);
  return binder.text();
}

}  // namespace littoral::fv
