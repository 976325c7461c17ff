#include "base/bits.h"
#include "base/mesh_voxels.h"
#include "base/origin.h"
#include "base/parallel.h"
#include "tetsoup/quality.h"

namespace tetsoup {
namespace {

std::size_t count_inside(const BitGrid& inside, StageWatch& watch) {
  constexpr std::int64_t kGrain = 1 << 15;  // words
  const auto count = [&](std::int64_t begin, std::int64_t end) {
    std::size_t sum = 0;
    for (auto w = static_cast<std::size_t>(begin); w < static_cast<std::size_t>(end); ++w)
      if (inside.words[w] != 0) sum += bit_count(inside.words[w]);
    return sum;
  };
  return parallel_sum<std::size_t>(static_cast<std::int64_t>(inside.words.size()), kGrain, watch, count);
}

}  // namespace

double intersection_over_union(const TetMesh& mesh, const BitGrid& inside) {
  if (inside.frame.voxel_count() == 0) return 1;
  const Progress nobody;
  StageWatch watch(nobody, "quality");
  const Vec3d& origin = inside.frame.soup_origin;
  const bool is_near = mesh.origin == origin;
  const TetMesh near = is_near ? TetMesh{} : TetMesh{recounted(mesh.vertices, mesh.origin, origin), mesh.tets, origin};
  const MeshVoxels voxels = count_mesh_voxels(is_near ? mesh : near, inside, watch);
  const std::size_t in_either = voxels.in_mesh + count_inside(inside, watch) - voxels.in_both;
  return in_either == 0 ? 1 : static_cast<double>(voxels.in_both) / static_cast<double>(in_either);
}

}  // namespace tetsoup
