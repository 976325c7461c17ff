// Which of the instruction sets of this machine the kernels use: the best, unless a test wants another.
#pragma once

#include <functional>
#include <string>

namespace tetsoup {

/// Calls body(name) once for every instruction set that was compiled in and this machine has, while all kernels use it.
void for_each_simd_target(const std::function<void(const std::string&)>& body);

}  // namespace tetsoup
