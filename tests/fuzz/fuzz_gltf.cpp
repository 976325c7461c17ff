// glTF with a buffer beside it, "b.bin": the text up to 0x00 0xff, then the buffer. A soup or IoError.
#include <fstream>

#include "fuzz.h"
#include "io/soup_readers.h"
#include "tetsoup/error.h"

namespace tetsoup::fuzz {

void fuzz_one(Bytes bytes) {
  const auto [text, buffer] = Choices(bytes).halves();
  std::ofstream(own_folder() / "b.bin", std::ios::binary)
      .write(reinterpret_cast<const char*>(buffer.data()), static_cast<std::streamsize>(buffer.size()));
  try {
    readers::SoupSink sink;
    readers::read_gltf({std::as_bytes(text), "fuzz"}, own_folder(), sink);
    sink.take();
  } catch (const IoError&) {
  }
}

}  // namespace tetsoup::fuzz
