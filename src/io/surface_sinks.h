// Where the readers of surfaces put what they find: the one reader of a format serves both sinks. A soup takes
// triangles alone; a render mesh also takes polygons, texture coordinates, normals and names.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include "tetsoup/render_mesh.h"
#include "tetsoup/types.h"

namespace tetsoup::readers {

/// Cuts one polygon into a fan while its corners arrive; fewer than three corners leave nothing.
template <class Sink>
class Fan {
 public:
  explicit Fan(Sink& sink) : sink_(sink) {}

  void add(std::uint32_t corner) {
    if (corner_count_ == 0) first_ = corner;
    if (corner_count_ >= 2) sink_.add_triangle(first_, previous_, corner);
    previous_ = corner;
    ++corner_count_;
  }
  void finish() {}

 private:
  Sink& sink_;
  std::uint32_t first_ = 0, previous_ = 0;
  std::size_t corner_count_ = 0;
};

/// Turns a strip into triangles of one orientation while its corners arrive.
template <class Sink>
class Strip {
 public:
  explicit Strip(Sink& sink) : sink_(sink) {}

  void restart() { corner_count_ = 0; }
  void add(std::uint32_t corner) {
    if (corner_count_ >= 2) {
      if (corner_count_ % 2 == 0) {
        sink_.add_triangle(older_, previous_, corner);
      } else {
        sink_.add_triangle(previous_, older_, corner);
      }
    }
    older_ = previous_;
    previous_ = corner;
    ++corner_count_;
  }

 private:
  Sink& sink_;
  std::uint32_t older_ = 0, previous_ = 0;
  std::size_t corner_count_ = 0;
};

class SoupSink {
 public:
  static constexpr bool kDetails = false;
  using Polygon = Fan<SoupSink>;

  void reserve_vertices(std::size_t added) { points_.reserve(points_.size() + added); }
  void reserve_faces(std::size_t added) { soup_.triangles.reserve(soup_.triangles.size() + added); }
  void add_vertex(const Vec3d& vertex) { points_.push_back(vertex); }
  void add_triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) { soup_.triangles.push_back({a, b, c}); }
  std::size_t vertex_count() const { return points_.size(); }
  std::size_t face_count() const { return soup_.triangles.size(); }
  /// Counted from where make_soup() counts from.
  TriangleSoup take();

 private:
  std::vector<Vec3d> points_;
  TriangleSoup soup_;
};

class MeshSink {
 public:
  static constexpr bool kDetails = true;

  /// A polygon as it is.
  class Polygon {
   public:
    explicit Polygon(MeshSink& sink) : sink_(sink), first_(sink.mesh_.corners.size()) {}
    void add(std::uint32_t vertex, std::uint32_t texcoord = RenderMesh::kNone,
             std::uint32_t normal = RenderMesh::kNone) {
      RenderMesh& mesh = sink_.mesh_;
      append_choice(mesh.corner_texcoords, mesh.corners.size(), texcoord);
      append_choice(mesh.corner_normals, mesh.corners.size(), normal);
      mesh.corners.push_back(vertex);
    }
    /// Fewer than three corners leave nothing.
    void finish();

   private:
    /// Corners before the first that has one are given none now.
    static void append_choice(std::vector<std::uint32_t>& choices, std::size_t corner, std::uint32_t choice) {
      if (choice == RenderMesh::kNone && choices.empty()) return;
      if (choices.size() < corner) choices.resize(corner, RenderMesh::kNone);
      choices.push_back(choice);
    }

    MeshSink& sink_;
    std::size_t first_;
  };

  /// @param file_bytes  How much the names of all parts together may take depends on it: each part repeats its three.
  MeshSink(std::string_view file_name, std::size_t file_bytes) : file_name_(file_name), file_bytes_(file_bytes) {}

  void reserve_vertices(std::size_t added) { points_.reserve(points_.size() + added); }
  void reserve_faces(std::size_t added);
  void add_vertex(const Vec3d& vertex) { points_.push_back(vertex); }
  void add_triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c);
  std::size_t vertex_count() const { return points_.size(); }
  std::size_t face_count() const { return mesh_.face_sizes.size(); }
  std::size_t corner_count() const { return mesh_.corners.size(); }

  void add_texcoord(const Vec2& texcoord) { mesh_.texcoords.push_back(texcoord); }
  void add_normal(const Vec3& normal) { mesh_.normals.push_back(normal); }
  std::size_t texcoord_count() const { return mesh_.texcoords.size(); }
  std::size_t normal_count() const { return mesh_.normals.size(); }

  /// For corners from `first_corner` on: what lies `count` entries from `first_texcoord` on belongs to the vertices
  /// from `first_vertex` on.
  void take_vertex_texcoords(std::size_t first_corner, std::size_t first_vertex, std::size_t count,
                             std::size_t first_texcoord);
  void take_vertex_normals(std::size_t first_corner, std::size_t first_vertex, std::size_t count,
                           std::size_t first_normal);

  /// Names of the faces that follow.
  void set_object(std::string name) { set_name(next_part_.object, std::move(name)); }
  void set_group(std::string name) { set_name(next_part_.group, std::move(name)); }
  void set_material(std::string name) { set_name(next_part_.material, std::move(name)); }

  /// Counted from where the soup's are. Corners whose texture coordinate or normal the file does not have get none.
  RenderMesh take();

 private:
  void set_name(std::string& place, std::string name) {
    place = std::move(name);
    part_known_ = false;
  }
  void add_face(std::uint32_t size) {
    if (!part_known_) find_part();
    mesh_.face_sizes.push_back(size);
    mesh_.face_parts.push_back(part_);
  }
  void find_part();

  std::string_view file_name_;
  std::size_t file_bytes_ = 0, name_bytes_ = 0;
  std::vector<Vec3d> points_;
  RenderMesh mesh_;
  RenderMesh::Part next_part_;
  bool part_known_ = false;
  std::uint32_t part_ = 0;
  std::map<std::tuple<std::string, std::string, std::string>, std::uint32_t> part_of_names_;
};

}  // namespace tetsoup::readers
