#include "scene/source.h"

#include <algorithm>
#include <limits>

#include "base/elementary.h"
#include "base/vec.h"
#include "scene/check.h"
#include "scene/problem.h"
#include "tetsoup/io.h"
#include "tetsoup/samples.h"

namespace tetsoup::scene {
namespace {

Vec3d times(const Vec3d& a, const Vec3d& b) {
  return {a.x * b.x, a.y * b.y, a.z * b.z};
}

/// Six sides of quads, fine enough to be seen to bend.
class BoxSurface {
 public:
  explicit BoxSurface(const Vec3d& size) : size_(size) {
    constexpr double kAlong = 40;  // quads of the longest side
    const double quad = std::max({size.x, size.y, size.z}) / kAlong;
    const std::array<double, 3> sizes{size.x, size.y, size.z};
    for (std::size_t i = 0; i < 3; ++i) counts_[i] = std::max(1, static_cast<int>(std::lround(sizes[i] / quad)));
    for (std::size_t axis = 0; axis < 3; ++axis)
      for (const bool far : {false, true}) add_side(axis, far);
  }
  TriangleSoup soup;

 private:
  Vec3 point(const std::array<int, 3>& at) const {
    const auto share = [&](std::size_t i) { return static_cast<double>(at[i]) / counts_[i] - 0.5; };
    return to_float(times(size_, {share(0), share(1), share(2)}));
  }
  void add_side(std::size_t axis, bool far) {
    const std::size_t u = (axis + (far ? 1 : 2)) % 3, v = (axis + (far ? 2 : 1)) % 3;
    const auto across = static_cast<std::uint32_t>(counts_[u]) + 1;
    for (int j = 0; j <= counts_[v]; ++j) {
      for (int i = 0; i <= counts_[u]; ++i) {
        std::array<int, 3> at{};
        at[axis] = far ? counts_[axis] : 0;
        at[u] = i;
        at[v] = j;
        const auto corner = static_cast<std::uint32_t>(soup.vertices.size());
        soup.vertices.push_back(point(at));
        if (i == 0 || j == 0) continue;
        const std::uint32_t a = corner - across - 1, b = corner - across, d = corner - 1;
        soup.triangles.push_back({a, b, corner});
        soup.triangles.push_back({a, corner, d});
      }
    }
  }

  Vec3d size_;
  std::array<int, 3> counts_{};
};

/// The same numbers on every machine: splitmix64 of seed, instance and which [Steele, Lea, Flood 2014].
double random_between(double low, double high, std::uint64_t seed, std::uint64_t instance, std::uint64_t which) {
  std::uint64_t z = seed * 0x9E3779B97F4A7C15U + (instance * 8 + which + 1) * 0xD1342543DE82EF95U;
  z = (z ^ z >> 30) * 0xBF58476D1CE4E5B9U;
  z = (z ^ z >> 27) * 0x94D049BB133111EBU;
  return low + (high - low) * static_cast<double>((z ^ z >> 31) >> 11) * 0x1p-53;
}

Vec3d random_vector(double most, std::uint64_t seed, std::uint64_t instance, std::uint64_t which) {
  const auto one = [&](std::uint64_t axis) { return random_between(-most, most, seed, instance, which + axis); };
  return {one(0), one(1), one(2)};
}

/// Around those that are finite; inside out where none is.
Box3 finite_box_of(std::span<const Vec3> points) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Box3 box{{kInfinity, kInfinity, kInfinity}, {-kInfinity, -kInfinity, -kInfinity}};
  for (const Vec3& p : points) {
    if (!is_finite(p)) continue;
    box.lo = min(box.lo, to_double(p));
    box.hi = max(box.hi, to_double(p));
  }
  return box;
}

Vec3d radians(const Vec3d& degrees) {
  return degrees * kDegree;
}

}  // namespace

double longest_side(std::span<const Vec3> points) {
  const Box3 box = finite_box_of(points);
  return std::max({box.hi.x - box.lo.x, box.hi.y - box.lo.y, box.hi.z - box.lo.z});
}

Unit unit_of(const std::string& path, const SceneSource& source, std::span<const Vec3> points, const Vec3d& origin) {
  const auto [lo, hi] = finite_box_of(points);
  const double longest = longest_side(points);
  if (longest < 0) throw Problem(path, "there is no point in it");
  if (source.size && !(longest > 0)) throw Problem(member_path(path, "size"), "the source has no extent");
  Unit unit{source.size ? *source.size / longest : source.metres_per_unit.value_or(1), {}};
  check_number(path + ": its longest side, m", longest * unit.metres, kSizeRange);
  if (source.origin != SceneOrigin::Own) {
    unit.origin = (lo + hi) * 0.5;
    if (source.origin == SceneOrigin::Bottom) unit.origin.z = lo.z;
    unit.origin += origin;
  }
  return unit;
}

void to_metres(const Unit& unit, std::vector<Vec3>& points, Vec3d& origin) {
  const bool stays = unit.origin == Vec3d{};
  const Vec3d zero = stays ? Vec3d{} : unit.origin - origin;
  for (Vec3& p : points)
    if (is_finite(p)) p = to_float((to_double(p) - zero) * unit.metres);
  origin = stays ? origin * unit.metres : Vec3d{};
}

RenderMesh make_surface(const SceneSource& source, const std::filesystem::path& folder) {
  if (source.box) return render_mesh_of(BoxSurface(*source.box).soup);
  if (!source.sample.empty())
    return render_mesh_of(make_sample(source.sample, {.damage = source.damage, .seed = source.seed}));
  return read_render_mesh(folder / source.file);
}

std::string name_of(const SceneSource& source) {
  if (source.box) return "box";
  if (!source.sample.empty()) return source.sample;
  return std::filesystem::path(source.file.empty() ? source.tets_file : source.file).stem().string();
}

Vec3d turned(const ScenePlace& place, const Vec3d& p) {
  const Vec3d a = radians(place.rotate);
  const Vec3d x{p.x, elementary::cos(a.x) * p.y - elementary::sin(a.x) * p.z,
                elementary::sin(a.x) * p.y + elementary::cos(a.x) * p.z};
  const Vec3d y{elementary::cos(a.y) * x.x + elementary::sin(a.y) * x.z, x.y,
                elementary::cos(a.y) * x.z - elementary::sin(a.y) * x.x};
  return {elementary::cos(a.z) * y.x - elementary::sin(a.z) * y.y,
          elementary::sin(a.z) * y.x + elementary::cos(a.z) * y.y, y.z};
}

Vec3d placed(const ScenePlace& place, const Vec3d& p) {
  return turned(place, p * place.scale) + place.translate;
}

std::vector<ScenePlace> places_of(const SceneBody& body) {
  if (!body.instances.empty()) return body.instances;
  if (!body.grid) return {body.place};
  const SceneGrid& grid = *body.grid;
  std::vector<ScenePlace> places;
  for (int z = 0; z < grid.count[2]; ++z) {
    for (int y = 0; y < grid.count[1]; ++y) {
      for (int x = 0; x < grid.count[0]; ++x) {
        const auto off = [](int i, int n) { return i - (n - 1) * 0.5; };
        const Vec3d cell{off(x, grid.count[0]), off(y, grid.count[1]), off(z, grid.count[2])};
        const std::uint64_t number = places.size();
        ScenePlace& place = places.emplace_back(body.place);
        place.translate += times(grid.spacing, cell) + random_vector(grid.jitter, grid.seed, number, 0);
        place.rotate += random_vector(grid.jitter_rotate, grid.seed, number, 3);
      }
    }
  }
  return places;
}

Pose pose_of(const ScenePlace& place) {
  return {place.translate, radians(place.rotate), place.scale, place.velocity, radians(place.spin)};
}

}  // namespace tetsoup::scene
