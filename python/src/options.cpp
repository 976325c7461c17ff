#include "options.h"

#include "keywords.h"

namespace tetsoup::python {

namespace {

using MeshKeyword = Keyword<MeshOptions>;

struct Option {
  std::string_view stage;
  MeshKeyword keyword;
};

template <auto... Path>
Option option(std::string_view stage, const char* name) {
  return {stage, keyword<MeshOptions, Path...>(name)};
}

/// One line an option. Its type and what it means stand in python/tetsoup/options.py.
const std::vector<Option>& all_options() {
  constexpr auto kDistance = &MeshOptions::distance;
  constexpr auto kVolume = &MeshOptions::pseudo_volume;
  constexpr auto kLattice = &MeshOptions::lattice;
  constexpr auto kTopology = &LatticeOptions::topology;
  constexpr auto kSmooth = &MeshOptions::smooth;
  static const std::vector<Option> options{
      option<kDistance, &DistanceOptions::voxels>("distance", "voxels"),
      option<kDistance, &DistanceOptions::voxel_size>("distance", "voxel_size"),
      option<kDistance, &DistanceOptions::box>("distance", "box"),
      option<kDistance, &DistanceOptions::band_voxels>("distance", "distance_band_voxels"),
      option<kDistance, &DistanceOptions::mode>("distance", "distance_mode"),
      option<kVolume, &PseudoVolumeOptions::k>("pseudo_volume", "k"),
      option<kVolume, &PseudoVolumeOptions::band_voxels>("pseudo_volume", "band_voxels"),
      option<kVolume, &PseudoVolumeOptions::band>("pseudo_volume", "band"),
      option<kVolume, &PseudoVolumeOptions::rays>("pseudo_volume", "rays"),
      option<kVolume, &PseudoVolumeOptions::placement>("pseudo_volume", "placement"),
      option<kVolume, &PseudoVolumeOptions::cavities>("pseudo_volume", "cavities"),
      option<kVolume, &PseudoVolumeOptions::thickness>("pseudo_volume", "thickness"),
      option<kLattice, &LatticeOptions::tets>("lattice", "tets"),
      option<kLattice, &LatticeOptions::vertices>("lattice", "mesh_vertices"),
      option<kLattice, &LatticeOptions::edge>("lattice", "edge"),
      option<kLattice, &LatticeOptions::cells>("lattice", "cells"),
      option<kLattice, &LatticeOptions::cell_size>("lattice", "cell_size"),
      option<kLattice, &LatticeOptions::kind>("lattice", "lattice"),
      option<kLattice, &LatticeOptions::translate_cells>("lattice", "translate_cells"),
      option<kLattice, &LatticeOptions::rotate>("lattice", "rotate"),
      option<kLattice, &LatticeOptions::fit>("lattice", "fit"),
      option<kLattice, &LatticeOptions::rho_min>("lattice", "rho_min"),
      option<kLattice, &LatticeOptions::thin>("lattice", "thin"),
      option<kLattice, &LatticeOptions::cover>("lattice", "cover"),
      option<kLattice, &LatticeOptions::separate>("lattice", "separate"),
      option<kLattice, &LatticeOptions::stairs>("lattice", "stairs"),
      option<kLattice, kTopology, &TopologyOptions::touching>("lattice", "touching"),
      option<kLattice, kTopology, &TopologyOptions::min_part>("lattice", "min_part"),
      option<kLattice, kTopology, &TopologyOptions::bubbles>("lattice", "bubbles"),
      option<kLattice, kTopology, &TopologyOptions::boundary_only>("lattice", "boundary_only"),
      option<kSmooth, &SmoothOptions::passes>("smooth", "passes"),
      option<kSmooth, &SmoothOptions::strength>("smooth", "strength"),
      option<kSmooth, &SmoothOptions::min_dihedral>("smooth", "min_dihedral"),
      option<kSmooth, &SmoothOptions::max_dihedral>("smooth", "max_dihedral"),
      option<kSmooth, &SmoothOptions::max_edge_ratio>("smooth", "max_edge_ratio"),
      option<kSmooth, &SmoothOptions::snap>("smooth", "snap"),
      option<&MeshOptions::join>("run", "join"),
      option<&MeshOptions::memory_limit>("run", "memory_limit"),
  };
  return options;
}

std::vector<MeshKeyword> keywords_of(std::string_view stage) {
  std::vector<MeshKeyword> keywords;
  for (const Option& option : all_options())
    if (stage.empty() || option.stage == stage) keywords.push_back(option.keyword);
  return keywords;
}

const std::vector<Keyword<SimulationOptions>>& simulation_keywords() {
  using S = SimulationOptions;
  static const std::vector<Keyword<S>> keywords{
      keyword<S, &S::solver>("solver"),
      keyword<S, &S::gravity>("gravity"),
      keyword<S, &S::substeps>("substeps"),
      keyword<S, &S::max_substeps>("max_substeps"),
      keyword<S, &S::contact_interval>("contact_interval"),
      keyword<S, &S::contacts>("contacts"),
      keyword<S, &S::potentials, &PotentialOptions::distance>("distance_stiffness"),
      keyword<S, &S::potentials, &PotentialOptions::area>("area_stiffness"),
      keyword<S, &S::potentials, &PotentialOptions::volume>("volume_stiffness"),
  };
  return keywords;
}

const std::vector<Keyword<SimMaterial>>& material_keywords() {
  using M = SimMaterial;
  static const std::vector<Keyword<M>> keywords{
      keyword<M, &M::elastic, &Material::density>("density"),
      keyword<M, &M::elastic, &Material::young>("young"),
      keyword<M, &M::elastic, &Material::poisson>("poisson"),
      keyword<M, &M::damping_time>("damping_time"),
      keyword<M, &M::friction>("friction"),
      keyword<M, &M::elastic, &Material::metres_per_unit>("metres_per_unit"),
  };
  return keywords;
}

const std::vector<Keyword<Pose>>& pose_keywords() {
  static const std::vector<Keyword<Pose>> keywords{
      keyword<Pose, &Pose::translate>("translate"), keyword<Pose, &Pose::rotate>("rotate"),
      keyword<Pose, &Pose::scale>("scale"),         keyword<Pose, &Pose::velocity>("velocity"),
      keyword<Pose, &Pose::spin>("spin"),
  };
  return keywords;
}

}  // namespace

MeshOptions read_options(nb::dict keywords, std::string_view stage) {
  return from_keywords(keywords_of(stage), keywords);
}

SimulationOptions read_simulation_options(nb::dict keywords) {
  return from_keywords(simulation_keywords(), keywords);
}

SimMaterial read_material(nb::dict keywords) {
  return from_keywords(material_keywords(), keywords);
}

Pose read_pose(nb::dict keywords) {
  return from_keywords(pose_keywords(), keywords);
}

nb::typed<nb::dict, nb::str, nb::any> describe_options(const MeshOptions& options, std::string_view stage) {
  return to_keywords(keywords_of(stage), options);
}

nb::typed<nb::dict, nb::str, nb::any> default_options(std::string_view group) {
  if (group == "simulation") return to_keywords(simulation_keywords(), {});
  if (group == "material") return to_keywords(material_keywords(), {});
  if (group == "pose") return to_keywords(pose_keywords(), {});
  return describe_options({}, group);
}

}  // namespace tetsoup::python
