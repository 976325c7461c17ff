#include "io/png_writer.h"

#include <png.h>

#include <algorithm>

#include "tetsoup/error.h"

namespace tetsoup {

std::vector<std::byte> encode_png(const Image& image) {
  std::vector<png_byte> rows;
  rows.reserve(image.pixels.size() * 3);
  for (const Rgb& c : image.pixels)
    for (const float value : {c.r, c.g, c.b})
      rows.push_back(static_cast<png_byte>(std::clamp(value, 0.0F, 1.0F) * 255 + 0.5F));

  png_image header{};
  header.version = PNG_IMAGE_VERSION;
  header.width = static_cast<png_uint_32>(image.width);
  header.height = static_cast<png_uint_32>(image.height);
  header.format = PNG_FORMAT_RGB;
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(header);
  std::vector<std::byte> bytes(size);
  if (png_image_write_to_memory(&header, bytes.data(), &size, 0, rows.data(), 0, nullptr) == 0)
    throw IoError(std::string("png: ") + header.message);
  bytes.resize(size);
  return bytes;
}

}  // namespace tetsoup
