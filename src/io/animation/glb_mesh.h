// What is seen of a make as glTF's vertices: one for every combination of point, texture coordinate and normal.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "io/animation/cast.h"
#include "io/animation/corner_normals.h"

namespace tetsoup::animation {

class GlbMesh {
 public:
  explicit GlbMesh(const Make& make);

  std::size_t vertex_count() const { return vertices_.size(); }
  const std::vector<std::uint32_t>& indices() const { return indices_; }
  const std::vector<Vec2>& texcoords() const { return texcoords_; }  ///< With v downwards; empty if there are none.
  std::vector<Vec3> positions() const { return spread(rest_); }
  std::vector<Vec3> normals() const { return normals_of(rest_); }

  /// How the vertices move with a shape of the mesh.
  struct Target {
    std::vector<Vec3> positions, normals;
  };
  Target target(const std::vector<Vec3>& shape) const;

 private:
  struct Vertex {
    std::uint32_t point, texcoord;
    std::uint32_t facet;  // Triangle that gives the normal, or kNone: that of the point.
    auto operator<=>(const Vertex&) const = default;
  };
  std::vector<Vec3> spread(const std::vector<Vec3>& points) const;
  std::vector<Vec3> normals_of(const std::vector<Vec3>& points) const;

  const Make& make_;
  std::vector<Vec3> rest_;
  std::vector<Vertex> vertices_;
  std::vector<std::uint32_t> indices_;
  std::vector<Vec2> texcoords_;
};

}  // namespace tetsoup::animation
