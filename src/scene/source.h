// What a source is, in metres.
#pragma once

#include "scene/fields.h"
#include "tetsoup/scene.h"

namespace tetsoup::scene {

/// How a source's own numbers become metres: (p - origin) * metres.
struct Unit {
  double metres = 1;
  Vec3d origin;  ///< In the source's unit and place.
};

/// Of the box of all finite points; below 0 if there is none.
double longest_side(std::span<const Vec3> points);

/// @throws Problem  if the points have no extent, or one that no size or unit makes sense of.
Unit unit_of(const std::string& path, const SceneSource& source, std::span<const Vec3> points, const Vec3d& origin);

/// Finite points only; others stay what they are. `origin` is what they are counted from, before and after.
void to_metres(const Unit& unit, std::vector<Vec3>& points, Vec3d& origin);

/// Its triangles as they come, in its own unit; not of a tets_file.
RenderMesh make_surface(const SceneSource& source, const std::filesystem::path& folder);

/// A name for people.
std::string name_of(const SceneSource& source);

/// Scaled, turned about x, then y, then z, and shifted.
Vec3d placed(const ScenePlace& place, const Vec3d& p);
/// Only turned.
Vec3d turned(const ScenePlace& place, const Vec3d& p);

/// One of every instance.
std::vector<ScenePlace> places_of(const SceneBody& body);

Pose pose_of(const ScenePlace& place);

}  // namespace tetsoup::scene
