// Mesh_3 inside a closed surface: cgal_mesh IN.off OUT.mesh PARTS, with facets and cells of the diagonal / PARTS.
#include <cmath>
#include <fstream>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/boost/graph/IO/polygon_mesh_io.h>
#include <CGAL/Mesh_complex_3_in_triangulation_3.h>
#include <CGAL/Mesh_criteria_3.h>
#include <CGAL/Mesh_triangulation_3.h>
#include <CGAL/Polygon_mesh_processing/bbox.h>
#include <CGAL/Polyhedral_mesh_domain_3.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/make_mesh_3.h>

#include "peer_common.h"

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Surface = CGAL::Surface_mesh<Kernel::Point_3>;
using Domain = CGAL::Polyhedral_mesh_domain_3<Surface, Kernel>;
using Triangulation = CGAL::Mesh_triangulation_3<Domain>::type;
using Complex = CGAL::Mesh_complex_3_in_triangulation_3<Triangulation>;
using Criteria = CGAL::Mesh_criteria_3<Triangulation>;

int main(int argc, char** argv) {
  if (argc != 4) return 2;
  const peers::Stopwatch clock;
  Surface surface;
  if (!CGAL::IO::read_polygon_mesh(argv[1], surface)) return 3;
  const CGAL::Bbox_3 box = CGAL::Polygon_mesh_processing::bbox(surface);
  const double diagonal = std::sqrt(std::pow(box.x_span(), 2) + std::pow(box.y_span(), 2) + std::pow(box.z_span(), 2));
  const double edge = diagonal / std::atof(argv[3]);
  const Domain domain(surface);
  namespace params = CGAL::parameters;
  const Criteria criteria(params::facet_angle = 25, params::facet_size = edge, params::facet_distance = edge / 8,
                          params::cell_radius_edge_ratio = 2, params::cell_size = edge);
  const Complex complex = CGAL::make_mesh_3<Complex>(domain, criteria);  // with perturbation and exudation
  std::ofstream out(argv[2]);
  complex.output_to_medit(out);
  out.close();
  std::printf("{\"seconds\": %.6f, \"tets\": %zu}\n", clock.seconds(),
              static_cast<std::size_t>(complex.number_of_cells_in_complex()));
}
