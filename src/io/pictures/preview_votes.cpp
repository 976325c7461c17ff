// The panel that shows one slice of the votes.
#include <algorithm>
#include <cmath>
#include <string>

#include "io/pictures/preview_panels.h"
#include "io/pictures/text.h"

namespace tetsoup {

namespace {

using Cell = std::array<int, 3>;

/// One layer of voxels, seen from outside with the object's up axis pointing up.
struct Slice {
  std::size_t axis = 2;
  int level = 0;
  std::size_t across = 0, upward = 1;  ///< Grid axes on the picture.
  bool mirrored = false;               ///< `across` runs to the left.
  bool upside_down = false;            ///< `upward` runs down.
};

/// Inside voxels of every layer along an axis.
std::vector<std::size_t> layer_counts(const BitGrid& inside, std::size_t axis) {
  std::vector<std::size_t> counts(static_cast<std::size_t>(inside.frame.size[axis]));
  for (int z = 0; z < inside.frame.size[2]; ++z)
    for (int y = 0; y < inside.frame.size[1]; ++y)
      for (int x = 0; x < inside.frame.size[0]; ++x)
        if (inside.test(x, y, z)) ++counts[static_cast<std::size_t>(Cell{x, y, z}[axis])];
  return counts;
}

/// The layer that halves the inside voxels; the middle one if there are none.
int middle_layer(const std::vector<std::size_t>& counts) {
  std::size_t total = 0, below = 0;
  for (const std::size_t count : counts) total += count;
  if (total == 0) return static_cast<int>(counts.size() / 2);
  for (std::size_t i = 0; i < counts.size(); ++i) {
    below += counts[i];
    if (2 * below >= total) return static_cast<int>(i);
  }
  return 0;
}

/// Of the three middle layers the one that cuts the most; it shows the most.
Slice choose_slice(const BitGrid& inside, int up_axis) {
  Slice best;
  std::size_t most = 0;
  for (const std::size_t axis : {std::size_t{1}, std::size_t{2}, std::size_t{0}}) {
    const std::vector<std::size_t> counts = layer_counts(inside, axis);
    const int level = middle_layer(counts);
    const std::size_t count = counts[static_cast<std::size_t>(level)];
    if (axis != 1 && count <= most) continue;
    most = count;
    best.axis = axis;
    best.level = level;
  }
  const auto up = static_cast<std::size_t>(up_axis);
  const std::size_t depth = 3 - up;  // z up: y; y up: z.
  best.upward = best.axis == up ? depth : up;
  best.across = 3 - best.axis - best.upward;
  // As the other panels are seen: the front is -y with z up and +z with y up, the side is +x.
  best.mirrored = best.axis == 0 && up == 1;
  best.upside_down = best.axis == 1 && up == 1;
  return best;
}

class VotesPicture {
 public:
  VotesPicture(Image& image, const Rect& panel, const PseudoVolume& volume, const Slice& slice)
      : image_(image), volume_(volume), slice_(slice) {
    const auto& size = volume.votes.frame.size;
    columns_ = size[slice.across];
    rows_ = size[slice.upward];
    constexpr double kMargin = 0.07;  // Of the panel, on each side.
    constexpr double kLegend = 60;    // Design pixels on the right.
    const double room_x = panel.width * (1 - 2 * kMargin) - kLegend * design_unit(panel),
                 room_y = panel.height * (1 - 2 * kMargin);
    pixel_ = std::min(room_x / columns_, room_y / rows_);
    left_ = panel.x + (panel.width - kLegend * design_unit(panel) - pixel_ * columns_) / 2;
    top_ = panel.y + (panel.height - pixel_ * rows_) / 2;
  }

  void draw_cells();
  void draw_boundary();

 private:
  Cell cell(int column, int row) const {
    Cell c{};
    c[slice_.axis] = slice_.level;
    c[slice_.across] = slice_.mirrored ? columns_ - 1 - column : column;
    c[slice_.upward] = slice_.upside_down ? row : rows_ - 1 - row;
    return c;
  }
  bool inside(int column, int row) const {
    if (column < 0 || row < 0 || column >= columns_ || row >= rows_) return false;
    const Cell c = cell(column, row);
    return volume_.inside.test(c[0], c[1], c[2]);
  }

  Image& image_;
  const PseudoVolume& volume_;
  Slice slice_;
  int columns_ = 0, rows_ = 0;
  double pixel_ = 1, left_ = 0, top_ = 0;
};

/// Opacity of the inside's colour: no vote leaves the panel as it is.
float vote_opacity(double share) {
  return static_cast<float>(std::pow(std::clamp(share, 0.0, 1.0), 1.2));
}

void VotesPicture::draw_cells() {
  // Samples per pixel and axis: where voxels are smaller than pixels, pixels show their mean.
  constexpr int kSamples = 3;
  const int right = static_cast<int>(std::ceil(left_ + pixel_ * columns_));
  const int bottom = static_cast<int>(std::ceil(top_ + pixel_ * rows_));
  for (int y = static_cast<int>(top_); y < bottom; ++y) {
    for (int x = static_cast<int>(left_); x < right; ++x) {
      double votes = 0;
      for (int s = 0; s < kSamples * kSamples; ++s) {
        const double px = x + (s % kSamples + 0.5) / kSamples, py = y + (s / kSamples + 0.5) / kSamples;
        const auto column = static_cast<int>(std::floor((px - left_) / pixel_));
        const auto row = static_cast<int>(std::floor((py - top_) / pixel_));
        if (column < 0 || row < 0 || column >= columns_ || row >= rows_) continue;
        const Cell c = cell(column, row);
        votes += volume_.votes.at(c[0], c[1], c[2]);
      }
      image_.blend(x, y, palette::kInside, vote_opacity(votes / (kSamples * kSamples) / std::max(1, volume_.rays)));
    }
  }
}

void VotesPicture::draw_boundary() {
  std::vector<std::array<Point, 2>> lines;
  const auto corner = [&](int column, int row) { return Point{left_ + pixel_ * column, top_ + pixel_ * row}; };
  for (int row = 0; row <= rows_; ++row) {
    for (int column = 0; column <= columns_; ++column) {
      const bool here = inside(column, row);
      if (here != inside(column, row - 1)) lines.push_back({corner(column, row), corner(column + 1, row)});
      if (here != inside(column - 1, row)) lines.push_back({corner(column, row), corner(column, row + 1)});
    }
  }
  draw_strokes(image_, lines, std::clamp(pixel_ / 2.5, 1.0, 2.4), palette::kBoundary);
}

/// Votes from 0 to all rays, with the majority marked.
void draw_legend(Image& image, const Rect& panel, int rays) {
  const double unit = design_unit(panel);
  const int width = static_cast<int>(14 * unit), height = panel.height * 2 / 5;
  const int x0 = panel.x + panel.width - static_cast<int>(70 * unit), y0 = panel.y + (panel.height - height) / 2;
  for (int y = 0; y < height; ++y) {
    const float opacity = vote_opacity(1 - static_cast<double>(y) / (height - 1));
    fill_rect(image, {x0, y0 + y, width, 1}, mix(palette::kPanelTop, palette::kInside, opacity));
  }
  const Point a{x0 - 0.5, y0 - 0.5}, b{x0 + width + 0.5, y0 - 0.5}, c{b.x, y0 + height + 0.5}, d{a.x, c.y};
  draw_strokes(image, {{a, b}, {b, c}, {c, d}, {d, a}}, 1, palette::kRule);
  const double middle = y0 + height / 2.0;
  draw_strokes(image, {{Point{a.x - 3 * unit, middle}, Point{b.x + 3 * unit, middle}}}, 2.2 * unit, palette::kBoundary);
  const TextStyle style{12 * unit, 0.125, palette::kFaint};
  const double numbers = b.x + 9 * unit;
  draw_text(image, numbers, y0 + 12 * unit, std::to_string(rays), style, 60 * unit);
  draw_text(image, numbers, middle + 6 * unit, std::to_string(rays / 2), style, 60 * unit);
  draw_text(image, numbers, y0 + height, "0", style, 60 * unit);
  draw_text(image, x0 - 8 * unit, y0 - 18 * unit, "votes", style, 80 * unit);
}

}  // namespace

void draw_votes_panel(Image& image, const Rect& panel, int up_axis, const PseudoVolume& volume) {
  if (volume.votes.words.empty()) return;
  const Slice slice = choose_slice(volume.inside, up_axis);
  VotesPicture picture(image, panel, volume, slice);
  picture.draw_cells();
  picture.draw_boundary();
  draw_legend(image, panel, volume.rays);
  const std::string name = std::string("layer ") + std::to_string(slice.level + 1) + " of " +
                           std::to_string(volume.votes.frame.size[slice.axis]) + " across " + "xyz"[slice.axis];
  const double unit = design_unit(panel);
  draw_text(image, panel.x + 20 * unit, panel.y + panel.height - 18 * unit, name, {12 * unit, 0.125, palette::kFaint},
            panel.width - 40 * unit);
}

}  // namespace tetsoup
