#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "boundary/window.hpp"
#include "level_set/level_set.hpp"
#include "littoral/support/config.hpp"
#include "littoral/support/partner_config.hpp"
#include "littoral/support/scene.hpp"
#include "overset/assembly.hpp"
#include "physics/equations.hpp"

namespace littoral::fv {

/// How cell widths change along a line.
struct Spacing {
  enum class Kind : std::uint8_t { uniform, geometric, tanh };
  enum class Toward : std::uint8_t { lower, upper, both };
  Kind kind = Kind::uniform;
  double ratio = 1.0;                // geometric: width of the largest over the smallest cell
  double strength = 2.0;             // tanh: larger is finer at the refined ends
  std::optional<double> first_cell;  // [m] width of the narrowest cell, instead of ratio or strength
  Toward toward = Toward::lower;     // where the cells are small
  void bind(support::Binder& b);
};

/// The same along one direction of a box, perhaps section by section.
struct Stretching : Spacing {
  struct Section {
    double to = 0.0;  // [m]
    int cells = 1;
    Spacing spacing;
  };
  std::vector<Section> sections;
  void bind(support::Binder& b);
};

/// Condition on a face or on a part of it.
struct FaceConfig {
  enum class Kind : std::uint8_t { by_scene = 100 };  // beside Condition's values
  /// Faces are numbered 2 * axis + side, axis x, y, z; or from here 2 * direction + side, direction i, j, k.
  static constexpr int k_first_direction = 10;
  int condition = static_cast<int>(Kind::by_scene);
  std::string name;                         // "" : block.face
  std::optional<support::Formula> u, v, w;  // [m/s]
  std::optional<support::Formula> p;        // [Pa]
  std::optional<support::Formula> surface;  // < 0 in water
  double wave_speed = 0.0;                  // [m/s]
  struct JoinTo {
    std::string block;                         // "" : whoever is met
    int face = -1;                             // 2 * direction + side as PatchConfig; -1: any
    std::array<double, 3> offset = {0, 0, 0};  // [m] x here = x there + offset
  } join;
  void bind(support::Binder& b);
};

struct PatchConfig {  // a part of a face
  int face = 0;       // 2 * direction + side, direction in x, y, z
  std::array<int, 3> from = {0, 0, 0};
  std::array<int, 3> to = {0, 0, 0};
  FaceConfig condition;
};

struct BlockConfig {
  std::string name = "block";
  std::array<double, 3> lower = {0, 0, 0}, upper = {0, 0, 0};  // [m]
  std::array<int, 3> cells = {1, 1, 1};
  std::array<Stretching, 3> stretching;
  std::array<std::optional<support::Formula>, 3> mapping;  // [m] of the box coordinates x, y, z
  std::array<FaceConfig, 6> faces;                         // 2 * direction + side
  std::vector<PatchConfig> patches;
  void bind(support::Binder& b);
};

/// Extent of a grid across the plane of its description, in 3-D; a plane has none.
struct SpanConfig {
  double lower = 0.0, upper = 0.0;  // [m] along y
  int cells = 1;
  std::array<FaceConfig, 2> faces;  // lower, upper
  void bind(support::Binder& b);
};

/// An O-grid around a cylinder whose axis is along y: directions around, outward, along the span.
struct RingConfig {
  enum Face : int { inner, outer };
  struct Patch {  // a part of a face
    int face = inner;
    std::array<int, 3> from = {0, 0, 0}, to = {0, 0, 0};  // cells around, outward, along the span
    FaceConfig condition;
  };
  std::string name = "ring";
  std::array<double, 3> centre = {0, 0, 0};       // [m]
  double radius = 0.0;                            // [m]
  std::optional<double> outer_radius, thickness;  // [m] one of them
  int around = 0, outward = 0;                    // cells
  Spacing spacing;                                // outward
  double start_angle = 0.0;                       // [degree] where the cells around begin
  SpanConfig span;
  std::array<FaceConfig, 2> faces;  // inner, outer
  std::vector<Patch> patches;
  void bind(support::Binder& b);
};

/// Blocks from a PLOT3D file. In a planar scene its plane is (x, z), whatever the file calls it; in space a
/// planar file is extruded along y.
struct GridFileConfig {
  struct Face {                                              // a face, or a part of it
    int block = 1;                                           // number in the file, from 1
    int face = 0;                                            // 2 * direction + side
    std::array<int, 3> from = {0, 0, 0}, to = {-1, -1, -1};  // cells along i, j, k; to -1: the last
    FaceConfig condition;
  };
  std::string name = "grid";
  std::string file;
  double scale = 1.0;  // [-] to metres
  SpanConfig span;
  std::vector<Face> faces;
  void bind(support::Binder& b);
};

/// Blocks around a plate, its chord along x before it is turned: below and above it over the whole length,
/// and, where it has a thickness, before and behind it.
struct PlateConfig {
  enum Face : int { upstream, downstream, below, above };
  std::string name = "plate";
  std::array<double, 3> centre = {0, 0, 0};    // [m]
  double chord = 0.0, thickness = 0.0;         // [m]
  double angle = 0.0;                          // [degree] of the chord, from x towards z
  std::array<double, 4> reach = {0, 0, 0, 0};  // [m] of the grid, from the plate's edges and faces
  std::array<int, 4> cells = {1, 1, 1, 1};     // of these parts
  int along = 1, through = 1;                  // cells along the chord and through the thickness
  std::optional<double> first_cell;            // [m] at the faces
  std::optional<double> edge_cell;             // [m] along the chord and the span, at the edges
  std::optional<double> width;                 // [m] 3-D: of the plate; left out: the whole span
  int side_cells = 1;                          // 3-D: beside a plate of finite width, on each side
  SpanConfig span;                             // cells: along the plate
  FaceConfig wall;
  std::array<FaceConfig, 4> faces;
  void bind(support::Binder& b);
};

struct SpongeConfig {
  int axis = 0;                                          // x, y, z, radius
  std::array<double, 3> centre = {0, 0, 0};              // [m] radius only
  double from = 0.0, to = 0.0, rate = 0.0, power = 2.0;  // [m], [m], [1/s], [-]
  std::optional<support::Formula> u, v, w;               // [m/s]
  std::optional<support::Formula> surface;               // < 0 in water
  void bind(support::Binder& b);
};

struct GaugeConfig {
  enum class Kind : std::uint8_t { point, elevation, force, y_plus };
  std::string name;
  Kind kind = Kind::point;
  std::array<double, 3> at = {0, 0, 0};            // [m] point, elevation
  std::string wall;                                // force, y_plus
  std::array<double, 3> moment_about = {0, 0, 0};  // [m] force
};

/// The content of fv.yaml.
struct FvConfig {
  std::string scene = "scene.yaml";
  enum class Joins : std::uint8_t { automatic, listed };
  Joins joins = Joins::automatic;
  std::vector<BlockConfig> blocks;
  std::vector<RingConfig> rings;
  std::vector<PlateConfig> plates;
  std::vector<GridFileConfig> grid_files;
  OversetOptions overset;
  std::size_t n_parts() const { return blocks.size() + rings.size() + plates.size() + grid_files.size(); }
  /// Names the user gave to faces.
  std::vector<std::string> face_names() const;

  struct Time {
    std::optional<double> dt;   // [s] alone, or an upper bound in a coupled run
    std::optional<double> cfl;  // [-] likewise, by the convective speed
  } time;

  struct DualTime {
    enum class Method : std::uint8_t { multigrid, plain, prescribed };
    Method method = Method::multigrid;
    double drop = 1e-3;
    std::optional<double> floor;  // [m/s]
    int max_cycles = 50;
    double pseudo_cfl = 1.5;
    double kappa = 0.5;
    std::optional<double> pseudo_sound_speed;  // [m/s] sqrt(beta)
    bool print_history = false;
    enum class Precision : std::uint8_t { single, twofold };
    Precision precision = Precision::single;
  } dual_time;

  using Fidelity = support::Fidelity;
  Fidelity fidelity = Fidelity::standard;
  void apply_fidelity();

  FluxScheme flux = FluxScheme::upwind3;
  Limiter limiter = Limiter::none;
  double forcing_constant = 10.0;  // K of (21)
  support::PartnerConfig partner;

  LevelSetOptions level_set;

  struct RanksConfig {
    bool cut_layers = false;  // see cut_planes
  } ranks;

  struct SourceTerm {  // per volume
    std::optional<support::Formula> mass, u, v, w;
  } source;

  std::vector<SpongeConfig> sponges;
  std::vector<GaugeConfig> gauges;
  struct Output {
    bool fields = true;
    bool vorticity = false, q_criterion = false;
    int scalars_every = 1;
  } output;

  void bind(support::Binder& b);
  /// Reads and checks fv.yaml and the scene it names. throws ConfigError with all problems
  static FvConfig from_file(const std::string& path, const std::vector<std::string>& settings,
                            const std::vector<std::string>& scene_settings, support::Scene& scene);
  std::string resolved() const;
};

}  // namespace littoral::fv
