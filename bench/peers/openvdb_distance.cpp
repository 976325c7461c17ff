// Unsigned distance with OpenVDB: openvdb_distance SOUP.bin nx ny nz ox oy oz h BAND, the band in voxels. It follows
// the surface rather than the box, so a band over everything also covers space outside the box.
#include <openvdb/openvdb.h>
#include <openvdb/tools/MeshToVolume.h>

#include "peer_common.h"

namespace {

// The soup in index space.
struct Adapter {
  const peers::Soup& soup;
  const peers::Grid& grid;
  std::size_t polygonCount() const { return soup.triangles.size(); }
  std::size_t pointCount() const { return soup.vertices.size(); }
  std::size_t vertexCount(std::size_t) const { return 3; }
  void getIndexSpacePoint(std::size_t polygon, std::size_t vertex, openvdb::Vec3d& position) const {
    const auto& p = soup.vertices[soup.triangles[polygon][vertex]];
    position = openvdb::Vec3d((p[0] - grid.ox) / grid.h, (p[1] - grid.oy) / grid.h, (p[2] - grid.oz) / grid.h);
  }
};

}  // namespace

int main(int argc, char** argv) {
  if (argc != 10) return 2;
  const peers::Soup soup = peers::read_raw_soup(argv[1]);
  const peers::Grid grid = peers::grid_of(argv + 2);
  const float band = static_cast<float>(std::atof(argv[9]));
  openvdb::initialize();
  const peers::Stopwatch clock;
  const auto transform = openvdb::math::Transform::createLinearTransform(grid.h);
  const auto field = openvdb::tools::meshToVolume<openvdb::FloatGrid>(Adapter{soup, grid}, *transform, band, band,
                                                                      openvdb::tools::UNSIGNED_DISTANCE_FIELD);
  const double seconds = clock.seconds();
  std::size_t in_band = 0;
  for (auto value = field->cbeginValueOn(); value; ++value) {
    const openvdb::Coord at = value.getCoord();
    const bool in_box =
        at.x() >= 0 && at.y() >= 0 && at.z() >= 0 && at.x() < grid.nx && at.y() < grid.ny && at.z() < grid.nz;
    in_band += in_box && static_cast<double>(*value) < 3 * grid.h ? 1 : 0;
  }
  peers::report(seconds, in_band);
}
