// What stands in the panels of a preview.
#pragma once

#include "io/pictures/preview_view.h"
#include "tetsoup/pseudo_volume.h"

namespace tetsoup {

namespace palette {
inline constexpr Rgb kInk = rgb(0x1f2a37), kFaint = rgb(0x66727f), kRule = rgb(0xd5dbe2);
inline constexpr Rgb kPage = rgb(0xf3f5f8), kPanelTop = rgb(0xffffff), kPanelBottom = rgb(0xe9edf2);
inline constexpr Rgb kSoup = rgb(0xe3c9a4), kMesh = rgb(0x6fa3d8), kCut = rgb(0xf4b65c);
inline constexpr Rgb kInside = rgb(0x2c6cb0), kBoundary = rgb(0xe2582b);
}  // namespace palette

/// Size of a pixel of the design, whose panels are 600 pixels high.
inline double design_unit(const Rect& panel) {
  return panel.height / 600.0;
}

void draw_soup_panel(Image& image, const Rect& panel, const PreviewView& view, const TriangleSoup& soup);
void draw_lattice_panel(Image& image, const Rect& panel, const PreviewView& view, const TetMesh& mesh);
void draw_mesh_panel(Image& image, const Rect& panel, const PreviewView& view, const TetMesh& mesh);
void draw_votes_panel(Image& image, const Rect& panel, int up_axis, const PseudoVolume& volume);

}  // namespace tetsoup
