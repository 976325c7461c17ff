// Keywords of the Python functions and the members of the library's options that they set.
#pragma once

#include <nanobind/nanobind.h>

#include <string_view>

#include "tetsoup/pipeline.h"
#include "tetsoup/simulate.h"

namespace tetsoup::python {

namespace nb = nanobind;

/// Options from keywords. `stage` is "distance", "pseudo_volume", "lattice" or "smooth": that stage's alone; or "":
/// all.
/// @throws InvalidInput  for a value of the wrong type or an unknown word; nb::type_error for an unknown keyword.
MeshOptions read_options(nb::dict keywords, std::string_view stage = {});

/// The same for what a simulation takes; angles are radians.
SimulationOptions read_simulation_options(nb::dict keywords);
SimMaterial read_material(nb::dict keywords);
Pose read_pose(nb::dict keywords);

/// The value of every keyword of a stage, or of all.
nb::typed<nb::dict, nb::str, nb::any> describe_options(const MeshOptions& options, std::string_view stage = {});

/// The library's own values: of a stage, of all, or of "simulation", "material" or "pose".
nb::typed<nb::dict, nb::str, nb::any> default_options(std::string_view group);

}  // namespace tetsoup::python
