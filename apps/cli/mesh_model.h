// From a run to all that a file may say about its mesh.
#pragma once

#include <optional>

#include "mesh_run.h"
#include "tetsoup/tet_model.h"

namespace tetsoup::cli {

struct ModelOptions {
  std::optional<UpAxis> up;  ///< Else by the input's format: y for OBJ and glTF, z for all others.
};

TetModel make_model(const MeshRun& run, const ModelOptions& options);

}  // namespace tetsoup::cli
