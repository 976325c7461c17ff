// The parts of the module, in the order in which they are bound.
#pragma once

#include <nanobind/nanobind.h>

namespace tetsoup::python {

void bind_meshes(nanobind::module_& module);
void bind_stages(nanobind::module_& module);
void bind_pipeline(nanobind::module_& module);
void bind_surfaces(nanobind::module_& module);
void bind_calibration(nanobind::module_& module);
void bind_models(nanobind::module_& module);
void bind_simulation(nanobind::module_& module);
void bind_files(nanobind::module_& module);

}  // namespace tetsoup::python
