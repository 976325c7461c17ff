// Exact distance with Embree's point query: embree_distance SOUP.bin nx ny nz ox oy oz h. Along a row the search radius
// starts at the neighbour's distance plus one voxel, which is what makes Embree fast here.
#include <algorithm>
#include <cmath>
#include <limits>

#include <embree3/rtcore.h>

#include "peer_common.h"

namespace {

struct Vec {
  float x, y, z;
};
Vec operator-(Vec a, Vec b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
Vec operator+(Vec a, Vec b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
Vec operator*(float s, Vec a) {
  return {s * a.x, s * a.y, s * a.z};
}
float dot(Vec a, Vec b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

// Ericson, Real-Time Collision Detection, 5.1.5.
Vec closest_point(Vec p, Vec a, Vec b, Vec c) {
  const Vec ab = b - a, ac = c - a, ap = p - a;
  const float d1 = dot(ab, ap), d2 = dot(ac, ap);
  if (d1 <= 0 && d2 <= 0) return a;
  const Vec bp = p - b;
  const float d3 = dot(ab, bp), d4 = dot(ac, bp);
  if (d3 >= 0 && d4 <= d3) return b;
  const float vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return a + (d1 / (d1 - d3)) * ab;
  const Vec cp = p - c;
  const float d5 = dot(ab, cp), d6 = dot(ac, cp);
  if (d6 >= 0 && d5 <= d6) return c;
  const float vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return a + (d2 / (d2 - d6)) * ac;
  const float va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) return b + ((d4 - d3) / ((d4 - d3) + (d5 - d6))) * (c - b);
  const float scale = 1 / (va + vb + vc);
  return a + (vb * scale) * ab + (vc * scale) * ac;
}

struct Query {
  const peers::Soup* soup;
  float distance;
};

bool visit(RTCPointQueryFunctionArguments* arguments) {
  auto* query = static_cast<Query*>(arguments->userPtr);
  const auto& triangle = query->soup->triangles[arguments->primID];
  const auto corner = [&](int i) {
    const auto& v = query->soup->vertices[triangle[static_cast<std::size_t>(i)]];
    return Vec{v[0], v[1], v[2]};
  };
  const Vec p{arguments->query->x, arguments->query->y, arguments->query->z};
  const Vec to = closest_point(p, corner(0), corner(1), corner(2)) - p;
  const float distance = std::sqrt(dot(to, to));
  query->distance = std::min(query->distance, distance);
  if (distance >= arguments->query->radius) return false;
  arguments->query->radius = distance;
  return true;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 9) return 2;
  const peers::Soup soup = peers::read_raw_soup(argv[1]);
  const peers::Grid grid = peers::grid_of(argv + 2);
  const peers::Stopwatch clock;
  RTCDevice device = rtcNewDevice(nullptr);
  RTCScene scene = rtcNewScene(device);
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  void* vertices =
      rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 12, soup.vertices.size());
  void* triangles =
      rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 12, soup.triangles.size());
  std::copy_n(reinterpret_cast<const char*>(soup.vertices.data()), soup.vertices.size() * 12,
              static_cast<char*>(vertices));
  std::copy_n(reinterpret_cast<const char*>(soup.triangles.data()), soup.triangles.size() * 12,
              static_cast<char*>(triangles));
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene, geometry);
  rtcCommitScene(scene);

  std::vector<float> distance(static_cast<std::size_t>(grid.nx) * grid.ny * grid.nz);
  const float slack = static_cast<float>(grid.h) * 1.001F;
  peers::for_rows(grid, [&](int y, int z) {
    float* row = distance.data() + static_cast<std::size_t>(grid.nx) * (y + static_cast<std::size_t>(grid.ny) * z);
    float radius = std::numeric_limits<float>::infinity();
    for (int x = 0; x < grid.nx; ++x) {
      RTCPointQueryContext context;
      rtcInitPointQueryContext(&context);
      RTCPointQuery at{static_cast<float>(grid.ox + x * grid.h), static_cast<float>(grid.oy + y * grid.h),
                       static_cast<float>(grid.oz + z * grid.h), 0, radius};
      Query query{&soup, std::numeric_limits<float>::infinity()};
      rtcPointQuery(scene, &at, &context, visit, &query);
      row[x] = query.distance;
      radius = query.distance + slack;
    }
  });
  peers::report(clock.seconds(), peers::count_in_band(distance, grid.h));
}
