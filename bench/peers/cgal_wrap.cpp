// Alpha wrap: cgal_wrap IN.ply OUT.off PARTS makes a closed surface that keeps out what is wider than the diagonal /
// PARTS.
#include <cmath>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/IO/polygon_soup_io.h>
#include <CGAL/Polygon_mesh_processing/bbox.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/alpha_wrap_3.h>

#include "peer_common.h"

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;

int main(int argc, char** argv) {
  if (argc != 4) return 2;
  const peers::Stopwatch clock;
  std::vector<Kernel::Point_3> points;
  std::vector<std::vector<std::size_t>> faces;
  if (!CGAL::IO::read_polygon_soup(argv[1], points, faces)) return 3;
  CGAL::Bbox_3 box;
  for (const auto& p : points) box += p.bbox();
  const double diagonal = std::sqrt(std::pow(box.x_span(), 2) + std::pow(box.y_span(), 2) + std::pow(box.z_span(), 2));
  const double alpha = diagonal / std::atof(argv[3]);
  Mesh wrap;
  CGAL::alpha_wrap_3(points, faces, alpha, alpha / 30, wrap);
  CGAL::IO::write_polygon_mesh(argv[2], wrap, CGAL::parameters::stream_precision(17));
  std::printf("{\"seconds\": %.6f, \"triangles\": %zu}\n", clock.seconds(),
              static_cast<std::size_t>(wrap.number_of_faces()));
}
