// How much memory a run may take without driving the machine into swap or the kernel into killing it.
#pragma once

#include <cstddef>
#include <optional>

namespace tetsoup::cli {

/// Bytes that are free now, for the machine and for the control group this process runs in, less a margin; nothing
/// where the system does not say.
std::optional<std::size_t> usable_memory();

}  // namespace tetsoup::cli
