#include "embed/own_copy.h"

#include <algorithm>
#include <iterator>

#include "base/groups.h"
#include "base/merge_vertices.h"
#include "base/unions.h"
#include "embed/tet_walk.h"

namespace tetsoup {
namespace {

/// A cluster returns its guests if it is this many times as large: of loose leaves with a few points each none is the
/// host.
constexpr std::size_t kHostSize = 4;

/// Heights of a tet: nearer than this to its own piece's tets a guest is moved there; farther off that piece has no
/// tets around it, and the guest stays.
constexpr double kNear = 1;

constexpr std::int64_t kGrain = 1024;  // tets or triangles

std::vector<Triangle> usable_triangles(const TriangleSoup& soup) {
  std::vector<Triangle> triangles;
  std::copy_if(soup.triangles.begin(), soup.triangles.end(), std::back_inserter(triangles),
               [&](const Triangle& t) { return is_usable(soup, t); });
  return triangles;
}

/// Nodes are the soup's distinct positions.
class OwnCopies {
 public:
  OwnCopies(const TetMesh& mesh, const TriangleSoup& soup, const TetFinder& finder, std::vector<std::uint32_t>& tets,
            StageWatch& watch)
      : mesh_(mesh), finder_(finder), walk_(mesh), point_tets_(tets), triangles_(usable_triangles(soup)) {
    merged_ = merge_vertices(soup.vertices, triangles_);
    const std::size_t count = merged_.positions.size();
    tets_.resize(count);
    for (std::size_t i = 0; i < tets.size(); ++i)
      if (merged_.names[i] != MergedVertices::kUnused) tets_[merged_.names[i]] = tets[i];
    settled_.resize(count);
    const auto left =
        parallel_sum<int>(static_cast<std::int64_t>(count), kGrain, watch, [&](std::int64_t begin, std::int64_t end) {
          int outside = 0;
          for (auto v = static_cast<std::uint32_t>(begin); v < static_cast<std::uint32_t>(end); ++v) {
            settled_[v] = !finder.is_in_several(place(v));
            outside += !finder.holds(tets_[v], place(v));
          }
          return outside;
        });
    encloses_ = left == 0;
  }

  std::size_t run() {
    unsettle_guests();
    spread();
    std::size_t changed = 0;
    for (std::size_t i = 0; i < point_tets_.size(); ++i) {
      const std::uint32_t name = merged_.names[i];
      if (name == MergedVertices::kUnused || tets_[name] == point_tets_[i]) continue;
      point_tets_[i] = tets_[name];
      ++changed;
    }
    return changed;
  }

 private:
  Vec3d place(std::uint32_t node) const { return to_double(merged_.positions[node]); }

  template <class Visit>
  void for_each_edge(const Visit& visit) const {
    for (const auto& [a, b, c] : triangles_) visit(a, b), visit(b, c), visit(c, a);
  }

  void unsettle_guests() {
    Unions pieces(tets_.size()), clusters(tets_.size());
    for_each_edge([&](std::uint32_t a, std::uint32_t b) {
      pieces.join(a, b);
      if (settled_[a] == 0 || settled_[b] == 0 || clusters.find(a) == clusters.find(b)) return;
      if (walk_.leads(tets_[a], tets_[b], place(a), place(b))) clusters.join(a, b);
    });
    std::vector<std::size_t> size(tets_.size(), 0), largest(tets_.size(), kNobody),
        home(mesh_.vertices.size(), kNobody);
    for (std::size_t v = 0; v < tets_.size(); ++v) size[clusters.find(v)] += settled_[v];
    const auto take_larger = [&](std::size_t& best, std::size_t cluster) {
      if (best == kNobody || size[cluster] > size[best]) best = cluster;
    };
    for (std::size_t v = 0; v < tets_.size(); ++v) {
      if (settled_[v] == 0) continue;
      take_larger(largest[pieces.find(v)], clusters.find(v));
      for (const std::uint32_t corner : mesh_.tets[tets_[v]]) take_larger(home[corner], clusters.find(v));
    }
    std::vector<std::size_t> guests(tets_.size(), 0);  // of every cluster, those in a larger one's tets
    for (std::size_t v = 0; v < tets_.size(); ++v) {
      if (settled_[v] == 0) continue;
      const Tet& tet = mesh_.tets[tets_[v]];
      const std::size_t cluster = clusters.find(v);
      guests[cluster] +=
          std::any_of(tet.begin(), tet.end(), [&](std::uint32_t corner) { return size[home[corner]] > size[cluster]; });
    }
    for (std::size_t v = 0; v < tets_.size(); ++v) {
      const std::size_t cluster = clusters.find(v);
      const std::size_t host = largest[pieces.find(v)];
      if (host == kNobody || size[host] < kHostSize * size[cluster]) continue;
      if (2 * guests[cluster] > size[cluster]) settled_[v] = 0;
    }
  }

  /// From the settled nodes to the others, breadth first; what nothing reaches starts anew where it is.
  void spread() {
    neighbours_ = Groups<std::uint32_t>(tets_.size(), [&](const auto& put) {
      for_each_edge([&](std::uint32_t a, std::uint32_t b) {
        if (settled_[b] == 0) put(a, b);
        if (settled_[a] == 0) put(b, a);
      });
    });
    std::vector<std::uint32_t> queue;
    for (std::uint32_t v = 0; v < settled_.size(); ++v)
      if (settled_[v] != 0 && !neighbours_[v].empty()) queue.push_back(v);
    std::size_t next = 0;
    for (std::uint32_t start = 0;; ++start) {
      for (; next < queue.size(); ++next) settle_neighbours(queue[next], queue);
      while (start < settled_.size() && settled_[start] != 0) ++start;
      if (start >= settled_.size()) return;
      settled_[start] = 1;
      queue.push_back(start);
    }
  }

  void settle_neighbours(std::uint32_t node, std::vector<std::uint32_t>& queue) {
    for (const std::uint32_t other : neighbours_[node]) {
      if (settled_[other] != 0) continue;
      const std::uint32_t tet = walk_.best_at_end(tets_[node], place(node), place(other));
      const bool fits = encloses_ ? finder_.holds(tet, place(other))
                                  : least_weight(corners_of(mesh_, mesh_.tets[tet]), place(other)) >= -kNear;
      if (!fits) continue;
      tets_[other] = tet;
      settled_[other] = 1;
      queue.push_back(other);
    }
  }

  static constexpr std::size_t kNobody = static_cast<std::size_t>(-1);

  const TetMesh& mesh_;
  const TetFinder& finder_;
  bool encloses_ = true;
  TetWalk walk_;
  std::vector<std::uint32_t>& point_tets_;
  std::vector<Triangle> triangles_;
  MergedVertices merged_;
  std::vector<std::uint32_t> tets_;   ///< Of every node.
  Groups<std::uint32_t> neighbours_;  ///< Of every node, those that are to be settled.
  std::vector<std::uint8_t> settled_;
};

bool overlaps_itself(const TetMesh& mesh, const TetFinder& finder, StageWatch& watch) {
  const auto count = static_cast<std::int64_t>(mesh.tets.size());
  return parallel_sum<int>(count, kGrain, watch, [&](std::int64_t begin, std::int64_t end) {
           int several = 0;
           for (auto t = static_cast<std::size_t>(begin); t < static_cast<std::size_t>(end); ++t) {
             const TetCorners p = corners_of(mesh, mesh.tets[t]);
             several += finder.is_in_several((p[0] + p[1] + p[2] + p[3]) * 0.25);
           }
           return several;
         }) > 0;
}

/// Edges of a chunk of triangles, in order.
struct Edges {
  std::vector<std::array<std::uint32_t, 2>> items;
  Edges& operator+=(const Edges& other) {
    items.insert(items.end(), other.items.begin(), other.items.end());
    return *this;
  }
};

/// Whether the tets of a triangle's corners do not hang together; few triangles need a walk to tell.
bool cuts_a_triangle(const TetMesh& mesh, const TriangleSoup& soup, const std::vector<std::uint32_t>& tets,
                     StageWatch& watch) {
  const auto count = static_cast<std::int64_t>(soup.triangles.size());
  const Edges open = parallel_sum<Edges>(count, kGrain, watch, [&](std::int64_t begin, std::int64_t end) {
    Edges edges;
    for (auto t = static_cast<std::size_t>(begin); t < static_cast<std::size_t>(end); ++t) {
      const Triangle& triangle = soup.triangles[t];
      if (!is_usable(soup, triangle)) continue;
      for (std::size_t i = 0; i < 3; ++i) {
        const std::uint32_t a = triangle[i], b = triangle[(i + 1) % 3];
        if (!share_a_vertex(mesh.tets[tets[a]], mesh.tets[tets[b]])) edges.items.push_back({a, b});
      }
    }
    return edges;
  });
  if (open.items.empty()) return false;
  TetWalk walk(mesh);
  return std::any_of(open.items.begin(), open.items.end(), [&](const auto& edge) {
    const auto [a, b] = edge;
    return !walk.leads(tets[a], tets[b], to_double(soup.vertices[a]), to_double(soup.vertices[b]));
  });
}

}  // namespace

bool needs_own_copies(const TetMesh& mesh, const TriangleSoup& soup, const TetFinder& finder,
                      const std::vector<std::uint32_t>& tets, StageWatch& watch) {
  return overlaps_itself(mesh, finder, watch) || cuts_a_triangle(mesh, soup, tets, watch);
}

std::size_t move_to_own_copies(const TetMesh& mesh, const TriangleSoup& soup, const TetFinder& finder,
                               std::vector<std::uint32_t>& tets, StageWatch& watch) {
  return OwnCopies(mesh, soup, finder, tets, watch).run();
}

}  // namespace tetsoup
