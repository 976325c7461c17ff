// What is behind the handles. What several of them need is shared, so that they may be destroyed in any order.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "c/guard.h"
#include "tetsoup/pipeline.h"
#include "tetsoup/render_mesh.h"
#include "tetsoup/scene.h"
#include "tetsoup/simulate.h"
#include "tetsoup/tet_model.h"
#include "tetsoup/tetsoup_c.h"

namespace tetsoup::c {

/// The input as read, and its triangles.
struct Input {
  RenderMesh render;
  TriangleSoup soup;
};

/// Tets with the surface that hangs on them; never changes.
struct Make {
  TetMesh mesh;
  RenderMesh render;                ///< Empty without a surface,
  Embedding embedding;              ///< as are the places of its vertices;
  std::vector<Triangle> triangles;  ///< then these are the mesh's boundary.
  std::vector<Vec3> normals;        ///< Of the surface at rest.
};

/// With the embedding that is given, else with one made here.
Make make_of(TetMesh mesh, RenderMesh render, std::optional<Embedding> embedding, const Progress& progress);

/// Moves the surface with the mesh; either result may be left out.
void deform(const Make& make, std::span<const Vec3> positions, std::vector<Vec3>* surface, std::vector<Vec3>* normals);

tetsoup_floats view_of(std::span<const Vec3> points);
template <std::size_t width>
tetsoup_indices view_of(const std::vector<std::array<std::uint32_t, width>>& items) {
  return {items.empty() ? nullptr : items.front().data(), items.size(), width};
}

/// @throws InvalidInput  naming the argument, if it is NULL.
std::vector<Vec3> points_from(const float* xyz, std::size_t count, const char* name);
template <std::size_t width>
std::vector<std::array<std::uint32_t, width>> items_from(const std::uint32_t* indices, std::size_t count,
                                                         const char* name) {
  given_items(indices, count, name);
  std::vector<std::array<std::uint32_t, width>> items(count);
  for (std::size_t i = 0; i < count * width; ++i) items[i / width][i % width] = indices[i];
  return items;
}
Vec3d vector_from(const double* xyz, const char* name);

}  // namespace tetsoup::c

struct tetsoup_soup {
  std::shared_ptr<const tetsoup::c::Input> input;
};

struct tetsoup_pipeline {
  explicit tetsoup_pipeline(std::shared_ptr<const tetsoup::c::Input> from, const tetsoup::Progress& progress)
      : input(std::move(from)), pipeline(input->soup, progress) {}

  std::shared_ptr<const tetsoup::c::Input> input;
  tetsoup::Pipeline pipeline;
  std::optional<std::size_t> memory_limit;
  tetsoup::MeshOptions options;                              ///< Of the last run.
  tetsoup::Stage done = tetsoup::Stage::Soup;                ///< The last stage that is up to date.
  std::array<std::vector<tetsoup::Triangle>, 2> boundaries;  ///< Of both meshes; made when asked for.
  std::vector<tetsoup::Triangle> cavities;                   ///< Those asked for last.
  std::vector<float> qualities, slice;                       ///< Behind the last view of each.

  /// @throws InvalidInput  if the stage has no result that is up to date.
  void require_stage(tetsoup::Stage stage) const;
};

struct tetsoup_model {
  std::shared_ptr<const tetsoup::c::Make> make;
  tetsoup::TetModel settings;  ///< Name, material, pins and direction; the rest is in `make`.
  bool material_is_default = true;
  std::vector<tetsoup::Vec3> surface, normals;  ///< As last deformed.
};

struct tetsoup_simulation {
  struct Body {
    std::string name;
    std::shared_ptr<const tetsoup::c::Make> make;
    std::vector<tetsoup::Vec3> surface, normals;
  };
  std::optional<tetsoup::LoadedScene> scene;  ///< With its own simulation,
  std::optional<tetsoup::Simulation> own;     ///< else this one.
  std::vector<Body> bodies;

  tetsoup::Simulation& simulation() { return scene ? scene->simulation : *own; }
  const tetsoup::Simulation& simulation() const { return scene ? scene->simulation : *own; }
  /// @throws InvalidInput  if there is none of that number.
  const Body& body(std::size_t number) const;
  Body& body(std::size_t number) { return const_cast<Body&>(std::as_const(*this).body(number)); }
};
