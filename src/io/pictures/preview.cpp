// The page of a preview: title, up to four panels, a caption under each.
#include <cmath>
#include <functional>
#include <memory>

#include "base/require.h"
#include "io/pictures/png_writer.h"
#include "io/pictures/preview_panels.h"
#include "io/pictures/text.h"
#include "tetsoup/io.h"

namespace tetsoup {

namespace {

/// All sizes of the page, in pixels; they are stated for a page 1600 pixels wide.
struct Layout {
  int width, columns;
  double unit = width / 1600.0;
  int margin = scaled_size(44), gap = scaled_size(30), title_height = scaled_size(76);
  int panel_height = scaled_size(600), caption_height = scaled_size(58);
  int panel_width = (width - 2 * margin - (columns - 1) * gap) / columns;

  int scaled_size(double pixels) const { return static_cast<int>(std::lround(pixels * unit)); }
};

struct Panel {
  std::function<void(Image&, const Rect&)> draw;
  std::string caption;
};

std::vector<Vec3d> drawable_points(const PreviewScene& scene) {
  std::vector<Vec3d> points;
  if (scene.soup != nullptr) {
    for (const Triangle& t : scene.soup->triangles)
      if (is_drawable(*scene.soup, t))
        for (const std::uint32_t i : t) points.push_back(to_double(scene.soup->vertices[i]));
  }
  for (const TetMesh* mesh : {scene.lattice, scene.mesh}) {
    if (mesh == nullptr) continue;
    for (const Tet& tet : mesh->tets)
      if (is_drawable(*mesh, tet))
        for (const std::uint32_t i : tet) points.push_back(to_double(mesh->vertices[i]));
  }
  if (points.empty()) points.push_back({});
  return points;
}

int up_axis_of(const PreviewScene& scene) {
  if (scene.up == UpAxis::Y) return 1;
  if (scene.up == UpAxis::Z || scene.soup == nullptr) return 2;
  return guess_up_axis(*scene.soup);
}

std::vector<Panel> panels_of(const PreviewScene& scene, const Layout& layout) {
  const int up_axis = up_axis_of(scene);
  const auto view =
      std::make_shared<PreviewView>(drawable_points(scene), up_axis, layout.panel_width, layout.panel_height);
  std::vector<Panel> panels;
  if (scene.soup != nullptr)
    panels.push_back({[=](Image& i, const Rect& r) { draw_soup_panel(i, r, *view, *scene.soup); }, scene.captions[0]});
  if (scene.volume != nullptr)
    panels.push_back(
        {[=](Image& i, const Rect& r) { draw_votes_panel(i, r, up_axis, *scene.volume); }, scene.captions[1]});
  if (scene.lattice != nullptr)
    panels.push_back(
        {[=](Image& i, const Rect& r) { draw_lattice_panel(i, r, *view, *scene.lattice); }, scene.captions[2]});
  if (scene.mesh != nullptr)
    panels.push_back({[=](Image& i, const Rect& r) { draw_mesh_panel(i, r, *view, *scene.mesh); }, scene.captions[3]});
  return panels;
}

void draw_panel(Image& page, const Rect& rect, const Panel& panel, double unit) {
  for (int y = 0; y < rect.height; ++y) {
    const float t = static_cast<float>(y) / static_cast<float>(rect.height);
    fill_rect(page, {rect.x, rect.y + y, rect.width, 1}, mix(palette::kPanelTop, palette::kPanelBottom, t));
  }
  panel.draw(page, rect);
  round_corners(page, rect, 12 * unit, palette::kRule, palette::kPage);
  draw_text(page, rect.x + 4 * unit, rect.y + rect.height + 34 * unit, panel.caption, {15 * unit, 0.125, palette::kInk},
            rect.width - 8 * unit);
}

}  // namespace

void write_preview(const std::filesystem::path& path, const PreviewScene& scene, int width) {
  require(width >= 320 && width <= 8192, "width", width, "in 320..8192");
  const int count =
      (scene.soup != nullptr) + (scene.volume != nullptr) + (scene.lattice != nullptr) + (scene.mesh != nullptr);
  const Layout layout{width, count < 2 ? 1 : 2};
  const int top = layout.margin + (scene.title.empty() ? 0 : layout.title_height);
  const int rows = (count + layout.columns - 1) / layout.columns;
  const int row_height = layout.panel_height + layout.caption_height;

  Image page(width, top + rows * row_height + layout.margin / 4, palette::kPage);
  draw_text(page, layout.margin + 2 * layout.unit, layout.margin + 30 * layout.unit, scene.title,
            {25 * layout.unit, 0.135, palette::kInk}, width - 2 * layout.margin);
  int index = 0;
  for (const Panel& panel : panels_of(scene, layout)) {
    const int column = index % layout.columns, row = index / layout.columns;
    draw_panel(page,
               {layout.margin + column * (layout.panel_width + layout.gap), top + row * row_height, layout.panel_width,
                layout.panel_height},
               panel, layout.unit);
    ++index;
  }
  write_file_atomic(path, encode_png(page));
}

}  // namespace tetsoup
