#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "base/parallel.h"
#include "base/vec.h"
#include "simulate/contact_constants.h"
#include "simulate/part_pairs.h"
#include "simulate/vertex_hash.h"
#include "simulate/world.h"

namespace tetsoup::simulate {
namespace {

constexpr std::int64_t kGrain = 128;  ///< Tets or vertices a task.
/// How far outside a tet's inner faces a vertex may lie, in its heights: edges of bodies stand on edges.
constexpr double kSlack = 0.02;
/// Edge of the cells that vertices are hashed by, in mean edges.
constexpr double kCell = 0.8;

/// A vertex in a tet, or just outside one of its faces on the surface.
struct Hit {
  std::uint32_t vertex = 0, part = 0, tet = 0;
  float depth = 0;                 ///< Least barycentric coordinate: the higher, the more it is this tet's.
  std::array<float, 4> weights{};  ///< Barycentric.
};

class Search {
 public:
  Search(World& world, double horizon)
      : world_(world), watch_(nobody_, "simulate"), pairs_(find_part_pairs(world, horizon, watch_)) {}

  void run() {
    before_ = std::move(world_.contacts.between);
    world_.contacts = {};
    touch_obstacles();
    std::vector<Hit> hits = find_hits();
    keep_one_a_part(hits);
    add_contacts(hits);
  }

 private:
  const Part& part(std::size_t p) const { return world_.parts[p]; }
  const Rest& rest(std::size_t p) const { return world_.rest_of(part(p)); }
  const RestSurface& surface(std::size_t p) const { return world_.surfaces[part(p).surface]; }
  Vec3 place(std::uint32_t slot) const { return to_vec(world_.places[slot]); }

  template <class Body>
  void for_parts(const Body& body) {
    parallel_for(static_cast<std::int64_t>(world_.parts.size()), 1, watch_,
                 [&](std::int64_t p, std::int64_t) { body(static_cast<std::size_t>(p)); });
  }

  void touch_obstacles() {
    std::vector<std::vector<ObstacleContact>> found(world_.parts.size());
    for_parts([&](std::size_t p) {
      for (const Obstacle& obstacle : world_.obstacles)
        for (const std::uint32_t v : surface(p).vertices)
          if (const auto c = touch(obstacle, p, part(p).begin + v)) found[p].push_back(*c);
    });
    for (const auto& some : found)
      world_.contacts.with_obstacles.insert(world_.contacts.with_obstacles.end(), some.begin(), some.end());
  }

  std::optional<ObstacleContact> touch(const Obstacle& obstacle, std::size_t p, std::uint32_t slot) const {
    const Vec3d at = to_double(place(slot));
    const auto clearance = distance_from(obstacle, at);
    if (!clearance || clearance->distance > static_cast<double>(pairs_.ahead[p])) return {};
    const double offset = dot(clearance->normal, at) - clearance->distance;
    return ObstacleContact{slot, to_float(clearance->normal), static_cast<float>(offset),
                           static_cast<float>(std::sqrt(obstacle.friction * rest(p).material.friction))};
  }

  /// The surfaces' vertices that lie where another part may meet them.
  VertexHash hash_vertices() {
    std::vector<std::vector<HashedVertex>> found(world_.parts.size());
    for_parts([&](std::size_t p) {
      for (const std::uint32_t v : surface(p).vertices)
        if (may_meet(p, place(part(p).begin + v))) found[p].push_back({place(part(p).begin + v), part(p).begin + v});
    });
    std::vector<HashedVertex> vertices;
    double edges = 0;
    for (std::size_t p = 0; p < found.size(); ++p) {
      vertices.insert(vertices.end(), found[p].begin(), found[p].end());
      edges += surface(p).mean_edge;
    }
    return {vertices, kCell * edges / static_cast<double>(found.size())};
  }
  bool may_meet(std::size_t p, const Vec3& at) const {
    return std::any_of(pairs_.partners[p].begin(), pairs_.partners[p].end(),
                       [&](const Partner& q) { return pairs_.bounds[q.part].holds(at, q.ahead); });
  }

  std::vector<Hit> find_hits() {
    if (world_.parts.empty()) return {};
    const VertexHash hash = hash_vertices();
    std::vector<std::size_t> first_task(world_.parts.size() + 1, 0);
    for (std::size_t p = 0; p < world_.parts.size(); ++p) {
      const auto tets = static_cast<std::int64_t>(pairs_.partners[p].empty() ? 0 : rest(p).piece.tets.size());
      first_task[p + 1] = first_task[p] + static_cast<std::size_t>(chunk_count(tets, kGrain));
    }
    std::vector<std::vector<Hit>> found(first_task.back());
    parallel_for(static_cast<std::int64_t>(found.size()), 1, watch_, [&](std::int64_t begin, std::int64_t) {
      const auto task = static_cast<std::size_t>(begin);
      const auto p = static_cast<std::size_t>(std::upper_bound(first_task.begin(), first_task.end(), task) -
                                              first_task.begin() - 1);
      const std::size_t first = (task - first_task[p]) * kGrain;
      const std::size_t last = std::min(first + kGrain, rest(p).piece.tets.size());
      for (std::size_t t = first; t < last; ++t) hit_tet(hash, p, t, found[task]);
    });
    std::vector<Hit> hits;
    for (const auto& some : found) hits.insert(hits.end(), some.begin(), some.end());
    return hits;
  }

  void hit_tet(const VertexHash& hash, std::size_t p, std::size_t t, std::vector<Hit>& hits) const {
    const Tet& tet = rest(p).piece.tets[t];
    Bounds box;
    TetCorners corners;
    for (std::size_t i = 0; i < 4; ++i) {
      const Vec3 at = place(part(p).begin + tet[i]);
      box.add(at);
      corners[i] = to_double(at);
    }
    const std::optional<float> ahead = most_ahead(p, box);
    if (!ahead || !(signed_volume(corners) > 0)) return;
    const float margin = surface(p).open_faces[t] == 0 ? 0 : *ahead;
    const Vec3 lo{box.lo.x - margin, box.lo.y - margin, box.lo.z - margin},
        hi{box.hi.x + margin, box.hi.y + margin, box.hi.z + margin};
    std::optional<std::array<Vec3d, 4>> gradients;
    hash.visit_box(lo, hi, [&](const HashedVertex& v) {
      if (!box.holds(v.place, margin) || is_of(p, v.slot, tet)) return;
      const Partner* partner = pairs_.find(p, world_.owners[v.slot]);
      if (partner == nullptr) return;
      if (!gradients) gradients = barycentric_gradients(corners);
      if (auto hit = hit_of(v, {static_cast<std::uint32_t>(p), partner->ahead}, t, corners[0], *gradients))
        hits.push_back(*hit);
    });
  }
  bool is_of(std::size_t p, std::uint32_t slot, const Tet& tet) const {
    return std::any_of(tet.begin(), tet.end(), [&](std::uint32_t v) { return part(p).begin + v == slot; });
  }
  /// Of the partners that the box meets; nothing if there is none.
  std::optional<float> most_ahead(std::size_t p, const Bounds& box) const {
    std::optional<float> most;
    for (const Partner& q : pairs_.partners[p])
      if (box.meets(pairs_.bounds[q.part], q.ahead)) most = std::max(most.value_or(0), q.ahead);
    return most;
  }

  std::optional<Hit> hit_of(const HashedVertex& v, const Partner& p, std::size_t t, const Vec3d& origin,
                            const std::array<Vec3d, 4>& gradients) const {
    const auto ahead = static_cast<double>(p.ahead);
    const Vec3d from = to_double(v.place) - origin;
    Hit hit{v.slot, p.part, static_cast<std::uint32_t>(t), 1, {}};
    for (std::size_t i = 0; i < 4; ++i) {
      const double b = dot(gradients[i], from) + (i == 0 ? 1 : 0);
      const bool open = (surface(p.part).open_faces[t] >> i & 1U) != 0;
      if (b < (open ? -ahead * length(gradients[i]) : -kSlack)) return {};
      hit.weights[i] = static_cast<float>(b);
      hit.depth = std::min(hit.depth, hit.weights[i]);
    }
    return hit;
  }

  /// Of the tets of a part that a vertex is in or before, the one it is deepest in.
  static void keep_one_a_part(std::vector<Hit>& hits) {
    std::sort(hits.begin(), hits.end(), [](const Hit& a, const Hit& b) {
      if (a.vertex != b.vertex) return a.vertex < b.vertex;
      if (a.part != b.part) return a.part < b.part;
      if (a.depth != b.depth) return a.depth > b.depth;
      return a.tet < b.tet;
    });
    const auto same = [](const Hit& a, const Hit& b) { return a.vertex == b.vertex && a.part == b.part; };
    hits.erase(std::unique(hits.begin(), hits.end(), same), hits.end());
  }

  void add_contacts(const std::vector<Hit>& hits) {
    for (const Hit& hit : hits) {
      const Part& owner = part(hit.part);
      find_near_triangles(world_.surfaces[owner.surface], rest(hit.part).piece, hit.tet);
    }
    std::vector<std::optional<Contact>> contacts(hits.size());
    parallel_for(static_cast<std::int64_t>(hits.size()), kGrain, watch_, [&](std::int64_t begin, std::int64_t end) {
      for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i)
        contacts[i] = contact_of(hits[i]);
    });
    for (const auto& contact : contacts)
      if (contact) world_.contacts.between.push_back(*contact);
  }

  /// The side through which the vertex was kept out of the part until now.
  std::optional<Vec3d> way_in(const Hit& hit) const {
    const auto key = std::pair(hit.vertex, hit.part);
    const auto at = std::lower_bound(before_.begin(), before_.end(), key, [](const Contact& c, const auto& wanted) {
      return std::pair(c.vertex, c.part) < wanted;
    });
    if (at == before_.end() || std::pair(at->vertex, at->part) != key) return {};
    return surface(hit.part).normals[at->triangle];
  }

  std::optional<Contact> contact_of(const Hit& hit) const {
    const Piece& piece = rest(hit.part).piece;
    const RestSurface& skin = surface(hit.part);
    Vec3d at;
    for (std::size_t i = 0; i < 4; ++i)
      at += piece.places[piece.tets[hit.tet][i]] * static_cast<double>(hit.weights[i]);
    const std::uint32_t other = world_.owners[hit.vertex];
    if (part(other).body == part(hit.part).body) {
      const Vec3d own = rest(other).piece.places[hit.vertex - part(other).begin];
      if (squared_length(own - at) < std::pow(kNeighbours * skin.mean_edge, 2)) return {};
    }
    const SurfacePoint point = nearest_surface_point(skin, piece, hit.tet, at, way_in(hit));
    Contact contact{hit.vertex, {}, {}, 0, static_cast<float>(kReach * skin.mean_edge), hit.part, point.triangle};
    for (std::size_t i = 0; i < 3; ++i) {
      contact.corners[i] = part(hit.part).begin + skin.triangles[point.triangle][i];
      contact.weights[i] = static_cast<float>(point.weights[i]);
      if (contact.corners[i] == hit.vertex) return {};
    }
    contact.friction = static_cast<float>(std::sqrt(rest(other).material.friction * rest(hit.part).material.friction));
    return contact;
  }

  World& world_;
  const Progress nobody_;
  StageWatch watch_;
  PartPairs pairs_;
  std::vector<Contact> before_;
};

}  // namespace

void find_contacts(World& world, double horizon) {
  if (world.options.contacts != Contacts::None) Search(world, horizon).run();
}

}  // namespace tetsoup::simulate
