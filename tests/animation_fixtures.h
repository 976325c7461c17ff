// Two bars of one make that bend by formula, and what writes them.
#pragma once

#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "tet_file_fixtures.h"
#include "tetsoup/animation.h"
#include "tetsoup/io.h"

namespace tetsoup {

/// A bar of eight cubes along x, bent to a circle that grows tighter with time, and moved aside.
inline std::vector<Vec3> bent(const std::vector<Vec3>& points, double time, double aside = 0) {
  const double curvature = 0.02 + 0.25 * time;
  std::vector<Vec3> moved;
  for (const Vec3& p : points) {
    const double angle = curvature * p.x, radius = 1 / curvature - p.z;
    moved.push_back({static_cast<float>(radius * std::sin(angle) + aside), p.y,
                     static_cast<float>(1 / curvature - radius * std::cos(angle) + 2 * time)});
  }
  return moved;
}

inline std::vector<Vec3> turned(const std::vector<Vec3>& points, double angle) {
  std::vector<Vec3> moved;
  for (const Vec3& p : points)
    moved.push_back({static_cast<float>(std::cos(angle) * p.x - std::sin(angle) * p.y),
                     static_cast<float>(std::sin(angle) * p.x + std::cos(angle) * p.y + angle),
                     static_cast<float>(p.z + 0.3 * angle)});
  return moved;
}

/// Two bars of one make, one of which shows its quads' surface, and `count` frames of them.
class AnimationTest : public FolderTest {
 protected:
  AnimationTest() {
    for (int x = 0; x <= 8; ++x)
      for (const auto& [y, z] : {std::pair{0, 0}, {1, 0}, {0, 1}, {1, 1}})
        bar_.vertices.push_back({static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)});
    for (std::uint32_t x = 0; x < 8; ++x) {
      const std::uint32_t c = 4 * x;  // Six tets about the cube's diagonal from c to c + 7.
      for (const auto& [a, b] : {std::pair{1U, 3U}, {3U, 2U}, {2U, 6U}, {6U, 4U}, {4U, 5U}, {5U, 1U}}) {
        Tet tet{c, c + a, c + b, c + 7};
        if (volume(tet) < 0) std::swap(tet[1], tet[2]);
        bar_.tets.push_back(tet);
      }
    }
    for (int x = 0; x < 9; ++x)
      for (int y = 0; y < 2; ++y) {
        quads_.vertices.push_back(
            {x == 0 ? 0.1F : static_cast<float>(x) - 0.1F, 0.1F + 0.8F * static_cast<float>(y), 0.9F});
        quads_.texcoords.push_back({static_cast<float>(x) / 8, static_cast<float>(y)});
      }
    for (std::uint32_t x = 0; x < 8; ++x) {
      quads_.face_sizes.push_back(4);
      for (const std::uint32_t v : {2 * x, 2 * x + 2, 2 * x + 3, 2 * x + 1}) {
        quads_.corners.push_back(v);
        quads_.corner_texcoords.push_back(v);
      }
    }
    embedding_ = embed_points(bar_, triangles_of(quads_));
    scene_.bodies = {{"plain", &bar_, nullptr, nullptr}, {"dressed", &bar_, &quads_, &embedding_}};
    scene_.planes = {{{0, 0, 1}, -0.5}};
  }

  double volume(const Tet& t) const {
    const auto edge = [&](std::size_t i) {
      const Vec3 &a = bar_.vertices[t[0]], &b = bar_.vertices[t[i]];
      return std::array<double, 3>{double{b.x} - double{a.x}, double{b.y} - double{a.y}, double{b.z} - double{a.z}};
    };
    const auto a = edge(1), b = edge(2), c = edge(3);
    return (a[1] * b[2] - a[2] * b[1]) * c[0] + (a[2] * b[0] - a[0] * b[2]) * c[1] + (a[0] * b[1] - a[1] * b[0]) * c[2];
  }

  static double time_of(std::size_t number) { return static_cast<double>(number) / 60; }
  std::vector<std::vector<Vec3>> positions_at(std::size_t number) const {
    const double time = 0.2 * static_cast<double>(number);
    return {bent(bar_.vertices, time), turned(bent(bar_.vertices, time, 10), 0.1 * static_cast<double>(number))};
  }

  AnimationReport write(const std::vector<std::filesystem::path>& paths, std::size_t count,
                        AnimationOptions options = small(), std::size_t first = 0) const {
    options.first_frame = first;
    AnimationWriter writer(paths, scene_, options);
    for (std::size_t number = first; number < first + count; ++number) {
      const auto positions = positions_at(number);
      writer.add_frame({time_of(number), 0x123456789ABCDEF0U + number, {positions[0], positions[1]}, {}, {}});
    }
    writer.finish();
    return writer.report();
  }

  static AnimationOptions small() {
    AnimationOptions options;
    options.width = 160;
    options.height = 90;
    return options;
  }

  TetMesh bar_;
  RenderMesh quads_;
  Embedding embedding_;
  AnimationScene scene_;
};

}  // namespace tetsoup
