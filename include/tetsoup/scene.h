// tetsoup::io: a scene in words: what falls, onto what, of what it is made. docs/SCENES.md has the keys of the files.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "tetsoup/embed.h"
#include "tetsoup/pipeline.h"
#include "tetsoup/progress.h"
#include "tetsoup/render_mesh.h"
#include "tetsoup/simulate.h"
#include "tetsoup/types.h"

namespace tetsoup {

/// What of a source comes to lie at the origin, before the body is placed.
enum class SceneOrigin {
  Own,     ///< The origin of its file or formula.
  Centre,  ///< The centre of its box.
  Bottom,  ///< The centre of its box's lowest face.
};

/// Where triangles or tets come from: exactly one of `sample`, `file`, `tets_file` and `box`.
struct SceneSource {
  std::string sample;        ///< A name make_sample() knows.
  std::string file;          ///< Triangles; from the scene's folder on, unless absolute.
  std::string tets_file;     ///< Ready tets; not for obstacles.
  std::optional<Vec3d> box;  ///< A box about the origin, of these sizes.
  double damage = 0;         ///< Of the sample, as in SampleOptions.
  std::uint64_t seed = 1;
  std::optional<double> size;             ///< Metres of the longest side of its box; or else
  std::optional<double> metres_per_unit;  ///< what its unit is; neither given: 1.
  SceneOrigin origin = SceneOrigin::Own;
  bool operator==(const SceneSource&) const = default;
};

/// As a Pose, but for angles: degrees, and degrees a second.
struct ScenePlace {
  Vec3d translate{}, rotate{};
  double scale = 1;
  Vec3d velocity{}, spin{};
  bool operator==(const ScenePlace&) const = default;
};

/// Instances in rows, columns and layers; their middle is at the body's place.
struct SceneGrid {
  std::array<int, 3> count{1, 1, 1};
  Vec3d spacing{1, 1, 1};    ///< From one to the next, m.
  double jitter = 0;         ///< Each is off by up to this much along each axis, m,
  double jitter_rotate = 0;  ///< and about each axis, degrees: the same for the same seed everywhere.
  std::uint64_t seed = 1;
  bool operator==(const SceneGrid&) const = default;
};

/// Vertices that are held, or moved by hand; in the body's own metres and directions, before it is placed. Either in a
/// box, or along an axis below or above something, or between the two.
struct ScenePin {
  std::optional<Box3> box;
  std::optional<int> axis;  ///< 0, 1, 2: x, y, z.
  std::optional<double> below, above;
  Vec3d velocity{};               ///< m/s.
  Vec3d spin{};                   ///< Degrees a second about an axis through
  std::optional<Vec3d> about;     ///< this point; without it through the middle of the vertices.
  std::optional<double> until;    ///< Time from which on they stay where they are, s.
  std::optional<double> release;  ///< Time from which on they are free, s.
  bool operator==(const ScenePin&) const = default;
};

/// Pulls the vertex that is nearest to a point of the body, before it is placed, to a point of the scene.
struct SceneSpring {
  Vec3d at{}, to{};
  double stiffness = 100;  ///< N/m.
  bool operator==(const SceneSpring&) const = default;
};

/// Bodies of one make. Where there are neither `instances` nor `grid`, one at `place`.
struct SceneBody {
  std::string name;  ///< Empty: that of its source.
  SceneSource source;
  MeshOptions mesh;  ///< Lengths in metres.
  SimMaterial material;
  ScenePlace place;
  std::vector<ScenePlace> instances;  ///< Each in place of `place`.
  std::optional<SceneGrid> grid;
  std::vector<ScenePin> pins;
  std::vector<SceneSpring> springs;
  bool surface = true;       ///< A surface hangs on the tets: the source's own triangles, or
  std::string surface_file;  ///< those of this file, in the same place.
};

struct ScenePlane {
  Vec3d normal{0, 0, 1};
  double offset = 0;  ///< Bodies stay where dot(normal, p) >= offset.
  bool operator==(const ScenePlane&) const = default;
};

/// What does not move: a plane or the pseudo volume of a source.
struct SceneObstacle {
  std::string name;
  std::optional<ScenePlane> plane;
  SceneSource source;
  ScenePlace place;  ///< It neither moves nor spins.
  int voxels = kDefaultObstacleVoxels;
  double friction = kDefaultFriction;
};

struct Scene {
  std::string title;
  std::filesystem::path folder;  ///< Where names of files begin; not written.
  SimulationOptions simulation;  ///< Substeps are those of a step of at most 1/60 s.
  double seconds = 4;            ///< Of time in the scene.
  double fps = 60;               ///< Frames a second.
  std::vector<SceneBody> bodies;
  std::vector<SceneObstacle> obstacles;
};

/// @throws IoError  if the file cannot be read or is no scene: the text names line and column, or the key by its path
///                  and what it may be.
Scene read_scene(const std::filesystem::path& path);
/// The same from memory; `name` stands for the path in errors.
Scene parse_scene(std::string_view text, const std::filesystem::path& folder, std::string_view name = "scene");
/// Parts of a scene that stand alone: JSON with the keys of a body's "mesh", of the scene itself as far as they are
/// SimulationOptions, and of a body's "material" and "place".
/// @throws InvalidInput  if it is not that: the text names line and column, or the key and what it may be.
MeshOptions parse_mesh_options(std::string_view text);
SimulationOptions parse_simulation_options(std::string_view text);
SimMaterial parse_material(std::string_view text);
Pose parse_place(std::string_view text);

/// JSON that parse_scene() gives back as this scene; what is as by default is left out.
std::string scene_text(const Scene& scene);
/// @throws InvalidInput  if a number is out of range or things do not go together; the text names the key by its path.
void check_scene(const Scene& scene);

/// Scenes of samples, in a fixed order.
std::vector<std::string> scene_names();
/// One line on what it shows.
std::string scene_summary(std::string_view name);
/// @throws InvalidInput  for an unknown name; the text lists the known ones.
Scene make_scene(std::string_view name);

/// Frames after the first state.
std::size_t frame_count(const Scene& scene);

/// What bodies of one source, size and meshing options share; metres.
struct SceneAsset {
  std::string name;
  TetMesh mesh;
  RenderMesh surface;   ///< Empty without one,
  Embedding embedding;  ///< as are the places of its vertices.
  bool has_surface() const { return !surface.vertices.empty(); }
};

/// A body of the simulation, by the same number.
struct LoadedBody {
  std::string name;
  std::size_t scene_body = 0, instance = 0;
  std::size_t asset = 0;
};

/// Vertices of a body that are moved by hand, or let go.
struct MovedPin {
  std::size_t body = 0;
  std::vector<std::uint32_t> vertices;
  std::vector<Vec3> starts;  ///< Where they were.
  Vec3d centre, velocity;
  Vec3d spin;  ///< Radians a second.
  std::optional<double> until, release;
  bool released = false;
};

struct LoadedObstacle {
  std::string name;
  TriangleSoup soup;  ///< Where it stands.
};

/// A scene that can be played.
struct LoadedScene {
  Scene scene;
  std::vector<SceneAsset> assets;
  std::vector<LoadedBody> bodies;
  std::vector<LoadedObstacle> obstacles;  ///< But for planes.
  std::vector<MovedPin> moved;
  Simulation simulation;
  std::vector<std::vector<Vec3>> surfaces;  ///< Of every body, as deform_surfaces() left them; empty without one.
  std::size_t frame = 0;                    ///< Frames since the start.
};

/// Reads or makes all soups, meshes them, hangs the surfaces on the meshes, and puts all of it into a simulation.
/// @throws InvalidInput  as check_scene() does, and where only the meshes tell that something is wrong; IoError;
///                       Cancelled.
LoadedScene load_scene(const Scene& scene, const Progress& progress = {});

/// Steps of the simulation that make a frame, so that none is longer than 1/60 s: few frames a second change nothing of
/// the motion. Where pins are moved by hand, each search for contacts has a step of its own.
int steps_of_frame(const LoadedScene& loaded);

/// Simulates one frame, 1 / fps seconds.
void advance_frame(LoadedScene& loaded);

/// Time stands after so many frames then: pins that are let go by then are free, others held, and those that are moved
/// go on from there with the next frame; what moves freely stays where it is.
void seek_frame(LoadedScene& loaded, std::size_t frame);

/// Moves all surfaces with their bodies.
void deform_surfaces(LoadedScene& loaded);

/// All that changes while a scene is played, for restore_scene() of the same scene: it goes on to the bit.
std::vector<std::byte> save_scene_state(const LoadedScene& loaded);
/// @throws InvalidInput  if they are not the bytes of a state of this scene.
void restore_scene_state(LoadedScene& loaded, std::span<const std::byte> bytes);

}  // namespace tetsoup
