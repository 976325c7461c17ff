// Images of labels: NRRD in, surfaces out.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "tetsoup/error.h"
#include "tetsoup/io.h"
#include "tetsoup/label_volume.h"
#include "tetsoup/tetsoup.h"

namespace tetsoup {
namespace {

LabelVolume parse(const std::string& text) {
  return parse_label_volume(std::as_bytes(std::span(text)), "scan.nrrd");
}

/// 3 x 2 x 2 voxels, of which label 1 has five and label 7 has two.
const std::string kLabels = std::string("\1\1\0\1\1\0\7\0\0\7\0\1", 12);
std::string header(const std::string& more) {
  return "NRRD0004\n# by hand\ntype: uint8\ndimension: 3\nsizes: 3 2 2\n" + more + "\n";
}

std::string error_of(const std::string& text) {
  try {
    parse(text);
  } catch (const IoError& error) {
    return error.what();
  }
  return "no error";
}

/// Signed, by shells.
double volume_of(const TriangleSoup& soup) {
  double six = 0;
  for (const auto& [a, b, c] : soup.triangles) {
    const auto p = [&](std::uint32_t v) { return placed(soup.vertices[v], soup.origin); };
    const Vec3d x = p(a), y = p(b), z = p(c);
    six += x.x * (y.y * z.z - y.z * z.y) + x.y * (y.z * z.x - y.x * z.z) + x.z * (y.x * z.y - y.y * z.x);
  }
  return six / 6;
}

TEST(LabelVolume, raw_text_and_packed_numbers_are_the_same_labels) {
  const LabelVolume raw = parse(header("encoding: raw\n") + kLabels);
  EXPECT_EQ(raw.size, (std::array<std::size_t, 3>{3, 2, 2}));
  EXPECT_EQ(raw.labels, (std::vector<std::uint32_t>{1, 1, 0, 1, 1, 0, 7, 0, 0, 7, 0, 1}));
  EXPECT_EQ(parse(header("encoding: ascii\n") + "1 1 0 1 1 0\n7 0 0 7 0 1").labels, raw.labels);
  // Stored, as gzip packs what it cannot make smaller; a name in its header.
  const std::string stored =
      std::string("\x1f\x8b\x08\x08\0\0\0\0\0\3scan\0\1\x0c\0\xf3\xff", 20) + kLabels + std::string(8, '\0');
  EXPECT_EQ(parse(header("encoding: gzip\n") + stored).labels, raw.labels);
}

TEST(LabelVolume, numbers_of_both_orders_places_and_names_are_read) {
  const std::string text =
      "NRRD0005\ntype: unsigned short\ndimension: 3\nsizes: 2 1 1\nendian: big\nencoding: raw\n"
      "space: left-posterior-superior\nspace directions: (0.5,0,0) (0,2,0) (0,0,-3)\nspace origin: (1,2,3)\n"
      "Segment0_Name:=femur head\nSegment0_LabelValue:=258\nSegment1_Name:=air\n\n";
  const LabelVolume volume = parse(text + std::string("\1\2\0\0", 4));
  EXPECT_EQ(volume.labels, (std::vector<std::uint32_t>{258, 0}));
  EXPECT_EQ(volume.steps[2], (Vec3d{0, 0, -3}));
  EXPECT_EQ(volume.origin, (Vec3d{1, 2, 3}));
  const RenderMesh surface = label_surfaces(volume);
  ASSERT_EQ(surface.parts.size(), 1U);
  EXPECT_EQ(surface.parts[0].object, "femur head");
  const TriangleSoup soup = label_hull(volume);
  EXPECT_NEAR(volume_of(soup), 0.5 * 2 * 3, 1e-6);  // Outwards though the axes are left-handed.
  const Box3 box = clean_soup(soup).report.box;
  EXPECT_NEAR(box.lo.x, 0.75, 1e-6);
  EXPECT_NEAR(box.hi.z, 4.5, 1e-6);
}

TEST(LabelVolume, every_label_is_a_closed_surface_of_its_voxels) {
  const LabelVolume volume = parse(header("spacings: 1 1 2\n") + kLabels);
  const RenderMesh surface = label_surfaces(volume);
  ASSERT_EQ(surface.parts.size(), 2U);
  EXPECT_EQ(surface.parts[0].object, "label_1");
  EXPECT_EQ(surface.parts[1].object, "label_7");
  EXPECT_NEAR(volume_of(triangles_of(surface)), 7 * 2, 1e-6);
  const TriangleSoup hull = label_hull(volume);
  EXPECT_NEAR(volume_of(hull), 7 * 2, 1e-6);
  EXPECT_EQ(clean_soup(hull).report.boundary_edges, 0U);
  EXPECT_LT(hull.triangles.size(), surface.face_sizes.size());
}

TEST(LabelVolume, a_ball_of_voxels_becomes_tets_with_its_core_as_a_region) {
  LabelVolume volume;
  volume.size = {24, 24, 24};
  for (int z = 0; z < 24; ++z)
    for (int y = 0; y < 24; ++y)
      for (int x = 0; x < 24; ++x) {
        const double away = std::hypot(x - 11.5, y - 11.5, z - 11.5);
        volume.labels.push_back(away < 5 ? 2 : away < 10 ? 1 : 0);
      }
  const TetMesh mesh = mesh_soup(label_hull(volume));
  const RenderMesh surface = label_surfaces(volume);
  std::vector<std::uint32_t> labels = triangle_faces(surface);
  for (std::uint32_t& l : labels) l = surface.face_parts[l];
  const TriangleSoup soup = triangles_of(surface);
  const TetLabels shares = share_tets(mesh, soup, labels);
  const auto voxels = static_cast<double>(std::count(volume.labels.begin(), volume.labels.end(), 2U));
  double core = 0;
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    TetMesh one{mesh.vertices, {mesh.tets[t]}};
    for (const LabelShare& s : shares[t])
      if (s.label == 1) core += static_cast<double>(s.share) * measure_quality(one).volume;
  }
  EXPECT_NEAR(core, voxels, 0.03 * voxels);
}

TEST(LabelVolume, what_holds_no_labels_is_refused_with_the_reason) {
  EXPECT_NE(error_of("P5 3 2").find("not NRRD"), std::string::npos);
  EXPECT_NE(error_of(header("encoding: ascii\n") + "0.5 1 1 1 1 1 1 1 1 1 1 1").find("grey value"), std::string::npos);
  EXPECT_NE(error_of(header("encoding: bzip2\n") + kLabels).find("raw, gzip and text"), std::string::npos);
  EXPECT_NE(error_of(header("encoding: raw\n") + "\1\1").find("cut short"), std::string::npos);
  EXPECT_NE(error_of(header("encoding: gzip\n") + kLabels).find("damaged"), std::string::npos);
  EXPECT_NE(error_of(header("sizes: 3 2 -2\n") + kLabels).find("line 6: sizes"), std::string::npos);
  EXPECT_NE(error_of(header("sizes: 1000000 1000000 1000000\n")).find("2^30"), std::string::npos);
  EXPECT_NE(error_of("NRRD0004\ndimension: 4\n\n").find("dimension 4"), std::string::npos);
  EXPECT_NE(error_of(header("data file: other.raw\n")).find("another file"), std::string::npos);
  EXPECT_NE(error_of(header("space origin: (1,2)\n") + kLabels).find("expected 3 numbers"), std::string::npos);
  EXPECT_NE(error_of("NRRD0004\ntype: uint8\n\n").find("lacks"), std::string::npos);
  LabelVolume flat;
  flat.size = {1, 1, 1};
  flat.labels = {1};
  flat.steps[2] = {};
  EXPECT_THROW(label_hull(flat), InvalidInput);
}

}  // namespace
}  // namespace tetsoup
