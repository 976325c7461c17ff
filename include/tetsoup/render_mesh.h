// tetsoup: a surface with all that its file says about it besides the geometry.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tetsoup/types.h"

namespace tetsoup {

struct Vec2 {
  float x = 0, y = 0;
  bool operator==(const Vec2&) const = default;
};

/// Polygons with texture coordinates, normals and names, in the order of the file: what an artist draws, and what an
/// embedding's points refer to. Faces may be anything a soup's triangles may be.
struct RenderMesh {
  static constexpr std::uint32_t kNone = 0xFFFFFFFFU;

  /// Names that the file gives a face; empty where it gives none.
  struct Part {
    std::string object, group, material;
    bool operator==(const Part&) const = default;
  };

  std::vector<Vec3> vertices;
  std::vector<std::uint32_t> face_sizes;        ///< Corners of every face, 3 or more.
  std::vector<std::uint32_t> corners;           ///< Vertex of every corner, face after face.
  std::vector<Vec2> texcoords;                  ///< Texture coordinates, (u, v) with v upwards.
  std::vector<std::uint32_t> corner_texcoords;  ///< One of them for every corner, or kNone; empty if the file has none.
  std::vector<Vec3> normals;                    ///< As given.
  std::vector<std::uint32_t> corner_normals;    ///< Likewise.
  std::vector<Part> parts;                      ///< In the order in which faces first name them.
  std::vector<std::uint32_t> face_parts;        ///< Part of every face.
  Vec3d origin{};                               ///< That the vertices are counted from.
  bool operator==(const RenderMesh&) const = default;
};

}  // namespace tetsoup
