#include <algorithm>
#include <cmath>

#include "base/origin.h"
#include "base/parallel.h"
#include "base/triangle_boxes.h"
#include "base/vec.h"
#include "kernel/triangle_distance.h"
#include "tetsoup/quality.h"

namespace tetsoup {

namespace {

constexpr int kParts = 3;  // A boundary triangle is asked at the centres of so many parts along each side.

/// Distance from the nearest triangle, where `near` is a triangle to begin with, which becomes the nearest.
double distance(const TriangleBoxes& boxes, const Vec3d& at, std::uint32_t& near) {
  const Vec3 p = to_float(boxes.to_unit(at));
  const auto square_of = [&](std::uint32_t triangle) {
    const auto [a, b, c] = boxes.corners_in_unit(triangle);
    return kernel::squared_distance(kernel::plan_triangle(to_float(a), to_float(b), to_float(c)), p.x, p.y, p.z);
  };
  float best = square_of(near);
  boxes.visit_near(p, best, [&](std::uint32_t triangle) {
    const float square = square_of(triangle);
    if (square < best) best = square, near = triangle;
  });
  return std::sqrt(static_cast<double>(best)) / boxes.scale();
}

struct Sample {
  double distance, area;
};

/// The samples of one boundary triangle, one after the other so that each starts with the nearest of the last.
void ask(const TetMesh& mesh, const Triangle& triangle, const TriangleBoxes& boxes, std::vector<Sample>& samples) {
  const Vec3d a = to_double(mesh.vertices[triangle[0]]), b = to_double(mesh.vertices[triangle[1]]),
              c = to_double(mesh.vertices[triangle[2]]);
  const double area = length(cross(b - a, c - a)) / 2;
  std::uint32_t near = boxes.any();
  for (int i = 0; i < kParts; ++i) {
    for (int j = 0; i + j < kParts; ++j) {
      const double u = (i + 1.0 / 3) / kParts, v = (j + 1.0 / 3) / kParts;
      samples.push_back({distance(boxes, a * (1 - u - v) + b * u + c * v, near), area});
    }
  }
}

}  // namespace

BoundaryDistance boundary_distance(const TetMesh& mesh, const TriangleSoup& soup, double unit) {
  const Progress nobody;
  StageWatch watch(nobody, "quality");
  const std::vector<Triangle> boundary = boundary_triangles(mesh);
  const bool is_near = soup.origin == mesh.origin;
  const TriangleSoup near =
      is_near ? TriangleSoup{}
              : TriangleSoup{recounted(soup.vertices, soup.origin, mesh.origin), soup.triangles, mesh.origin};
  const TriangleBoxes boxes(is_near ? soup : near, watch);
  if (boundary.empty() || boxes.empty()) return {};
  constexpr std::int64_t kGrain = 64;
  std::vector<std::vector<Sample>> chunks(
      static_cast<std::size_t>(chunk_count(static_cast<std::int64_t>(boundary.size()), kGrain)));
  parallel_for(static_cast<std::int64_t>(boundary.size()), kGrain, watch, [&](std::int64_t begin, std::int64_t end) {
    auto& samples = chunks[static_cast<std::size_t>(begin / kGrain)];
    for (std::int64_t t = begin; t < end; ++t) ask(mesh, boundary[static_cast<std::size_t>(t)], boxes, samples);
  });
  std::vector<Sample> samples;
  for (const auto& chunk : chunks) samples.insert(samples.end(), chunk.begin(), chunk.end());
  std::sort(samples.begin(), samples.end(), [](const Sample& a, const Sample& b) {
    return a.distance != b.distance ? a.distance < b.distance : a.area < b.area;
  });
  double area = 0, sum = 0;
  for (const Sample& s : samples) area += s.area, sum += s.area * s.distance;
  if (!(area > 0)) return {};
  BoundaryDistance result{sum / area / unit, 0};
  double within = 0;
  for (const Sample& s : samples) {
    within += s.area;
    result.percentile95 = s.distance / unit;
    if (within >= 0.95 * area) break;
  }
  return result;
}

}  // namespace tetsoup
