// PNG by libpng.
#pragma once

#include <cstddef>
#include <vector>

#include "io/pictures/raster.h"

namespace tetsoup {

/// @throws IoError  if libpng refuses, which only a lack of memory can cause.
std::vector<std::byte> encode_png(const Image& image);

}  // namespace tetsoup
