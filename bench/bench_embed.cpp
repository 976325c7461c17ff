// A million vertices hung on the tets, and moved with them.
#include "bench_rows.h"

namespace tetsoup::bench {

namespace {

constexpr std::size_t kPoints = 1'000'000;

/// Every triangle cut into four until there are enough vertices; the new ones lie on the old triangles.
TriangleSoup divided(TriangleSoup soup) {
  while (soup.vertices.size() < kPoints) {
    std::vector<Triangle> quarters;
    for (const Triangle& t : soup.triangles) {
      const auto middle = [&](std::uint32_t i, std::uint32_t j) {
        const Vec3 a = soup.vertices[i], b = soup.vertices[j];
        soup.vertices.push_back({(a.x + b.x) / 2, (a.y + b.y) / 2, (a.z + b.z) / 2});
        return static_cast<std::uint32_t>(soup.vertices.size() - 1);
      };
      const std::uint32_t ab = middle(t[0], t[1]), bc = middle(t[1], t[2]), ca = middle(t[2], t[0]);
      quarters.insert(quarters.end(), {{t[0], ab, ca}, {ab, t[1], bc}, {ca, bc, t[2]}, {ab, bc, ca}});
    }
    soup.triangles = std::move(quarters);
  }
  soup.vertices.resize(kPoints);
  return soup;
}

const TriangleSoup& million_points() {
  static const TriangleSoup soup = divided(clean_soup_of(SoupName::Input).soup);
  return soup;
}

TetMesh mesh_for(int voxels, Cover cover) {
  const Prepared& ready = prepared(SoupName::Input, voxels);
  LatticeOptions options = ready.options.lattice;
  options.cover = cover;
  return fill_lattice(ready.pipeline.pseudo_volume(), ready.pipeline.soup(), options).mesh;
}

void add_embed_row(const std::string& what, int voxels, Cover cover) {
  add_row(row_name(what, {.voxels = voxels}), [voxels, cover](benchmark::State& state) {
    const TetMesh mesh = mesh_for(voxels, cover);
    EmbedReport report;
    for (auto _ : state) report = embed_points(mesh, million_points()).report;
    state.counters["inside"] = static_cast<double>(report.inside);
    state.counters["outside"] = static_cast<double>(report.outside);
  });
}

}  // namespace

void add_embed_rows(int voxels) {
  add_embed_row("embed", voxels, Cover::Density);
  add_embed_row("embed_enclosed", voxels, Cover::Enclose);
  add_row(row_name("deform_points", {.voxels = voxels}), [voxels](benchmark::State& state) {
    const TetMesh mesh = mesh_for(voxels, Cover::Density);
    const Embedding embedding = embed_points(mesh, million_points());
    for (auto _ : state) benchmark::DoNotOptimize(deform_points(embedding, mesh.tets, mesh.vertices).back());
  });
  add_row(row_name("deform_normals", {.voxels = voxels}), [voxels](benchmark::State& state) {
    const TetMesh mesh = mesh_for(voxels, Cover::Density);
    const Embedding embedding = embed_points(mesh, million_points());
    const std::vector<Vec3> normals(embedding.tets.size(), Vec3{0, 0, 1});
    for (auto _ : state) benchmark::DoNotOptimize(deform_normals(embedding, mesh, mesh.vertices, normals).back());
  });
}

}  // namespace tetsoup::bench
