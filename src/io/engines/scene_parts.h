// What all scenes share: where the body starts, how stiff it can be, and texts with gaps to fill.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/unions.h"
#include "io/engines/scenes.h"

namespace tetsoup {

/// What an engine's integrator bears.
struct StepLimit {
  double default_step = 0.01;  ///< s, the engine's own.
  double bearable = 0;         ///< Most steps of the explicit bound (readiness.h) that one step may span; 0: any.
};

/// The body in a world whose z points up, and the numbers of its one material.
struct Drop {
  std::string name;       ///< Legal in every format.
  double height = 0;      ///< m, of the body.
  double x = 0, y = 0;    ///< m; shifts that put the middle of the body over the origin,
  double lift = 0;        ///< and its lowest point a little above the plane.
  double mass = 0;        ///< kg
  double density = 0;     ///< kg/m^3, the mean where regions differ.
  double young = 0;       ///< Pa, the mean where regions differ.
  double stiffening = 1;  ///< `young` over what the model says.
  double poisson = 0;
  double time_step = 0;       ///< s
  double edge = 0;            ///< m, of a regular tet as large as the mean one.
  std::string stiffness_why;  ///< One line that says where `young` and `time_step` come from.
};

/// A default material stands for "any soft one": it gets the stiffness with which a body of this height hardly sags, or
/// the stiffest that the engine's own step bears. A chosen one is kept, and the step shortened where it must be.
Drop plan_drop(const SceneInput& input, const StepLimit& limit);

/// First Lame parameter and shear modulus.
std::pair<double, double> lame(const Drop& drop);

/// Quaternion w x y z that turns the model's up into z, with `between` between the numbers.
std::string upright_wxyz(UpAxis up, std::string_view between);
std::string upright_xyzw(UpAxis up, std::string_view between);

/// Names that stand between @ in a text, and what comes in their place.
using Gaps = std::vector<std::pair<std::string_view, std::string>>;

/// `more`, and what every scene may ask of the drop: name, why, height, mass, density, young, poisson, x, y, lift.
Gaps gaps_of(const Drop& drop, Gaps more);

/// The text with all gaps filled.
std::string filled(std::string_view text, const Gaps& gaps);

/// The same of a Python script that has a function simulate(), with the lines that call it at its end.
std::string filled_script(std::string_view text, const Gaps& gaps);

/// Four digits, which is what scenes show.
std::string brief(double value);
std::string quoted_python(std::string_view text);
/// Vertices that tets join are of one set.
Unions pieces_of(const TetMesh& mesh);
/// Pinned vertices in lines of sixteen.
std::string pin_list(const TetModel& model, std::uint32_t base, std::string_view between);

std::string mujoco_scene(const SceneInput& input);
std::string newton_scene(const SceneInput& input);
std::string pybullet_scene(const SceneInput& input);
std::string drake_scene(const SceneInput& input);
std::string sofa_scene(const SceneInput& input);
std::string calculix_scene(const SceneInput& input);

}  // namespace tetsoup
