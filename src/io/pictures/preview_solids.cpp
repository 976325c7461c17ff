// The three panels that show triangles and tets.
#include <algorithm>
#include <cmath>

#include "base/tet_geometry.h"
#include "io/pictures/preview_panels.h"
#include "io/pictures/text.h"
#include "tetsoup/quality.h"

namespace tetsoup {

namespace {

/// Draws faces in one light over the soft shadow they leave on the floor.
class Stage {
 public:
  Stage(const PreviewView& view, const Rect& panel)
      : view_(view),
        panel_(panel),
        target_(panel.width, panel.height),
        shadow_(panel.width / kShadowPixels + 1, panel.height / kShadowPixels + 1) {}

  void add(const std::array<Vec3d, 3>& face, const Rgb& colour, const EdgeStyle& edge);
  void show(Image& image) const;

 private:
  static constexpr int kShadowPixels = 4;  // Per pixel of the shadow: it is blurred anyway.

  float shade(const std::array<Vec3d, 3>& face) const;
  void show_shadow(Image& image) const;

  const PreviewView& view_;
  Rect panel_;
  TriangleTarget target_, shadow_;
};

float Stage::shade(const std::array<Vec3d, 3>& face) const {
  // In the camera's frame: right, up, towards the eye.
  constexpr Vec3d kKey{-0.36, 0.58, 0.73}, kFill{0.80, 0.10, 0.59};
  // Scaled, so that neither huge nor tiny coordinates leave the range of a double.
  Vec3d a = face[1] - face[0], b = face[2] - face[0];
  const double longest = std::sqrt(std::max(squared_length(a), squared_length(b)));
  if (!(longest > 0)) return 1;
  const Vec3d normal = cross(a * (1 / longest), b * (1 / longest));
  const double size = length(normal);
  if (!(size > 0)) return 1;
  Vec3d n = Vec3d{dot(normal, view_.right()), dot(normal, view_.up()), dot(normal, view_.towards_eye())} * (1 / size);
  // Both sides of a triangle look alike: nobody knows which one is outside.
  if (n.z < 0) n = n * -1;
  return static_cast<float>(0.56 + 0.42 * std::max(0.0, dot(n, kKey)) + 0.20 * std::max(0.0, dot(n, kFill)));
}

void Stage::add(const std::array<Vec3d, 3>& face, const Rgb& colour, const EdgeStyle& edge) {
  std::array<ScreenPoint, 3> seen, dropped;
  for (std::size_t i = 0; i < 3; ++i) {
    seen[i] = view_.project(face[i]);
    dropped[i] = view_.project(view_.on_floor(face[i]));
    dropped[i].x /= kShadowPixels;
    dropped[i].y /= kShadowPixels;
  }
  target_.draw(seen, scaled(colour, shade(face)), edge);
  shadow_.draw(dropped, {}, {});
}

void Stage::show_shadow(Image& image) const {
  constexpr float kDarkness = 0.20F;
  constexpr int kBlur = 7, kBlurPasses = 3;  // Three box blurs look like one Gaussian.
  const int width = panel_.width / kShadowPixels + 1, height = panel_.height / kShadowPixels + 1;
  std::vector<float> soft = shadow_.coverage();
  blur(soft, width, height, kBlur, kBlurPasses);
  for (int y = 0; y < panel_.height; ++y) {
    for (int x = 0; x < panel_.width; ++x) {
      // Bilinear between the shadow's pixels.
      const float u = static_cast<float>(x) / kShadowPixels, v = static_cast<float>(y) / kShadowPixels;
      const int i = std::min(static_cast<int>(u), width - 2), j = std::min(static_cast<int>(v), height - 2);
      const auto at = [&](int a, int b) { return soft[static_cast<std::size_t>(b * width + a)]; };
      const float fu = u - static_cast<float>(i), fv = v - static_cast<float>(j);
      const float top = at(i, j) + (at(i + 1, j) - at(i, j)) * fu;
      const float bottom = at(i, j + 1) + (at(i + 1, j + 1) - at(i, j + 1)) * fu;
      image.blend(panel_.x + x, panel_.y + y, palette::kInk, kDarkness * (top + (bottom - top) * fv));
    }
  }
}

void Stage::show(Image& image) const {
  show_shadow(image);
  target_.resolve(image, panel_.x, panel_.y);
}

EdgeStyle edges_of(const Rgb& face, double typical_pixels, double width) {
  // Edges of faces a few pixels wide would hide the faces.
  const double alpha = std::clamp((typical_pixels - 3) / 14, 0.0, 1.0);
  return {mix(face, palette::kInk, 0.75F), width, static_cast<float>(0.85 * alpha)};
}

/// Median length of the faces' edges in pixels of the final picture.
double typical_edge(const PreviewView& view, const std::vector<Vec3>& vertices, const std::vector<Triangle>& faces) {
  std::vector<double> lengths;
  for (const Triangle& t : faces) {
    const ScreenPoint a = view.project(to_double(vertices[t[0]])), b = view.project(to_double(vertices[t[1]]));
    lengths.push_back(std::hypot(a.x - b.x, a.y - b.y) / TriangleTarget::kSupersampling);
  }
  if (lengths.empty()) return 0;
  const auto middle = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2);
  std::nth_element(lengths.begin(), middle, lengths.end());
  return *middle;
}

std::array<Vec3d, 3> corners_of(const std::vector<Vec3>& vertices, const Triangle& t) {
  return {to_double(vertices[t[0]]), to_double(vertices[t[1]]), to_double(vertices[t[2]])};
}

TetMesh drawable_part(const TetMesh& mesh) {
  TetMesh part{mesh.vertices, {}};
  for (const Tet& tet : mesh.tets)
    if (is_drawable(mesh, tet)) part.tets.push_back(tet);
  return part;
}

Triangle sorted(Triangle t) {
  std::sort(t.begin(), t.end());
  return t;
}

/// Without the tets in the quarter that looks at the viewer; all of them if nothing would be left.
TetMesh without_front_quarter(const TetMesh& mesh, const PreviewView& view) {
  TetMesh rest{mesh.vertices, {}};
  for (const Tet& tet : mesh.tets) {
    Vec3d middle;
    for (const std::uint32_t i : tet) middle += to_double(mesh.vertices[i]) * 0.25;
    const Vec3d q = middle - view.centre();
    if (!(dot(q, view.level_axes()[0]) > 0 && dot(q, view.level_axes()[1]) > 0)) rest.tets.push_back(tet);
  }
  return rest.tets.empty() ? mesh : rest;
}

/// What a colour means, `x` design pixels from the panel's left.
void draw_swatch(Image& image, const Rect& panel, double x, const Rgb& colour, std::string_view text) {
  const double unit = design_unit(panel);
  const double left = panel.x + x * unit, bottom = panel.y + panel.height - 18 * unit;
  const int side = static_cast<int>(14 * unit);
  fill_rect(image, {static_cast<int>(left), static_cast<int>(bottom) - side + 1, side, side}, scaled(colour, 0.95F));
  draw_text(image, left + 22 * unit, bottom, text, {12 * unit, 0.125, palette::kFaint}, 200 * unit);
}

}  // namespace

void draw_soup_panel(Image& image, const Rect& panel, const PreviewView& view, const TriangleSoup& soup) {
  Stage stage(view, panel);
  std::vector<Triangle> faces;
  for (const Triangle& t : soup.triangles)
    if (is_drawable(soup, t)) faces.push_back(t);
  const EdgeStyle edge = edges_of(palette::kSoup, typical_edge(view, soup.vertices, faces), 0.9 * design_unit(panel));
  for (const Triangle& t : faces) stage.add(corners_of(soup.vertices, t), palette::kSoup, edge);
  stage.show(image);
}

void draw_lattice_panel(Image& image, const Rect& panel, const PreviewView& view, const TetMesh& mesh) {
  const TetMesh whole = drawable_part(mesh);
  const TetMesh rest = without_front_quarter(whole, view);
  std::vector<Triangle> outer = boundary_triangles(whole);
  for (Triangle& t : outer) t = sorted(t);
  std::sort(outer.begin(), outer.end());

  Stage stage(view, panel);
  const std::vector<Triangle> faces = boundary_triangles(rest);
  const double typical = typical_edge(view, rest.vertices, faces);
  for (const Triangle& t : faces) {
    const bool is_outer = std::binary_search(outer.begin(), outer.end(), sorted(t));
    const Rgb colour = is_outer ? palette::kMesh : palette::kCut;
    stage.add(corners_of(rest.vertices, t), colour, edges_of(colour, typical, 1.3 * design_unit(panel)));
  }
  stage.show(image);
  draw_swatch(image, panel, 20, palette::kMesh, "surface");
  draw_swatch(image, panel, 125, palette::kCut, "cut open");
}

void draw_mesh_panel(Image& image, const Rect& panel, const PreviewView& view, const TetMesh& mesh) {
  const TetMesh whole = drawable_part(mesh);
  const std::vector<Triangle> faces = boundary_triangles(whole);
  Stage stage(view, panel);
  const EdgeStyle edge = edges_of(palette::kMesh, typical_edge(view, whole.vertices, faces), 1.3 * design_unit(panel));
  for (const Triangle& t : faces) stage.add(corners_of(whole.vertices, t), palette::kMesh, edge);
  stage.show(image);
}

}  // namespace tetsoup
