// The page of a preview: title, up to four panels, a caption under each.
#include <functional>
#include <memory>

#include "base/require.h"
#include "io/png_writer.h"
#include "io/preview_panels.h"
#include "io/text.h"
#include "tetsoup/io.h"

namespace tetsoup {

namespace {

constexpr int kMargin = 44, kGap = 30, kTitleHeight = 76, kPanelHeight = 600, kCaptionHeight = 58;
constexpr double kCornerRadius = 12;

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

std::vector<Panel> panels_of(const PreviewScene& scene, int width) {
  const int up_axis = scene.soup != nullptr ? guess_up_axis(*scene.soup) : 2;
  const auto view = std::make_shared<PreviewView>(drawable_points(scene), up_axis, width, kPanelHeight);
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

void draw_panel(Image& page, const Rect& rect, const Panel& panel) {
  for (int y = 0; y < rect.height; ++y) {
    const float t = static_cast<float>(y) / static_cast<float>(rect.height);
    fill_rect(page, {rect.x, rect.y + y, rect.width, 1}, mix(palette::kPanelTop, palette::kPanelBottom, t));
  }
  panel.draw(page, rect);
  round_corners(page, rect, kCornerRadius, palette::kRule, palette::kPage);
  draw_text(page, rect.x + 4, rect.y + rect.height + 34, panel.caption, {15, 0.125, palette::kInk}, rect.width - 8);
}

}  // namespace

void write_preview(const std::filesystem::path& path, const PreviewScene& scene, int width) {
  require(width >= 640 && width <= 8192, "width", width, "in 640..8192");
  const int title = scene.title.empty() ? 0 : kTitleHeight;
  const bool single =
      (scene.soup != nullptr) + (scene.volume != nullptr) + (scene.lattice != nullptr) + (scene.mesh != nullptr) < 2;
  const int columns = single ? 1 : 2;
  const int panel_width = (width - 2 * kMargin - (columns - 1) * kGap) / columns;
  const std::vector<Panel> panels = panels_of(scene, panel_width);
  const int rows = (static_cast<int>(panels.size()) + columns - 1) / columns;

  Image page(width, kMargin + title + rows * (kPanelHeight + kCaptionHeight) + kMargin / 4, palette::kPage);
  draw_text(page, kMargin + 2, kMargin + 30, scene.title, {25, 0.135, palette::kInk}, width - 2 * kMargin);
  for (int i = 0; i < static_cast<int>(panels.size()); ++i) {
    const Rect rect{kMargin + i % columns * (panel_width + kGap),
                    kMargin + title + i / columns * (kPanelHeight + kCaptionHeight), panel_width, kPanelHeight};
    draw_panel(page, rect, panels[static_cast<std::size_t>(i)]);
  }
  write_file_atomic(path, encode_png(page));
}

}  // namespace tetsoup
