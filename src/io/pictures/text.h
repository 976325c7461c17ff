// Text for pictures: a hand-made monoline face, drawn as strokes at any size.
#pragma once

#include <string_view>

#include "io/pictures/raster.h"

namespace tetsoup {

struct TextStyle {
  double size = 20;      ///< Height of a capital, in pixels.
  double weight = 0.13;  ///< Stroke width in heights of a capital.
  Rgb colour;
};

double text_width(std::string_view text, const TextStyle& style);

/// Draws one line of UTF-8 with its baseline at `y`; what the face lacks becomes a small box. Text wider than
/// `max_width` is cut and ends in dots.
void draw_text(Image& image, double x, double y, std::string_view text, const TextStyle& style, double max_width);

}  // namespace tetsoup
