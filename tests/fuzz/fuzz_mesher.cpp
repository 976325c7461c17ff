// The whole mesher: options as JSON up to 0x00 0xff, then a soup. A closed mesh of positive tets whatever the soup, or
// InvalidInput.
#include <array>
#include <cmath>
#include <limits>

#include "fuzz.h"
#include "tetsoup/error.h"
#include "tetsoup/quality.h"
#include "tetsoup/scene.h"

namespace tetsoup::fuzz {
namespace {

/// What no coordinate should be, and some may be.
constexpr std::array<float, 8> kOdd{std::numeric_limits<float>::quiet_NaN(),
                                    std::numeric_limits<float>::infinity(),
                                    3e38F,
                                    -3e38F,
                                    1e-40F,
                                    1e20F,
                                    -1e-20F,
                                    16777217.0F};

float coordinate(Choices& choices) {
  const auto byte = choices.take<std::int8_t>();
  constexpr std::int8_t kMark = -128;
  return byte == kMark ? kOdd[choices.below(kOdd.size())] : static_cast<float>(byte) / 16;
}

TriangleSoup soup_of(Choices& choices) {
  TriangleSoup soup;
  const unsigned vertices = 1 + choices.below(64);
  for (unsigned i = 0; i < vertices; ++i)
    soup.vertices.push_back({coordinate(choices), coordinate(choices), coordinate(choices)});
  while (choices.are_left()) {
    // One more than there are.
    const unsigned a = choices.below(vertices + 1), b = choices.below(vertices + 1), c = choices.below(vertices + 1);
    soup.triangles.push_back({a, b, c});
  }
  return soup;
}

MeshOptions options_of(Bytes text) {
  try {
    return parse_mesh_options(text_of(text));
  } catch (const InvalidInput&) {
    return {};
  }
}

/// So small that a thousand fit into a second or so.
MeshOptions bounded(MeshOptions options) {
  constexpr int kMostVoxels = 12, kMostCells = 6, kMostPasses = 2;
  constexpr std::size_t kMostTets = 200, kMostMemory = std::size_t{64} << 20;
  options.distance.voxel_size.reset();
  options.distance.box.reset();
  options.distance.voxels = std::min(options.distance.voxels.value_or(kMostVoxels), kMostVoxels);
  options.smooth.passes = std::min(options.smooth.passes, kMostPasses);
  LatticeOptions& lattice = options.lattice;
  lattice.edge.reset();
  lattice.cell_size.reset();
  if (lattice.cells) lattice.cells = std::min(*lattice.cells, kMostCells);
  if (lattice.vertices) lattice.vertices = std::min(*lattice.vertices, kMostTets);
  if (!lattice.cells && !lattice.vertices) lattice.tets = std::min(lattice.tets.value_or(kMostTets), kMostTets);
  options.memory_limit = kMostMemory;
  return options;
}

}  // namespace

void fuzz_one(Bytes bytes) {
  const auto [text, rest] = Choices(bytes).halves();
  Choices choices(rest);
  const TriangleSoup soup = soup_of(choices);
  constexpr std::size_t kMostTriangles = 300;
  if (soup.triangles.size() > kMostTriangles) return;
  try {
    Pipeline pipeline(soup);
    const Quality quality = measure_quality(pipeline.run(bounded(options_of(text))).mesh);
    expect(quality.inverted_tets == 0, "tets are positive");
    expect(quality.invalid_tets == 0, "corners of tets exist");
    expect(quality.unused_vertices == 0, "every vertex has a tet");
    expect(quality.boundary_closed, "the boundary is closed");
  } catch (const InvalidInput&) {
  }
}

}  // namespace tetsoup::fuzz
