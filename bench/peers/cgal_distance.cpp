// Exact distance with CGAL's AABB tree: cgal_distance SOUP.bin nx ny nz ox oy oz h
#include <cmath>

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Simple_cartesian.h>

#include "peer_common.h"

using Kernel = CGAL::Simple_cartesian<double>;
using Triangles = std::vector<Kernel::Triangle_3>;
using Primitive = CGAL::AABB_triangle_primitive<Kernel, Triangles::const_iterator>;
using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>>;

int main(int argc, char** argv) {
  if (argc != 9) return 2;
  const peers::Soup soup = peers::read_raw_soup(argv[1]);
  const peers::Grid grid = peers::grid_of(argv + 2);
  const peers::Stopwatch clock;
  Triangles triangles;
  const auto point = [&](std::uint32_t i) {
    return Kernel::Point_3(soup.vertices[i][0], soup.vertices[i][1], soup.vertices[i][2]);
  };
  for (const auto& t : soup.triangles) {
    const Kernel::Triangle_3 triangle(point(t[0]), point(t[1]), point(t[2]));
    if (!triangle.is_degenerate()) triangles.push_back(triangle);
  }
  Tree tree(triangles.cbegin(), triangles.cend());
  tree.build();
  tree.accelerate_distance_queries();
  std::vector<float> distance(static_cast<std::size_t>(grid.nx) * grid.ny * grid.nz);
  peers::for_rows(grid, [&](int y, int z) {
    float* row = distance.data() + static_cast<std::size_t>(grid.nx) * (y + static_cast<std::size_t>(grid.ny) * z);
    for (int x = 0; x < grid.nx; ++x) {
      const Kernel::Point_3 p(grid.ox + x * grid.h, grid.oy + y * grid.h, grid.oz + z * grid.h);
      row[x] = static_cast<float>(std::sqrt(tree.squared_distance(p)));
    }
  });
  peers::report(clock.seconds(), peers::count_in_band(distance, grid.h));
}
