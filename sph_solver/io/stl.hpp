#pragma once

#include <string>

#include "bodies/triangle_surface.hpp"

namespace littoral::sph {

/// The triangles of an STL file, text or binary, read by assimp; scale: length of the file's unit [m].
/// throws ConfigError: no such file, or no triangles in it
TriangleSoup read_triangles(const std::string& path, double scale);

}  // namespace littoral::sph
