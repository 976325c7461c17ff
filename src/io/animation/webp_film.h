// Pictures one after another as one animated WebP, by libwebp.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "io/pictures/raster.h"

struct WebPAnimEncoder;

namespace tetsoup::animation {

class WebpFilm {
 public:
  WebpFilm(int width, int height, double fps);

  /// Encodes the picture at once; only what changed since the last one is kept.
  /// @throws IoError  if libwebp refuses, which only a lack of memory can cause.
  void add(const Image& image);
  /// The file's bytes. Nothing can be added then.
  std::string finish();

 private:
  struct Free {
    void operator()(WebPAnimEncoder* encoder) const;
  };
  int time_ms() const;  // Of the next picture.

  double fps_;
  std::int64_t count_ = 0;
  std::unique_ptr<WebPAnimEncoder, Free> encoder_;
};

}  // namespace tetsoup::animation
