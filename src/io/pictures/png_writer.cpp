#include "io/pictures/png_writer.h"

#include <png.h>

#include "tetsoup/error.h"

namespace tetsoup {

std::vector<std::byte> encode_png(const Image& image) {
  const std::vector<std::uint8_t> rows = rgb_bytes(image);
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
