#include "io/animation/webp_film.h"

#include <webp/encode.h>
#include <webp/mux.h>

#include <cmath>
#include <vector>

#include "tetsoup/error.h"

namespace tetsoup::animation {
namespace {

constexpr float kQuality = 95;  // Of 100: with less, what was somewhere before shows through faintly.
constexpr int kMethod = 3;      // Of 6: twice as fast as 4 for files a few percent larger.

struct Picture {
  WebPPicture data{};
  Picture() {
    if (WebPPictureInit(&data) == 0) throw IoError("webp: the library is of another version than its header");
  }
  Picture(const Picture&) = delete;
  Picture& operator=(const Picture&) = delete;
  ~Picture() { WebPPictureFree(&data); }
};

}  // namespace

void WebpFilm::Free::operator()(WebPAnimEncoder* encoder) const {
  WebPAnimEncoderDelete(encoder);
}

WebpFilm::WebpFilm(int width, int height, double fps) : fps_(fps) {
  WebPAnimEncoderOptions options;
  if (WebPAnimEncoderOptionsInit(&options) == 0)
    throw IoError("webp: the library is of another version than its header");
  encoder_.reset(WebPAnimEncoderNew(width, height, &options));
  if (!encoder_) throw IoError("webp: out of memory");
}

int WebpFilm::time_ms() const {
  return static_cast<int>(std::lround(static_cast<double>(count_) * 1000 / fps_));
}

void WebpFilm::add(const Image& image) {
  const std::vector<std::uint8_t> pixels = rgb_bytes(image);
  Picture picture;
  picture.data.use_argb = 1;
  picture.data.width = image.width;
  picture.data.height = image.height;
  WebPConfig config;
  if (WebPConfigInit(&config) == 0 || WebPPictureImportRGB(&picture.data, pixels.data(), 3 * image.width) == 0)
    throw IoError("webp: out of memory");
  config.quality = kQuality;
  config.method = kMethod;
  config.thread_level = 1;
  if (WebPAnimEncoderAdd(encoder_.get(), &picture.data, time_ms(), &config) == 0)
    throw IoError(std::string("webp: ") + WebPAnimEncoderGetError(encoder_.get()));
  ++count_;
}

std::string WebpFilm::finish() {
  WebPData data;
  WebPDataInit(&data);
  // The last picture is shown as long as the others.
  if (WebPAnimEncoderAdd(encoder_.get(), nullptr, time_ms(), nullptr) == 0 ||
      WebPAnimEncoderAssemble(encoder_.get(), &data) == 0)
    throw IoError(std::string("webp: ") + WebPAnimEncoderGetError(encoder_.get()));
  std::string bytes(reinterpret_cast<const char*>(data.bytes), data.size);
  WebPDataClear(&data);
  encoder_.reset();
  return bytes;
}

}  // namespace tetsoup::animation
