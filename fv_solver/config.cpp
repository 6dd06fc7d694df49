#include "config.hpp"

#include "littoral/error.hpp"
#include "littoral/support/both_files.hpp"

namespace littoral::fv {

using support::Binder;

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
  b.choice("fidelity", fidelity, support::k_fidelities)
      .doc(
          "Preset of dual_time.drop and flux, which may still be given: draft 1e-2, upwind3; standard 1e-3, "
          "upwind3; reference 1e-5, central4. Left out: the scene's.");
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
        .doc(
            "Wave speed of the mass flux: at least kappa h/dt (and 2 nu/h); above .5 small steps become "
            "unstable.");
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
  b.section(
      "level_set", "The free surface; only where the scene's initial.surface leaves cells in the air.", [&] {
        b.key("layers", level_set.layers)
            .min(5)
            .max(50)
            .doc("Layers of cells on each side of the surface in which phi is the distance from it.");
        b.key("extension_layers", level_set.extension_layers)
            .min(3)
            .max(50)
            .doc("Layers of air cells that hold a velocity; the surface may cross fewer in a step.");
        b.key("sweeps", level_set.sweeps).min(1).doc("Of the equation of phi in each inner cycle.");
        using Correction = LevelSetOptions::VolumeCorrection;
        b.choice("volume_correction", level_set.volume_correction,
                 {{"none", Correction::none}, {"local", Correction::local}})
            .doc(
                "local: after each step every separate body of water gets its volume back, by one "
                "shift of its own surface; not bodies that reach an opening. Not on overlapping grids.");
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
            "line through a place (nan where there is none); force: force and moment on a wall, in all, "
            "without the hydrostatic part (dynamic), of pressure and of friction; y_plus: largest and mean "
            "distance of a wall's first centres in wall units.");
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
  scene = support::read_both_files(document, scene_settings, [&](Binder& binder, const support::Scene& read) {
    config.fidelity = read.fidelity;
    config.bind(binder);
  });
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
