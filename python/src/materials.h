// A material from keywords that may be missing.
#pragma once

#include <nanobind/stl/optional.h>

#include <optional>

#include "tetsoup/readiness.h"

namespace tetsoup::python {

/// What is missing is the library's default.
inline Material material_of(std::optional<double> density, std::optional<double> young, std::optional<double> poisson,
                            std::optional<double> metres_per_unit) {
  Material material;
  material.density = density.value_or(material.density);
  material.young = young.value_or(material.young);
  material.poisson = poisson.value_or(material.poisson);
  material.metres_per_unit = metres_per_unit.value_or(material.metres_per_unit);
  return material;
}

}  // namespace tetsoup::python
