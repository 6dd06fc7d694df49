#include "bodies/disc_places.hpp"

#include <cmath>

namespace littoral::sph {
namespace {

std::vector<DiscPlace> strips(double radius) {
  constexpr int n = 16;
  std::vector<DiscPlace> places;
  double sum = 0.0;
  for (int k = 0; k < n; ++k) {
    const double s = (2.0 * k + 1.0) / n - 1.0;
    places.push_back({radius * s, 0.0, std::sqrt(1.0 - s * s)});
    sum += places.back().weight;
  }
  for (auto& place : places) place.weight /= sum;
  return places;
}

std::vector<DiscPlace> spiral(double radius) {
  constexpr int n = 48;
  const double golden = 3.14159265358979323846 * (3.0 - std::sqrt(5.0));
  std::vector<DiscPlace> places;
  for (int k = 0; k < n; ++k) {
    const double r = radius * std::sqrt((k + 0.5) / n);
    places.push_back({r * std::cos(golden * k), r * std::sin(golden * k), 1.0 / n});
  }
  return places;
}

}  // namespace

std::vector<DiscPlace> disc_places(int dimension, double radius) {
  return dimension == 2 ? strips(radius) : spiral(radius);
}

DiscFrame::DiscFrame(const Vector3& at, const Vector3& along)
    : centre(at), normal((1.0 / norm(along)) * along) {
  const Vector3 other = std::fabs(normal[1]) < 0.9 ? Vector3{0, 1, 0} : Vector3{1, 0, 0};
  s = cross(other, normal);
  s = (1.0 / norm(s)) * s;
  t = cross(normal, s);
}

}  // namespace littoral::sph
