// MuJoCo's scene: a flexcomp above a plane.
#include "io/engines/scene_parts.h"
#include "io/xml_tags.h"

namespace tetsoup {

namespace {

// MuJoCo's default step; the implicit integrator's linear solver, with the damping below, took 15 explicit steps on all
// models that were tried and failed at 30.
constexpr StepLimit kLimit{0.002, 12};

constexpr std::string_view kScene =
    R"(<!-- A soft body falls on a plane, in MuJoCo 4 or later: drop this file on the window of python -m mujoco.viewer
     young: @why@. -->
<mujoco model="@name@">
  <!-- "discrete" takes the elasticity implicitly; other integrators need far shorter steps. -->
  <option timestep="@step@" integrator="discrete"/>
  <statistic center="0 0 @middle@" extent="@height@"/>
  <visual><headlight ambient=".4 .4 .4"/></visual>
  <worldbody>
    <light pos="0 0 @high@" dir="0 0 -1"/>
    <geom type="plane" size="@wide@ @wide@ .1" rgba=".85 .87 .9 1"/>
    <flexcomp name="@name@" type="gmsh" dim="3" file="@file@" mass="@mass@" radius="@radius@"
              pos="@x@ @y@ @lift@" quat="@quat@" rgba=".35 .55 .8 1">
      <elasticity young="@young@" poisson="@poisson@" damping="0.002"/>
      <contact selfcollide="none"/>@pins@
    </flexcomp>
  </worldbody>
</mujoco>
)";

}  // namespace

std::string mujoco_scene(const SceneInput& input) {
  const Drop drop = plan_drop(input, kLimit);
  std::string pins = pin_list(input.model, 0, " ");
  if (!pins.empty()) pins = "\n      <pin id=\"" + pins + "\"/>";
  return filled(kScene, gaps_of(drop, {{"step", brief(drop.time_step)},
                                       {"middle", brief(drop.height / 2)},
                                       {"high", brief(3 * drop.height)},
                                       {"wide", brief(5 * drop.height)},
                                       {"file", escaped_xml(input.mesh_file)},
                                       {"radius", brief(0.005 * drop.height)},
                                       {"quat", upright_wxyz(input.model.up, " ")},
                                       {"pins", pins}}));
}

}  // namespace tetsoup
