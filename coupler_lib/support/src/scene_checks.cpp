#include "scene_checks.hpp"

#include "numbers.hpp"

namespace littoral::support {
namespace {

const std::array<std::string, 3> k_axes = {"x", "y", "z"};

std::string metres(double length) { return format_number(length) + " m"; }

void check_domain(const Scene& s, Binder& b) {
  for (std::size_t d = 0; d < 3; ++d) {
    const bool one_periodic =
        (s.domain.sides[d][0] == Scene::Side::periodic) != (s.domain.sides[d][1] == Scene::Side::periodic);
    b.check(!one_periodic, "domain." + k_axes[d],
            "periodic on one side only; a direction is periodic on both.");
    if (s.active(d) && b.sound({"domain.lower", "domain.upper"}))
      b.check(s.domain.lower[d] < s.domain.upper[d], "domain.upper",
              "along " + k_axes[d] + " " + metres(s.domain.upper[d]) + " is not above domain.lower, " +
                  metres(s.domain.lower[d]) + ".");
  }
}

void check_plane(const Scene& s, Binder& b) {
  if (s.dimension != 2 || !b.sound({"dimension"})) return;
  b.check(s.gravity[1] == 0.0, "gravity", "has a component along y, but the plane of a 2-D scene is (x, z).");
  b.check(s.initial.v.is_constant() && s.initial.v(0, 0, 0, 0) == 0.0, "initial.v",
          "is a velocity along y, but the plane of a 2-D scene is (x, z): use u and w.");
  b.check(s.body_force.y.is_constant() && s.body_force.y(0, 0, 0, 0) == 0.0, "body_force.y",
          "is an acceleration along y, but the plane of a 2-D scene is (x, z): use x and z.");
  b.check(s.domain.sides[1] == std::array<Scene::Side, 2>{}, "domain.y",
          "a 2-D scene has no direction y: the plane is (x, z).");
}

bool overlap(const Scene& s, const Scene::Region& a, const Scene::Region& b) {
  for (std::size_t d = 0; d < 3; ++d)
    if (s.active(d) && (a.upper[d] <= b.lower[d] || b.upper[d] <= a.lower[d])) return false;
  return true;
}

void check_extent(const Scene& s, Binder& b, std::size_t r, std::size_t d) {
  const Scene::Region& region = s.regions[r];
  const std::string name = "regions[" + std::to_string(r) + "]";
  const std::string along = "along " + k_axes[d] + " ";
  b.check(
      region.lower[d] < region.upper[d], name + ".upper",
      along + metres(region.upper[d]) + " is not above the region's lower, " + metres(region.lower[d]) + ".");
  if (!b.sound({"domain", name + ".upper"})) return;
  const double tolerance = 1e-9 * (s.domain.upper[d] - s.domain.lower[d]);
  b.check(region.lower[d] >= s.domain.lower[d] - tolerance, name + ".lower",
          along + metres(region.lower[d]) + " is outside the domain, which begins at " +
              metres(s.domain.lower[d]) + ".");
  b.check(region.upper[d] <= s.domain.upper[d] + tolerance, name + ".upper",
          along + metres(region.upper[d]) + " is outside the domain, which ends at " +
              metres(s.domain.upper[d]) + ".");
}

/// The layers lie outside the nominal faces: there must be domain for them, and a region they surround.
void check_layers(const Scene& s, Binder& b, std::size_t r, std::size_t d) {
  const std::string name = "regions[" + std::to_string(r) + "]";
  if (!b.sound({"domain", "coupling.blending_width", "coupling.driven_width", name})) return;
  const Scene::Region& region = s.regions[r];
  const double layers = s.coupling.blending_width + s.coupling.driven_width;
  const std::string widths = metres(layers) + " (coupling.blending_width + coupling.driven_width)";
  const double thickness = region.upper[d] - region.lower[d];
  const bool any_open = s.open_face(region, d, 0) || s.open_face(region, d, 1);
  b.check(!any_open || thickness >= layers, name + ".upper",
          "the region is " + metres(thickness) + " thick along " + k_axes[d] + ", thinner than its layers, " +
              widths + ".");
  const double tolerance = 1e-9 * (s.domain.upper[d] - s.domain.lower[d]);
  b.check(!s.open_face(region, d, 0) || region.lower[d] - layers >= s.domain.lower[d] - tolerance,
          name + ".lower",
          "the layers outside this face, " + widths + ", do not fit: the domain begins " +
              metres(region.lower[d] - s.domain.lower[d]) + " below it along " + k_axes[d] + ".");
  b.check(!s.open_face(region, d, 1) || region.upper[d] + layers <= s.domain.upper[d] + tolerance,
          name + ".upper",
          "the layers outside this face, " + widths + ", do not fit: the domain ends " +
              metres(s.domain.upper[d] - region.upper[d]) + " above it along " + k_axes[d] + ".");
}

void check_coupling(const Scene& s, Binder& b) {
  if (b.sound({"coupling.dt", "coupling.substeps"}))
    b.check(!s.coupling.window.dt || s.coupling.window.substeps == 1, "coupling.substeps",
            "given together with coupling.dt; give one of them.");
  if (b.sound({"coupling.dt", "time.end"}))
    b.check(!s.coupling.window.dt || *s.coupling.window.dt <= s.time.end, "coupling.dt",
            "a window of " + format_number(s.coupling.window.dt.value_or(0.0)) +
                " s is longer than the whole run, time.end = " + format_number(s.time.end) + " s.");
  if (!b.sound({"coupling.kind", "regions"})) return;
  for (std::size_t r = 0; r < s.regions.size(); ++r)
    for (std::size_t d = 0; d < 3; ++d)
      if (s.active(d) && b.sound({"dimension"})) check_extent(s, b, r, d);
  if (s.coupling.kind == Scene::CouplingKind::none) return;
  b.check(!s.regions.empty(), "regions", "a coupled scene needs the region of the particles.");
  b.check(s.fluid.sound_speed < 1.0e300, "fluid.sound_speed",
          "particles need a finite sound speed; infinite is for coupling.kind none.");
  b.check(s.coupling.driven_width > 0.0, "coupling.driven_width",
          "is 0; a coupled region needs a driven layer of at least one kernel radius.");
  for (std::size_t r = 0; r < s.regions.size(); ++r) {
    for (std::size_t d = 0; d < 3; ++d)
      if (s.active(d) && b.sound({"dimension"})) check_layers(s, b, r, d);
    for (std::size_t q = 0; q < r; ++q)
      b.check(!overlap(s, s.regions[r], s.regions[q]), "regions[" + std::to_string(r) + "]",
              "overlaps regions[" + std::to_string(q) + "].");
  }
}

void check_body(const Scene& s, Binder& b, std::size_t k) {
  using Shape = BodySpec::Shape;
  const BodySpec& body = s.bodies[k];
  const std::string at = "bodies[" + std::to_string(k) + "].";
  for (std::size_t q = 0; q < k; ++q)
    b.check(s.bodies[q].name != body.name, at + "name",
            "'" + body.name + "' is the name of bodies[" + std::to_string(q) + "] already.");
  if (!b.sound({at + "shape", "dimension"})) return;
  const bool sized = body.shape == Shape::box || body.shape == Shape::wedge;
  for (std::size_t d = 0; d < 3; ++d)
    b.check(!sized || !s.active(d) || body.size[d] > 0.0, at + "size",
            "along " + k_axes[d] + " is " + metres(body.size[d]) + "; a box or wedge needs lengths above 0.");
  if (body.shape == Shape::plate) {
    b.check(body.size[0] > 0.0 && (s.dimension == 2 || body.size[1] > 0.0), at + "size",
            "a plate needs a length and, in 3-D, a width above 0.");
    b.check(body.fluid == BodySpec::Fluid::outside, at + "fluid",
            "is inside, but a plate has no inside: it is wet on both sides. Use outside.");
  }
  if (body.shape == Shape::stl) {
    b.check(!body.file.empty(), at + "file", "is missing; shape stl needs the file of its triangles.");
    b.check(s.dimension == 3, at + "shape",
            "stl is for 3-D scenes; 2-D ones have box, cylinder, wedge, plate.");
  }
  const bool round = body.shape == Shape::cylinder || body.shape == Shape::sphere;
  b.check(!round || body.radius > 0.0, at + "radius", "a cylinder or sphere needs a radius above 0.");
  b.check(body.shape != Shape::cylinder || s.dimension == 2 || body.length > 0.0, at + "length",
          "a cylinder needs a length above 0.");
  b.check(body.slip == BodySpec::Slip::free || s.fluid.viscosity > 0.0, at + "slip",
          "none needs a viscosity, and fluid.viscosity is 0: use free.");
  const auto& m = body.motion;
  b.check(!(m.u && m.x) && !(m.v && m.y) && !(m.w && m.z), at + "motion",
          "gives velocity and displacement in the same direction; give one of them.");
  if (s.dimension != 2) return;
  b.check(!m.v && !m.y && !m.rate_x && !m.rate_z, at + "motion",
          "leaves the plane (x, z) of a 2-D scene: use u, w or x, z, and rate_y.");
  b.check(body.shape == Shape::sphere || (body.rotation[0] == 0.0 && body.rotation[2] == 0.0),
          at + "rotation", "turns the body out of the plane (x, z) of a 2-D scene: turn it about y only.");
  b.check(body.position[1] == 0.0, at + "position", "leaves the plane y = 0 of a 2-D scene.");
}

}  // namespace

void check_scene(const Scene& scene, Binder& b) {
  if (b.mode() != Binder::Mode::read) return;
  check_domain(scene, b);
  check_plane(scene, b);
  check_coupling(scene, b);
  for (std::size_t k = 0; k < scene.bodies.size(); ++k) check_body(scene, b, k);
}

}  // namespace littoral::support
