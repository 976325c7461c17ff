// The surface of a piece at rest: how deep a point lies in the piece, and which way out is the shortest.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "kernel/box_tree.h"
#include "simulate/rest.h"

namespace tetsoup::simulate {

struct Ball {
  Vec3d centre;
  double radius = 0;
};

/// The triangles that may be nearest to points of a tet.
struct NearTriangles {
  Vec3d middle;                          ///< Of the tet.
  std::vector<std::uint32_t> triangles;  ///< Ascending by
  std::vector<double> distances;         ///< their distance from the middle.
};

struct RestSurface {
  std::vector<Triangle> triangles;                        ///< Counter-clockwise from outside.
  std::vector<Vec3d> normals;                             ///< Of unit length; zero without an area.
  std::vector<Ball> balls;                                ///< Around the triangles.
  std::vector<std::uint32_t> vertices;                    ///< Of the triangles, ascending.
  std::vector<std::array<std::uint32_t, 2>> sharp_edges;  ///< Between triangles that form a ridge, ascending.
  std::vector<std::uint8_t> open_faces;      ///< Bit i of a tet: its face opposite corner i is on the surface.
  kernel::BoxTree boxes;                     ///< Around the triangles.
  std::vector<NearTriangles> near;           ///< Of every tet, once asked for.
  std::vector<std::uint32_t> tet_order;      ///< All tets, neighbours near each other.
  std::vector<kernel::MiddleGroup> middles;  ///< Of the tets, in this order.
};

RestSurface make_rest_surface(const Piece& piece);

/// Finds the triangles that nearest_surface_point() has to look at for points in and half a tet around the tet, once
/// and for all.
void find_near_triangles(RestSurface& surface, const Piece& piece, std::uint32_t tet);

struct SurfacePoint {
  std::uint32_t triangle = 0;
  std::array<double, 3> weights{};
};

/// The nearest point of the surface to a place at rest in the tet, whose near triangles are known. With `facing`, only
/// triangles count that face this way within 60 degrees, unless those are all farther than a mean edge: what has got in
/// through one side is not pushed out at another because an edge is near.
SurfacePoint nearest_surface_point(const RestSurface& surface, const Piece& piece, std::uint32_t tet, const Vec3d& p,
                                   const std::optional<Vec3d>& facing);

}  // namespace tetsoup::simulate
