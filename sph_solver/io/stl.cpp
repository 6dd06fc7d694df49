#include "io/stl.hpp"

#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <assimp/Importer.hpp>

#include "littoral/error.hpp"

namespace littoral::sph {

TriangleSoup read_triangles(const std::string& path, double scale) {
  Assimp::Importer importer;
  const aiScene* scene = importer.ReadFile(path, aiProcess_Triangulate);
  if (scene == nullptr)
    throw ConfigError(path + ": cannot be read as a surface of triangles (" + importer.GetErrorString() +
                      "). An STL file is wanted, text or binary.");
  TriangleSoup soup;
  for (unsigned m = 0; m < scene->mNumMeshes; ++m) {
    const aiMesh& mesh = *scene->mMeshes[m];
    for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
      const aiFace& face = mesh.mFaces[f];
      if (face.mNumIndices != 3) continue;  // points and lines have no surface
      auto& triangle = soup.emplace_back();
      for (unsigned k = 0; k < 3; ++k) {
        const aiVector3D& x = mesh.mVertices[face.mIndices[k]];
        triangle[k] = scale * Vector3{x.x, x.y, x.z};
      }
    }
  }
  return soup;
}

}  // namespace littoral::sph
