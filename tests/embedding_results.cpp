// Prints how exactly embedded surfaces follow a known affine map and a known bend; scripts/embedding_results puts it
// into docs/EMBEDDING.md.
//
//   embedding_results MODEL ...      a file, or the name of a sample
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <functional>

#include "base/vec.h"
#include "tetsoup/io.h"
#include "tetsoup/samples.h"
#include "tetsoup/tetsoup.h"

namespace tetsoup::test {
namespace {

Vec3d affine(const Vec3d& p) {
  return {1.1 * p.x + 0.3 * p.y - 0.2 * p.z + 2, 0.9 * p.y + 0.4 * p.z - 1, -0.5 * p.x + 1.2 * p.z + 0.5};
}

/// In units of the model's diagonal: the longest axis is bent along a circle whose radius is the diagonal.
Vec3d bend(Vec3d p, std::size_t axis) {
  const auto turn = [&] {
    if (axis == 1) p = {p.y, p.z, p.x};
    if (axis == 2) p = {p.z, p.x, p.y};
  };
  turn();
  return {(1 + p.z) * std::sin(p.x), p.y, (1 + p.z) * std::cos(p.x) - 1};
}

using Map = std::function<Vec3d(const Vec3d&)>;

/// Largest distance of the embedded points from where the map takes them.
double error_under(const Map& map, const Embedding& embedding, const TetMesh& mesh, const std::vector<Vec3>& points) {
  std::vector<Vec3> positions;
  for (const Vec3& v : mesh.vertices) positions.push_back(to_float(map(to_double(v))));
  const std::vector<Vec3> moved = deform_points(embedding, mesh.tets, positions);
  double largest = 0;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (is_finite(points[i])) largest = std::max(largest, length(to_double(moved[i]) - map(to_double(points[i]))));
  return largest;
}

/// The model in units of its diagonal, its centre at the origin, and its longest axis.
std::size_t normalise(TriangleSoup& soup) {
  const SoupReport report = clean_soup(soup).report;
  const Vec3d size = report.box.hi - report.box.lo, centre = (report.box.lo + report.box.hi) * 0.5;
  for (Vec3& v : soup.vertices) v = to_float((to_double(v) - centre) * (1 / length(size)));
  return size.x >= std::max(size.y, size.z) ? 0 : size.y >= size.z ? 1 : 2;
}

void print_rows(const std::string& model) {
  TriangleSoup soup = std::filesystem::exists(model) ? read_soup(model) : make_sample(model);
  const std::size_t axis = normalise(soup);
  const std::string name = std::filesystem::path(model).filename().string();
  Pipeline pipeline(soup);
  for (const std::size_t tets : {500U, 2000U}) {
    for (const Cover cover : {Cover::Density, Cover::Enclose}) {
      MeshOptions options;
      options.lattice.tets = tets;
      options.lattice.cover = cover;
      const TetMesh& mesh = pipeline.run(options).mesh;
      const Embedding e = embed_points(mesh, soup);
      std::printf("| %s | %zu | %s | %zu of %zu | %.2f | %zu | %zu | %.1e | %.4f |\n", name.c_str(), mesh.tets.size(),
                  cover == Cover::Enclose ? "enclosed" : "default", e.report.outside, soup.vertices.size(),
                  e.report.max_distance / pipeline.lattice().report.mean_edge, e.report.drawn_closer,
                  e.report.other_copy, error_under(affine, e, mesh, soup.vertices),
                  error_under([&](const Vec3d& p) { return bend(p, axis); }, e, mesh, soup.vertices));
    }
  }
}

}  // namespace
}  // namespace tetsoup::test

int main(int argc, char** argv) {
  for (int i = 1; i < argc; ++i) tetsoup::test::print_rows(argv[i]);
}
