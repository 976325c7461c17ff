#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "base/elementary.h"
#include "base/parallel.h"
#include "base/vec.h"
#include "simulate/contact_constants.h"
#include "simulate/edge_contacts.h"
#include "simulate/part_pairs.h"
#include "simulate/world.h"

namespace tetsoup::simulate {
namespace {

constexpr std::size_t kGrain = 256;      ///< Vertices a task.
constexpr std::size_t kBoxGrain = 128;   ///< Groups of boxes a task.
constexpr std::int64_t kHitGrain = 128;  ///< Hits a task.
/// How far outside a tet's inner faces a vertex may lie, in its heights: edges of bodies stand on edges.
constexpr double kSlack = 0.02;

/// A vertex in a tet, or just outside one of its faces on the surface.
struct Hit {
  std::uint32_t vertex = 0, part = 0, tet = 0;
  float depth = 0;                 ///< Least barycentric coordinate: the higher, the more it is this tet's.
  std::array<float, 4> weights{};  ///< Barycentric.
};

class Search {
 public:
  Search(World& world, double horizon, StageWatch& watch)
      : world_(world), watch_(watch), pairs_(find_part_pairs(world, horizon, watch)) {}

  void run(Edges edges) {
    before_ = std::exchange(world_.contacts.between, {});
    try {
      world_.contacts.with_obstacles.clear();
      touch_obstacles();
      add_contacts(find_hits());
      if (edges == Edges::Find) cross_edges();
    } catch (...) {  // stopped half way: the next search goes on from what this one found
      world_.contacts.between = std::move(before_);
      throw;
    }
  }

 private:
  const Part& part(std::size_t p) const { return world_.parts[p]; }
  const Rest& rest(std::size_t p) const { return world_.rest_of(part(p)); }
  const RestSurface& surface(std::size_t p) const { return world_.surfaces[part(p).surface]; }
  Vec3 place(std::uint32_t slot) const { return to_vec(world_.places[slot]); }
  /// What lay so near at rest is not kept apart, m^2.
  double squared_neighbourhood(std::size_t p) const {
    return elementary::square(kNeighbours * rest(p).piece.mean_edge);
  }

  template <class Body>
  void for_parts(const Body& body) {
    parallel_for(static_cast<std::int64_t>(world_.parts.size()), 1, watch_,
                 [&](std::int64_t p, std::int64_t) { body(static_cast<std::size_t>(p)); });
  }

  template <class Tasks, class Body>
  void for_tasks(const Tasks& tasks, const Body& body) {
    parallel_for(static_cast<std::int64_t>(tasks.size()), 1, watch_,
                 [&](std::int64_t i, std::int64_t) { body(tasks[static_cast<std::size_t>(i)]); });
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
    return ObstacleContact{slot, to_float(clearance->normal), place(slot), static_cast<float>(clearance->distance),
                           static_cast<float>(std::sqrt(obstacle.friction * rest(p).material.friction))};
  }

  /// Some of a part's boxes: groups [begin, end) of the first level.
  struct BoxTask {
    std::size_t part = 0, begin = 0, end = 0;
  };

  /// The boxes around the tets of the parts that may meet something.
  void fit_boxes() {
    std::vector<BoxTask> tasks;
    for (std::size_t p = 0; p < world_.parts.size(); ++p) {
      if (pairs_.partners[p].empty()) continue;
      kernel::BoxTree& tree = world_.parts[p].boxes;
      if (tree.levels.empty()) tree = kernel::make_box_tree(surface(p).tet_order.size());
      for (std::size_t begin = 0, count = tree.levels[0].size(); begin < count; begin += kBoxGrain)
        tasks.push_back({p, begin, std::min(begin + kBoxGrain, count)});
    }
    for_tasks(tasks, [&](const BoxTask& task) { fit_first_level(task); });
    for_tasks(tasks, [&](const BoxTask& task) {
      if (task.begin == 0) kernel::fit_upper_levels(world_.parts[task.part].boxes);
    });
  }

  void fit_first_level(const BoxTask& task) {
    Part& owner = world_.parts[task.part];
    const std::vector<Tet>& tets = rest(task.part).piece.tets;
    const std::vector<std::uint32_t>& order = surface(task.part).tet_order;
    const std::size_t end = std::min(task.end * kernel::kBoxGroup, order.size());
    for (std::size_t i = task.begin * kernel::kBoxGroup; i < end; ++i) {
      Bounds box;
      for (const std::uint32_t v : tets[order[i]]) box.add(place(owner.begin + v));
      kernel::set_box(owner.boxes, i, box.lo, box.hi);
    }
  }

  /// Some of a part's vertices, and the part whose tets they may be in.
  struct Task {
    std::uint32_t part = 0;
    Partner other;
    std::size_t begin = 0, end = 0;  ///< Of the other's vertices at its surface.
  };
  template <class Count>
  std::vector<Task> list_tasks(const Count& count_of) const {
    std::vector<Task> tasks;
    for (std::uint32_t p = 0; p < world_.parts.size(); ++p)
      for (const Partner& q : pairs_.partners[p])
        for (std::size_t begin = 0, count = count_of(p, q.part); begin < count; begin += kGrain)
          tasks.push_back({p, q, begin, std::min(begin + kGrain, count)});
    return tasks;
  }

  /// Part after part; of each, vertices ascending.
  std::vector<Hit> find_hits() {
    fit_boxes();
    const std::vector<Task> tasks =
        list_tasks([&](std::uint32_t, std::uint32_t q) { return surface(q).vertices.size(); });
    std::vector<std::vector<Hit>> found(tasks.size());
    for_tasks(tasks, [&](const Task& task) { found[static_cast<std::size_t>(&task - tasks.data())] = hits_of(task); });
    std::vector<Hit> hits;
    for (const auto& some : found) hits.insert(hits.end(), some.begin(), some.end());
    return hits;
  }

  /// Of the tets that a vertex is in or before, only the one it is deepest in.
  std::vector<Hit> hits_of(const Task& task) const {
    const Bounds& bounds = pairs_.bounds[task.part];
    const Part& other = part(task.other.part);
    std::vector<kernel::NumberedPoint> points;
    for (std::size_t i = task.begin; i < task.end; ++i) {
      const std::uint32_t slot = other.begin + surface(task.other.part).vertices[i];
      if (!bounds.holds(place(slot), task.other.ahead)) continue;
      points.push_back({place(slot), slot, to_float(rest(task.other.part).piece.places[slot - other.begin])});
    }
    // Most tets that a vertex of the same body is in are its neighbours.
    const RestSurface& skin = surface(task.part);
    kernel::Neighbours neighbours;
    if (other.body == part(task.part).body)
      neighbours = {skin.middles, static_cast<float>(squared_neighbourhood(task.part))};
    std::vector<kernel::PointInBox> found;
    kernel::find_boxes_around(part(task.part).boxes, points, task.other.ahead, neighbours, found);
    std::vector<Hit> hits;
    for (const kernel::PointInBox& f : found) {
      const auto hit = hit_of(f.point, task, skin.tet_order[f.box]);
      if (!hit) continue;
      if (hits.empty() || hits.back().vertex != hit->vertex)
        hits.push_back(*hit);
      else if (hit->depth > hits.back().depth || (hit->depth == hits.back().depth && hit->tet < hits.back().tet))
        hits.back() = *hit;
    }
    std::erase_if(hits, [&](const Hit& hit) { return is_between_neighbours(hit); });
    return hits;
  }

  std::optional<Hit> hit_of(std::uint32_t vertex, const Task& task, std::uint32_t t) const {
    const Part& owner = part(task.part);
    const Tet& tet = rest(task.part).piece.tets[t];
    TetCorners corners;
    for (std::size_t i = 0; i < 4; ++i) {
      if (owner.begin + tet[i] == vertex) return {};
      corners[i] = world_.place(owner.begin + tet[i]);
    }
    const double six_volumes = 6 * signed_volume(corners);
    if (!(six_volumes > 0)) return {};
    const auto ahead = static_cast<double>(task.other.ahead);
    const Vec3d at = world_.place(vertex);
    Hit hit{vertex, task.part, t, 1, {}};
    for (std::size_t i = 0; i < 4; ++i) {
      // Most tets are left at their first or second face, so nothing is divided before.
      const Vec3d normal = inward_normal(corners, i);
      const double height = dot(normal, at - corners[(i + 1) % 4]);
      const bool open = (surface(task.part).open_faces[t] >> i & 1U) != 0;
      if (height < (open ? -ahead * length(normal) : -kSlack * six_volumes)) return {};
      hit.weights[i] = static_cast<float>(height / six_volumes);
      hit.depth = std::min(hit.depth, hit.weights[i]);
    }
    return hit;
  }

  void add_contacts(const std::vector<Hit>& hits) {
    std::vector<TetOfPart> tets;
    for (const Hit& hit : hits) tets.emplace_back(hit.part, hit.tet);
    find_near_triangles_of(tets);
    std::vector<std::optional<Contact>> contacts(hits.size());
    parallel_for(static_cast<std::int64_t>(hits.size()), kHitGrain, watch_, [&](std::int64_t begin, std::int64_t end) {
      for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i)
        contacts[i] = contact_of(hits[i]);
    });
    for (const auto& contact : contacts)
      if (contact) world_.contacts.between.push_back(*contact);
  }

  using TetOfPart = std::pair<std::uint32_t, std::uint32_t>;

  /// Of the tets that are hit for the first time.
  void find_near_triangles_of(std::vector<TetOfPart> missing) {
    std::erase_if(missing, [&](const TetOfPart& m) { return !surface(m.first).near[m.second].triangles.empty(); });
    const auto key = [&](const auto& m) { return std::pair(part(m.first).surface, m.second); };
    std::sort(missing.begin(), missing.end(), [&](const auto& a, const auto& b) { return key(a) < key(b); });
    const auto is_same = [&](const auto& a, const auto& b) { return key(a) == key(b); };
    missing.erase(std::unique(missing.begin(), missing.end(), is_same), missing.end());
    for_tasks(missing, [&](const auto& m) {
      find_near_triangles(world_.surfaces[part(m.first).surface], rest(m.first).piece, m.second);
    });
  }

  /// Edges of other bodies.
  void cross_edges() {
    world_.contacts.across.clear();
    const std::vector<Task> tasks = list_tasks([&](std::uint32_t p, std::uint32_t q) {
      return part(p).body != part(q).body ? surface(q).sharp_edges.size() : 0;
    });
    std::vector<std::vector<EdgeHit>> found(tasks.size());
    for_tasks(tasks, [&](const Task& task) {
      found[static_cast<std::size_t>(&task - tasks.data())] =
          find_edge_hits(world_, pairs_, task.part, task.other.part, task.begin, task.end);
    });
    std::vector<TetOfPart> tets;
    for (const auto& some : found)
      for (const EdgeHit& hit : some)
        for (const EdgePlace& p : {hit.in, hit.out, hit.middle}) tets.emplace_back(hit.part, p.tet);
    find_near_triangles_of(std::move(tets));
    for (const auto& some : found)
      for (const EdgeHit& hit : some) add_edge_contacts(world_, hit);
  }

  /// The side through which the vertex was kept out of the part until now.
  std::optional<Vec3d> way_in(const Hit& hit) const {
    const auto key = std::pair(hit.part, hit.vertex);
    const auto at = std::lower_bound(before_.begin(), before_.end(), key, [](const Contact& c, const auto& wanted) {
      return std::pair(c.part, c.vertex) < wanted;
    });
    if (at == before_.end() || std::pair(at->part, at->vertex) != key) return {};
    return surface(hit.part).normals[at->triangle];
  }

  /// Where a hit's point is when the part is at rest.
  Vec3d rest_place_of(const Hit& hit) const {
    const Piece& piece = rest(hit.part).piece;
    Vec3d at;
    for (std::size_t i = 0; i < 4; ++i)
      at += piece.places[piece.tets[hit.tet][i]] * static_cast<double>(hit.weights[i]);
    return at;
  }

  /// Whether vertex and point lay near each other at rest.
  bool is_between_neighbours(const Hit& hit) const {
    const Part& other = part(world_.owners[hit.vertex]);
    if (other.body != part(hit.part).body) return false;
    const Vec3d own = rest(world_.owners[hit.vertex]).piece.places[hit.vertex - other.begin];
    return squared_length(own - rest_place_of(hit)) < squared_neighbourhood(hit.part);
  }

  std::optional<Contact> contact_of(const Hit& hit) const {
    const Piece& piece = rest(hit.part).piece;
    const RestSurface& skin = surface(hit.part);
    const std::uint32_t other = world_.owners[hit.vertex];
    const SurfacePoint point = nearest_surface_point(skin, piece, hit.tet, rest_place_of(hit), way_in(hit));
    Contact contact{hit.vertex, {}, {}, 0, static_cast<float>(kReach * piece.mean_edge), hit.part, point.triangle};
    for (std::size_t i = 0; i < 3; ++i) {
      contact.corners[i] = part(hit.part).begin + skin.triangles[point.triangle][i];
      contact.weights[i] = static_cast<float>(point.weights[i]);
      if (contact.corners[i] == hit.vertex) return {};
    }
    contact.friction = static_cast<float>(std::sqrt(rest(other).material.friction * rest(hit.part).material.friction));
    return contact;
  }

  World& world_;
  StageWatch& watch_;
  PartPairs pairs_;
  std::vector<Contact> before_;
};

}  // namespace

void find_contacts(World& world, double horizon, Edges edges, StageWatch& watch) {
  if (world.options.contacts != Contacts::None) Search(world, horizon, watch).run(edges);
}

}  // namespace tetsoup::simulate
