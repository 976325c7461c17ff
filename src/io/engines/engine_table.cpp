#include "io/engines/engine_table.h"

namespace tetsoup {

std::vector<Engine> engine_table() {
  return {
      {"abaqus", "Abaqus", "Abaqus input deck (.inp), 1-based, positive C3D4, metres, a section per region",
       TetFormat::Abaqus, ".inp", "", "import it as an orphan mesh, or *INCLUDE, INPUT={mesh} in a deck of your own"},
      {"blender", "Blender", "OBJ with one four-cornered face a tet (.obj), metres, a group per region",
       TetFormat::ObjTets, ".obj", "", "in Blender, File > Import > Wavefront (.obj), {mesh}: every face is a tet"},
      {"bullet", "Bullet and PyBullet", "legacy VTK 3.0 (.vtk), 0-based, positive, metres, one point a line",
       TetFormat::Vtk, ".vtk", "_pybullet.py", "python {scene} --view"},
      {"calculix", "CalculiX", "Abaqus input deck (.inp), 1-based, positive C3D4, metres, a section per region",
       TetFormat::Abaqus, ".inp", "_gravity.inp", "ccx {stem}_gravity"},
      {"dart", "DART", "Gmsh MSH 2.2 (.msh), 1-based, positive, metres", TetFormat::Msh22, ".msh", "",
       "load it with dart::simulation::io::loadGmshTetMeshFile(\"{mesh}\")"},
      {"drake", "Drake", "legacy VTK 3.0 (.vtk), 0-based, positive, metres, tets only", TetFormat::Vtk, ".vtk",
       "_drake.py", "python {scene} --view"},
      {"genesis", "Genesis", "Gmsh MSH 4.1 (.msh), positive, metres", TetFormat::Msh41, ".msh", "",
       "Genesis makes its own tets from surfaces; read \"{mesh}\" with meshio to hand these over"},
      {"gmsh", "Gmsh", "Gmsh MSH 2.2 (.msh), positive, metres, a physical volume per region", TetFormat::Msh22, ".msh",
       "", "open it with: gmsh {mesh}"},
      {"godot", "Godot", "JSON of flat arrays (.json), 0-based, positive, metres", TetFormat::Json, ".json", "",
       "read it with JSON.parse_string(FileAccess.get_file_as_string(\"res://{mesh}\"))"},
      {"isaac", "Isaac Sim, Isaac Lab and Omniverse", "USD (.usda): TetMesh, render mesh and embedding, metres",
       TetFormat::Usd, ".usda", "", "add it to the stage as a reference to {mesh}"},
      {"isaacgym", "Isaac Gym", "Isaac Gym tets (.tet), 0-based, positive, metres", TetFormat::IsaacGym, ".tet", "",
       "name it in a URDF: <fem><tetmesh filename=\"{mesh}\"/></fem>"},
      {"jolt", "Jolt", "JSON of flat arrays (.json), 0-based, positive, metres", TetFormat::Json, ".json", "",
       "fill SoftBodySharedSettings from {mesh}: mVertices, mEdgeConstraints, mVolumeConstraints, faces by AddFace()"},
      {"libuipc", "libuipc", "Gmsh MSH 2.2 (.msh), positive, metres", TetFormat::Msh22, ".msh", "",
       "load it with uipc.geometry.SimplicialComplexIO().read(\"{mesh}\")"},
      {"mmg", "mmg and fTetWild", "MEDIT (.mesh), 1-based, positive, metres, a reference per region", TetFormat::Medit,
       ".mesh", "", "remesh it with: mmg3d_O3 {mesh}"},
      {"mujoco", "MuJoCo", "Gmsh MSH 4.1 (.msh), one node block and one element block, metres", TetFormat::Msh41,
       ".msh", ".xml", "python -m mujoco.viewer --mjcf={scene}"},
      {"netgen", "Netgen and NGSolve", "Netgen volume mesh (.vol), 1-based, negative, metres, a domain per region",
       TetFormat::Netgen, ".vol", "", "load it with ngsolve.Mesh(\"{mesh}\")"},
      {"newton", "Newton", "NumPy arrays (.npz), 0-based, positive, metres", TetFormat::Npz, ".npz", "_newton.py",
       "python {scene} --view"},
      {"paraview", "ParaView", "VTK XML (.vtu) with regions and pins, metres", TetFormat::Vtu, ".vtu", "",
       "open it with: paraview {mesh}"},
      {"sofa", "SOFA", "Gmsh MSH 2.2 ASCII (.msh), positive, metres, tets only", TetFormat::Msh22, ".msh", "_sofa.py",
       "runSofa -l SofaPython3 {scene}"},
      {"tetgen", "TetGen", "TetGen's .node, .ele and .face, 0-based, positive, metres, an attribute per region",
       TetFormat::Tetgen, ".node", "", "refine it with: tetgen -rq {mesh}"},
      {"threejs", "Three.js", "JSON of flat arrays (.json), 0-based, positive, metres", TetFormat::Json, ".json", "",
       "const body = await (await fetch(\"{mesh}\")).json()"},
      {"unity-json", "Unity", "JSON of flat arrays (.json), 0-based, positive, metres, right-handed as all else",
       TetFormat::Json, ".json", "",
       "JsonUtility.FromJson<TetBody>(text of {mesh}), a class of float[] vertices; int[] tets, edges, surface"},
      {"usd", "OpenUSD", "USD (.usda): TetMesh, render mesh and embedding, metres", TetFormat::Usd, ".usda", "",
       "open it with: usdview {mesh}"},
      {"vega", "Vega FEM", "Vega volumetric mesh (.veg), 1-based, positive, metres, pins in .bou", TetFormat::Vega,
       ".veg", "", "load it with VolumetricMeshLoader::load(\"{mesh}\")"},
  };
}

const std::map<std::string_view, std::string_view>& engine_aliases() {
  static const std::map<std::string_view, std::string_view> aliases{
      {"ccx", "calculix"},     {"ftetwild", "mmg"},     {"isaaclab", "isaac"}, {"isaacsim", "isaac"},
      {"ngsolve", "netgen"},   {"omniverse", "isaac"},  {"physx", "isaac"},    {"pybullet", "bullet"},
      {"three.js", "threejs"}, {"unity", "unity-json"},
  };
  return aliases;
}

}  // namespace tetsoup
