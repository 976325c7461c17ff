// The tree: every leaf and every flake of bark is a triangle that touches no other.
#include <array>
#include <vector>

#include "samples/formula.h"
#include "samples/shapes.h"

namespace tetsoup::samples {

namespace {

struct Blob {
  Vec3d centre;
  double radius;
};

constexpr std::array<Blob, 9> kCrown{{{{0.00, 0.00, 2.55}, 0.72},
                                      {{0.62, 0.10, 2.20}, 0.52},
                                      {{-0.62, -0.08, 2.25}, 0.54},
                                      {{0.10, 0.60, 2.20}, 0.52},
                                      {{-0.05, -0.60, 2.18}, 0.54},
                                      {{0.42, -0.42, 2.62}, 0.45},
                                      {{-0.42, 0.42, 2.66}, 0.45},
                                      {{0.05, 0.00, 3.05}, 0.48},
                                      {{0.00, 0.00, 2.00}, 0.62}}};

struct Branch {
  Vec3d from, to;
  double radius;
};

constexpr std::array<Branch, 6> kBranches{{{{0.02, 0.00, 1.05}, {0.62, 0.10, 2.10}, 0.11},
                                           {{-0.02, 0.00, 1.10}, {-0.62, -0.08, 2.15}, 0.11},
                                           {{0.00, 0.03, 1.20}, {0.10, 0.60, 2.10}, 0.10},
                                           {{0.00, -0.03, 1.15}, {-0.05, -0.60, 2.10}, 0.10},
                                           {{0.00, 0.00, 1.50}, {0.42, -0.42, 2.55}, 0.09},
                                           {{0.00, 0.00, 1.50}, {-0.42, 0.42, 2.60}, 0.09}}};

constexpr std::size_t kTreeTriangles = 8000;
constexpr double kTrunkHeight = 1.9;

/// Depth of a point below the crown's surface; negative outside.
double depth_in_crown(const Vec3d& p) {
  double depth = -1e9;
  for (const Blob& blob : kCrown) depth = std::max(depth, blob.radius - length(p - blob.centre));
  return depth;
}

/// The shoot of a leaf leans away from the crown's middle and lies along its surface, more or less.
void add_crown_leaf(TriangleSoup& soup, const Vec3d& at, const Vec3d& outwards, Random& random) {
  constexpr double kTilt = 0.55;
  const Vec3d normal = normalized(outwards + kTilt * random.direction());
  Vec3d along = cross(normal, random.direction());
  // A random direction may be parallel to the normal.
  if (length(along) < 1e-6) along = cross(normal, {normal.y, normal.z, -normal.x});
  // Compilers evaluate arguments in different orders.
  const double width = random.between(0.06, 0.09);
  const double reach = random.between(0.10, 0.15);
  add_leaf(soup, at, normalized(along) * reach, normal, width);
}

void add_branch_leaf(TriangleSoup& soup, Random& random) {
  const Branch& branch = kBranches[random.below(kBranches.size())];
  const double t = random.between(0.45, 1.1);
  const Vec3d away = random.direction();
  const Vec3d at = branch.from + (branch.to - branch.from) * t + away * random.between(0.05, 0.22);
  if (depth_in_crown(at) > 0) add_crown_leaf(soup, at, away, random);
}

void add_blob_leaf(TriangleSoup& soup, Random& random) {
  constexpr double kShell = 0.10;  // Leaves this deep below the crown's surface still count as its surface.
  const Blob& blob = kCrown[random.below(kCrown.size())];
  // By area: a large blob takes more leaves than a small one.
  if (random.uniform() > blob.radius * blob.radius / (kCrown[0].radius * kCrown[0].radius)) return;
  const Vec3d outwards = random.direction();
  const Vec3d at = blob.centre + outwards * (blob.radius - random.between(0, kShell / 2));
  if (depth_in_crown(at) < kShell) add_crown_leaf(soup, at, outwards, random);
}

/// Triangles thrown so that the last of a kind does not overshoot the count.
constexpr double kBranchLeafShare = 0.15;

double flare(double t) {
  // Roots: the foot is half as wide again as the trunk, gone at a quarter of its height.
  const double foot = std::max(0.0, 1 - 4 * t);
  return 0.24 - 0.08 * t + 0.12 * foot * foot;
}

}  // namespace

TriangleSoup make_tree(std::uint64_t seed) {
  Random random(seed);
  TriangleSoup soup;
  add_bark(soup,
           {[](double t) {
              return Vec3d{0.03 * sine(0.6 * t), 0.02 * sine(0.5 * t), kTrunkHeight * t};
            },
            flare, 24, 22},
           random);
  for (const Branch& branch : kBranches) {
    add_bark(soup,
             {[&](double t) { return branch.from + (branch.to - branch.from) * t; },
              [&](double t) { return branch.radius * (1 - 0.6 * t); }, 9, 8},
             random);
  }
  while (soup.triangles.size() < kTreeTriangles) {
    if (random.uniform() < kBranchLeafShare)
      add_branch_leaf(soup, random);
    else
      add_blob_leaf(soup, random);
  }
  return soup;
}

}  // namespace tetsoup::samples
