// A model as NumPy arrays, and a mesh out of such. Newton's TetMesh.create_from_file() reads the first six; it makes a
// custom attribute of every further one, so what can be computed from these (surface faces, edges) is not there.
#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "base/origin.h"
#include "base/tet_geometry.h"
#include "io/model_parts.h"
#include "io/npz.h"
#include "io/zip_reader.h"
#include "io/tet_readers.h"
#include "io/tet_writers.h"

namespace tetsoup {

namespace {

/// How many values Newton is to expect of an array, as its Model.AttributeFrequency numbers it.
enum class Frequency : std::int32_t { Once = 0, Tet = 12 };

/// Arrays beyond Newton's own. It guesses what an array belongs to by its length, and gives up where two are alike,
/// unless two more arrays tell.
class ExtraArrays {
 public:
  explicit ExtraArrays(NpzWriter& npz) : npz_(npz) {}

  template <class Number>
  void add(const std::string& name, Frequency frequency, std::initializer_list<std::size_t> shape,
           std::span<const Number> numbers) {
    npz_.add(name, shape, numbers);
    announce(name, frequency);
  }
  void add_texts(const std::string& name, std::span<const std::string> texts) {
    npz_.add_texts(name, texts);
    announce(name, Frequency::Once);
  }
  void finish() {
    if (names_.empty()) return;
    npz_.add_texts("__custom_names__", names_);
    npz_.add("__custom_freqs__", {frequencies_.size()}, std::span<const std::int32_t>(frequencies_));
  }

 private:
  void announce(const std::string& name, Frequency frequency) {
    names_.push_back(name);
    frequencies_.push_back(static_cast<std::int32_t>(frequency));
  }

  NpzWriter& npz_;
  std::vector<std::string> names_;
  std::vector<std::int32_t> frequencies_;
};

std::vector<std::int32_t> as_signed(std::span<const std::uint32_t> indices) {
  return {indices.begin(), indices.end()};
}

template <class Array, std::size_t kColumns>
std::span<const Array> flat(std::span<const std::array<Array, kColumns>> rows) {
  return {rows.empty() ? nullptr : rows.front().data(), kColumns * rows.size()};
}

template <class Number, class Point>
std::vector<Number> flat_numbers(std::span<const Point> points) {
  std::vector<Number> numbers;
  numbers.reserve(3 * points.size());
  for (const Point& p : points) numbers.insert(numbers.end(), {p.x, p.y, p.z});
  return numbers;
}

/// Floats, which Newton reads; doubles where the points lie too far from zero for those.
template <class Add>
void add_points(std::span<const Vec3> points, const Vec3d& origin, const Add& add) {
  if (origin == Vec3d{}) return add(std::span<const float>(flat_numbers<float>(points)));
  const std::vector<Vec3d> placed = placed_points(points, origin);
  add(std::span<const double>(flat_numbers<double>(std::span<const Vec3d>(placed))));
}

/// Of one material that gives the mesh its mass; the first region's where it has no volume.
double mean_density(const TetModel& model) {
  if (!has_regions(model) && model.density_scale.empty()) return in_mesh_units(model.regions[0].material).density;
  double mass = 0, volume = 0;
  for (std::size_t t = 0; t < model.mesh.tets.size(); ++t) {
    const double v = signed_volume(corners_of(model.mesh, model.mesh.tets[t]));
    if (!(v > 0)) continue;
    volume += v;
    mass += v * density_scale_of(model, t) * in_mesh_units(model.regions[region_of(model, t)].material).density;
  }
  return volume > 0 ? mass / volume : in_mesh_units(model.regions[0].material).density;
}

void add_materials(NpzWriter& npz, const TetModel& model) {
  std::vector<float> mu, lambda;
  for (std::size_t t = 0; t < model.mesh.tets.size(); ++t) {
    const Material material = in_mesh_units(model.regions[region_of(model, t)].material);
    const double e = stiffness_scale_of(model, t) * material.young, nu = material.poisson;
    mu.push_back(static_cast<float>(e / (2 * (1 + nu))));
    lambda.push_back(static_cast<float>(e * nu / ((1 + nu) * (1 - 2 * nu))));
  }
  const double density = mean_density(model);
  npz.add("k_mu", {mu.size()}, std::span<const float>(mu));
  npz.add("k_lambda", {lambda.size()}, std::span<const float>(lambda));
  npz.add("density", {}, std::span<const double>(&density, 1));
}

void add_regions(ExtraArrays& arrays, const TetModel& model) {
  if (!has_regions(model)) return;
  std::vector<std::int32_t> regions;
  std::vector<float> densities;
  std::vector<std::string> names;
  for (std::size_t t = 0; t < model.mesh.tets.size(); ++t) {
    const std::uint32_t region = region_of(model, t);
    regions.push_back(static_cast<std::int32_t>(region));
    densities.push_back(static_cast<float>(in_mesh_units(model.regions[region].material).density));
  }
  for (const Region& region : model.regions) names.push_back(region.name);
  arrays.add("tet_regions", Frequency::Tet, {regions.size()}, std::span<const std::int32_t>(regions));
  arrays.add("tet_densities", Frequency::Tet, {densities.size()}, std::span<const float>(densities));
  arrays.add_texts("region_names", names);
}

void add_scales(ExtraArrays& arrays, const TetModel& model) {
  const auto add = [&](const std::string& name, const std::vector<float>& scales) {
    if (!scales.empty()) arrays.add(name, Frequency::Tet, {scales.size()}, std::span<const float>(scales));
  };
  add("stiffness_scale", model.stiffness_scale);
  add("density_scale", model.density_scale);
}

void add_pins(ExtraArrays& arrays, const TetModel& model) {
  LegalNames legal;
  const std::vector<std::string> names = pin_names(model, legal);
  for (std::size_t i = 0; i < names.size(); ++i) {
    const std::vector<std::int32_t> vertices = as_signed(model.pins[i].vertices);
    arrays.add("pin_" + names[i], Frequency::Once, {vertices.size()}, std::span<const std::int32_t>(vertices));
  }
}

void add_embedding(ExtraArrays& arrays, const TetModel& model) {
  const Embedding& embedding = model.embedding;
  const std::size_t count = embedding.tets.size();
  if (count == 0) return;
  const std::vector<std::int32_t> tets = as_signed(embedding.tets);
  arrays.add("embedding_tets", Frequency::Once, {count}, std::span<const std::int32_t>(tets));
  arrays.add("embedding_weights", Frequency::Once, {count, 4}, flat(std::span(embedding.weights)));
  if (model.render.vertices.size() != count) return;
  add_points(model.render.vertices, model.render.origin, [&](auto numbers) {
    arrays.add("render_vertices", Frequency::Once, {count, 3}, numbers);
  });
}

}  // namespace

std::string npz_text(const TetModel& model) {
  NpzWriter npz;
  std::vector<std::int32_t> corners;
  for (const Tet& tet : model.mesh.tets)
    for (const std::uint32_t corner : tet) corners.push_back(static_cast<std::int32_t>(corner));
  add_points(model.mesh.vertices, model.mesh.origin, [&](auto numbers) {
    npz.add("vertices", {model.mesh.vertices.size(), 3}, numbers);
  });
  npz.add("tet_indices", {model.mesh.tets.size(), 4}, std::span<const std::int32_t>(corners));
  add_materials(npz, model);
  ExtraArrays extra(npz);
  add_regions(extra, model);
  add_scales(extra, model);
  add_pins(extra, model);
  add_embedding(extra, model);
  extra.finish();
  return npz.take();
}

/// Newton's own files hold the corners in one row.
TetMesh parse_npz(std::string_view bytes, const std::string& name) {
  const auto arrays = read_npz(bytes, name);
  const auto corners_array = arrays.find("tet_indices");
  const bool flat_corners = corners_array != arrays.end() && corners_array->second.shape.size() == 1;
  const std::vector<double> p = npz_reals(arrays, name, "vertices", 3);
  const std::vector<std::uint32_t> corners = npz_indices(arrays, name, "tet_indices", flat_corners ? 0 : 4);
  if (corners.size() % 4 != 0) fail_in_file(name, 0, "'tet_indices' is not four corners for every tet");
  WideTetMesh mesh;
  for (std::size_t i = 0; i < p.size(); i += 3) mesh.vertices.push_back({p[i], p[i + 1], p[i + 2]});
  for (const std::uint32_t corner : corners)
    if (corner >= mesh.vertices.size())
      fail_in_file(name, 0,
                   "'tet_indices' names vertex " + std::to_string(corner) + ", there are " +
                       std::to_string(mesh.vertices.size()));
  for (std::size_t i = 0; i < corners.size(); i += 4)
    mesh.tets.push_back({corners[i], corners[i + 1], corners[i + 2], corners[i + 3]});
  return std::move(mesh).narrowed();
}

}  // namespace tetsoup
