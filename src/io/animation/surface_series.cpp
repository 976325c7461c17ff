#include "io/animation/surface_series.h"

#include <utility>
#include <vector>

#include "io/file_names.h"
#include "io/number_text.h"
#include "io/obj_text.h"
#include "tetsoup/io.h"

namespace tetsoup::animation {
namespace {

void append_triangles(std::string& text, std::span<const Vec3> points, const std::vector<Triangle>& triangles,
                      std::size_t first) {
  for (const Vec3& p : points) append_line(text += "v ", p.x, p.y, p.z);
  for (const Triangle& t : triangles) append_line(text += "f ", first + t[0] + 1, first + t[1] + 1, first + t[2] + 1);
}

}  // namespace

SurfaceSeries::SurfaceSeries(const Cast& cast, std::filesystem::path path) : cast_(cast), path_(std::move(path)) {}

void SurfaceSeries::add(FrameView& view, std::size_t number, FileLog& log) const {
  const std::string extension = lower_extension(path_);
  const std::filesystem::path file = numbered(path_, path_.stem().string(), number, extension);
  if (extension == ".obj") return log.write(file, obj_text(view));
  write_ply(file, view);
  log.note(file);
}

// Normals are left out: those of the file are not those of the deformed surface.
std::string SurfaceSeries::obj_text(FrameView& view) const {
  std::string text;
  std::size_t first_vertex = 0, first_texcoord = 0;
  for (std::size_t b = 0; b < view.body_count(); ++b) {
    const Make& make = view.make(b);
    const std::string& name = cast_.scene.bodies[b].name;
    append_name_line(text, "o", name);
    if (const RenderMesh* surface = make.surface; surface != nullptr) {
      append_obj(text, *surface, {view.points(b), {}, name, first_vertex, first_texcoord});
      first_texcoord += surface->texcoords.size();
    } else {
      append_triangles(text, view.points(b), make.triangles, first_vertex);
    }
    first_vertex += make.point_count;
  }
  return text;
}

void SurfaceSeries::write_ply(const std::filesystem::path& file, FrameView& view) const {
  std::vector<Vec3> points;
  std::vector<Triangle> triangles;
  for (std::size_t b = 0; b < view.body_count(); ++b) {
    const auto first = static_cast<std::uint32_t>(points.size());
    const std::span<const Vec3> seen = view.points(b);
    points.insert(points.end(), seen.begin(), seen.end());
    for (const Triangle& t : view.make(b).triangles) triangles.push_back({first + t[0], first + t[1], first + t[2]});
  }
  write_surface(file, points, triangles);
}

void write_obstacles(const Cast& cast, const std::filesystem::path& path, FileLog& log) {
  if (cast.obstacles.empty()) return;
  std::string text;
  std::size_t first = 0;
  for (std::size_t i = 0; i < cast.obstacles.size(); ++i) {
    append_name_line(text, "o", cast.scene.obstacles[i].name);
    append_triangles(text, cast.obstacles[i].vertices, cast.obstacles[i].triangles, first);
    first += cast.obstacles[i].vertices.size();
  }
  log.write(path, text);
}

}  // namespace tetsoup::animation
