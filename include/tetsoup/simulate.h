// tetsoup: bodies made of tets fall, bend, collide and come to rest.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "tetsoup/progress.h"
#include "tetsoup/readiness.h"
#include "tetsoup/types.h"

namespace tetsoup {

inline constexpr double kDefaultFriction = 0.5;
inline constexpr int kDefaultObstacleVoxels = 64;

/// What a body is made of.
struct SimMaterial {
  Material elastic{};
  /// s, >= 0: stress grows by this much of what the rate of strain would add in a second [Kelvin and Voigt]. Motion of
  /// angular frequency w dies with w^2 / 2 of it; that of a rigid body never does. The implicit solver takes less of it
  /// where a substep is long for the stiffness.
  double damping_time = 0.002;
  double friction = kDefaultFriction;  ///< Coulomb's coefficient, >= 0; between two, the geometric mean counts.
};

/// Where a body is placed and how it moves there: scaled, turned about x, then y, then z, and shifted.
struct Pose {
  Vec3d translate{};
  Vec3d rotate{};    ///< Radians.
  double scale = 1;  ///< > 0.
  Vec3d velocity{};  ///< m/s.
  Vec3d spin{};      ///< rad/s, about the body's centre of mass.
};

enum class Solver {
  /// Position based, unconditionally stable: every tet in turn is moved to the least of its inertia and its elastic
  /// energy.
  Implicit,
  /// Edges keep their length, triangles their area and tets their volume, by explicit forces [THMG04].
  Potentials,
};

enum class Contacts {
  All,      ///< Obstacles, bodies with each other, and each with itself.
  Between,  ///< Not with itself.
  None,     ///< Not even with obstacles.
};

/// Stiffnesses of Solver::Potentials, J: energy is k/2 (relative change)^2 [THMG04 eq. 2-4]. What is not given follows
/// from the material: in a mesh without preferred directions the springs then have its shear modulus, and springs and
/// volumes together its bulk modulus, for Poisson ratios from 1/4 on. Damping acts along each potential's own gradient,
/// k_d = damping_time k [THMG04 eq. 7].
struct PotentialOptions {
  std::optional<double> distance, area, volume;
};

struct SimulationOptions {
  Solver solver = Solver::Implicit;
  Vec3d gravity{0, 0, -9.81};  ///< m/s^2.
  /// Of each 1/60 s, at least; 1..10000. They belong to time: bodies move alike at any number of steps a second.
  /// Potentials take more where stability asks for it,
  int substeps = 10;
  /// and the implicit solver up to so many where sound would pass more than .7 edges of the mesh within a substep,
  /// since bodies would then be softer than their material; 1..10000. What is below `substeps` counts for nothing.
  int max_substeps = 200;
  int contact_interval = 5;  ///< Substeps from one search for contacts to the next, >= 1; in proportion where there are
                             ///< more than `substeps`. A step begins with a search.
  Contacts contacts = Contacts::All;
  PotentialOptions potentials;
};

/// A vertex of a body, by its index in the mesh the body was made of.
struct BodyVertex {
  std::size_t body = 0;
  std::uint32_t vertex = 0;
};

struct SimulationReport {
  std::size_t tet_count = 0;       ///< That are simulated.
  std::size_t left_out = 0;        ///< Tets without positive volume, or invalid.
  std::size_t loose_vertices = 0;  ///< Of no simulated tet; they stay where they are placed.
  std::size_t parts = 0;           ///< Pieces that share no vertex.
  int substeps = 0;                ///< Of the last step.
  std::size_t contacts = 0;        ///< Between bodies, and
  std::size_t touching = 0;        ///< with obstacles, that pushed in the last substep.
  std::size_t clamped = 0;         ///< Times a vertex was held back since it was to move unreasonably far.
};

struct Energy {
  double kinetic = 0;  ///< J.
  double elastic = 0;
  double gravity = 0;  ///< Potential; zero at the origin.
  double total() const { return kinetic + elastic + gravity; }
};

struct Momentum {
  Vec3d linear;   ///< kg m/s.
  Vec3d angular;  ///< kg m^2/s, about the origin.
};

/// Deformable bodies, obstacles, and time.
///
/// A step of Solver::Implicit is so many small substeps of extended position based dynamics [Macklin19]: bodies move
/// freely, then each tet in turn is brought to the least of inertia and elastic energy, solved in full for the
/// deviatoric part, and each body is given back the momentum and angular momentum that this cost; then contacts push
/// and rub. Bodies with pinned vertices, up to 4,000 tets and no spring or attachment, are solved whole instead, by
/// implicit midpoint steps in double. Velocities of the others are those half a substep ago [Verlet67], which makes
/// free fall exact. Metres, kilograms, seconds; `Material::metres_per_unit` and `Pose::scale` bring meshes there.
/// Nothing is random, nothing depends on the number of threads or the instruction set: `state_hash()` is the same
/// everywhere.
///
/// @code
///   tetsoup::Simulation simulation;
///   simulation.add_plane({0, 0, 1}, 0);
///   const std::size_t body = simulation.add_body(mesh, {}, {.translate = {0, 0, 2}});
///   for (int frame = 0; frame < 120; ++frame) {
///     simulation.step(1.0 / 60);
///     draw(simulation.positions(body));
///   }
/// @endcode
class Simulation {
 public:
  /// @throws InvalidInput  if an option is out of range.
  explicit Simulation(const SimulationOptions& options = {});
  ~Simulation();
  Simulation(Simulation&&) noexcept;
  Simulation& operator=(Simulation&&) noexcept;

  /// @return  The body's number: 0, 1, 2, ...
  /// @throws InvalidInput  if material or pose is out of range, a vertex would lie beyond 1e5 m, or edges are shorter
  ///                       than 1e-6 m in the mean. Tets that cannot be simulated are left out and counted.
  std::size_t add_body(const TetMesh& mesh, const SimMaterial& material = {}, const Pose& pose = {});
  /// Many bodies of one make, which share what they are made of and are faster for it.
  /// @return  The number of the first.
  std::size_t add_bodies(const TetMesh& mesh, const SimMaterial& material, std::span<const Pose> poses);

  /// Keeps bodies where dot(normal, p) >= offset; the normal need not be a unit vector.
  void add_plane(const Vec3d& normal, double offset, double friction = kDefaultFriction);
  /// Keeps bodies out of the pseudo volume of any soup, by its signed distance on a grid of so many voxels.
  /// @throws InvalidInput  if the soup has no finite triangle, a number is out of range, or the grid would have more
  ///                       than 1.5e8 voxels; Cancelled.
  void add_obstacle(const TriangleSoup& soup, int voxels = kDefaultObstacleVoxels, double friction = kDefaultFriction,
                    const Progress& progress = {});

  /// Holds a vertex where it is.
  void pin(const BodyVertex& vertex);
  void unpin(const BodyVertex& vertex);
  /// Makes two vertices one, as far as they can move.
  void attach(const BodyVertex& a, const BodyVertex& b);
  /// Pulls a vertex to a point, with so many N/m: what a mouse does.
  /// @return  The spring's number.
  std::size_t add_spring(const BodyVertex& vertex, const Vec3d& target, double stiffness);
  void move_spring(std::size_t spring, const Vec3d& target);
  void remove_spring(std::size_t spring);

  /// Advances time by `dt` seconds, (0, 1], in equal substeps that are no longer than the options say. Stopped by
  /// `progress`, asked after every substep, bodies and time stay where the last whole substep has left them, and the
  /// simulation can go on from there.
  /// @throws InvalidInput  if `dt` is out of range; Cancelled.
  /// Cost: about 10 ns a tet and substep, and 0.1 to 0.4 us a tet for every search for contacts; all threads.
  void step(double dt, const Progress& progress = {});

  std::size_t body_count() const;
  double time() const;
  /// Of the body's vertices, in the order of its mesh; the span holds as long as the simulation, and shows every step.
  std::span<const Vec3> positions(std::size_t body) const;
  std::span<const Vec3> velocities(std::size_t body) const;
  /// @throws InvalidInput  if there are not as many as vertices, or one is not finite or too far out.
  void set_positions(std::size_t body, std::span<const Vec3> positions);
  void set_velocities(std::size_t body, std::span<const Vec3> velocities);

  const SimulationReport& report() const;
  Energy energy() const;      ///< Of all bodies; pinned vertices and springs do not count.
  Momentum momentum() const;  ///< Of all bodies.
  Momentum momentum(std::size_t body) const;
  double volume(std::size_t body) const;  ///< Signed, of its simulated tets as they are now.
  /// Of all positions and velocities, to the bit.
  std::uint64_t state_hash() const;

  /// All that steps have changed, for restore_state(); good on machines with the same order of bytes.
  std::vector<std::byte> save_state() const;
  /// Goes on where a simulation stood that had been built in the same way (bodies, pins, springs, attachments and
  /// obstacles), to the bit.
  /// @throws InvalidInput  if the bytes are damaged, hold what no simulation can have come to, or are of one that was
  ///                       built otherwise; nothing changes then.
  void restore_state(std::span<const std::byte> state);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace tetsoup
