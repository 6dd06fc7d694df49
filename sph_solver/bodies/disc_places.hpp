#pragma once

#include <vector>

#include "bodies/vector3.hpp"

namespace littoral::sph {

/// A place of a disc in its own plane [m], and its share of the area.
struct DiscPlace {
  double s, t, weight;
};

/// Places whose weighted mean stands for a disc: in 2-D strips of its section, each with the disc's width
/// there (t = 0), in 3-D places spread evenly (Vogel's spiral). The weights add up to 1.
std::vector<DiscPlace> disc_places(int dimension, double radius);

/// A disc in space and two directions along it; in 2-D s lies in the plane of the flow.
struct DiscFrame {
  Vector3 centre, normal, s, t;  // unit vectors but the centre [m]

  DiscFrame(const Vector3& at, const Vector3& along);
  Vector3 point(double a, double b) const { return centre + a * s + b * t; }
};

}  // namespace littoral::sph
