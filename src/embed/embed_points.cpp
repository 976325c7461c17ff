#include "tetsoup/embed.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "base/origin.h"
#include "base/require.h"
#include "base/tet_faces.h"
#include "embed/own_copy.h"
#include "embed/tet_finder.h"

namespace tetsoup {
namespace {

constexpr std::int64_t kGrain = 1024;  // points

/// Of a weight: what a tet holds may lie this far beyond a face, in its height; in slivers that is not rounding.
constexpr double kRounding = 1e-3;

void require_usable(const TetMesh& mesh, const EmbedOptions& options) {
  require(options.max_extrapolation >= 0, "max_extrapolation", options.max_extrapolation, "at least 0");
  bool some = false;
  for (const Tet& tet : mesh.tets) {
    for (const std::uint32_t v : tet) {
      require(v < mesh.vertices.size(), "vertex of a tet", v, "below the number of vertices");
      if (!is_finite(mesh.vertices[v]))
        throw InvalidInput("vertex " + std::to_string(v) + " of the mesh is not finite");
    }
    some = some || is_valid_tet(tet, mesh.vertices.size());
  }
  if (!some) throw InvalidInput("the mesh has no tet to hang a point on");
}

struct Place {
  std::array<double, 4> weights{1, 0, 0, 0};
  double distance = 0;
  bool drawn_closer = false;
};

/// The point of the tet that is nearest to a point outside.
Vec3d closest_on_tet(const TetCorners& tet, const Vec3d& point) {
  Vec3d best = tet[0];
  for (const auto& face : kTetFaces) {
    const auto corner = [&](std::size_t i) { return tet[static_cast<std::size_t>(face[i])]; };
    const Vec3d closest = closest_on_triangle({corner(0), corner(1), corner(2)}, point);
    if (squared_length(closest - point) < squared_length(best - point)) best = closest;
  }
  return best;
}

/// Where the ray from `at` through `beyond`, both barycentric, is `most` heights of the tet beyond a face.
double reach(const std::array<double, 4>& at, const std::array<double, 4>& beyond, double most) {
  double share = 1;
  for (std::size_t i = 0; i < 4; ++i)
    if (beyond[i] < -most) share = std::min(share, (at[i] + most) / (at[i] - beyond[i]));
  return share;
}

bool is_finite(const std::array<double, 4>& weights) {
  return std::all_of(weights.begin(), weights.end(), [](double w) { return std::isfinite(w); });
}

/// Weights of a point in a tet that it lies outside of.
Place place_outside(const TetCorners& tet, const Vec3d& point, double max_extrapolation) {
  const Vec3d closest = closest_on_tet(tet, point);
  Place place;
  place.distance = length(point - closest);
  const auto at = barycentric(tet, closest), beyond = barycentric(tet, point);
  if (!is_finite(at) || !is_finite(beyond)) {  // The tet is flat: the corner next to it.
    std::size_t nearest = 0;
    for (std::size_t i = 1; i < 4; ++i)
      if (squared_length(tet[i] - closest) < squared_length(tet[nearest] - closest)) nearest = i;
    place.weights = {};
    place.weights[nearest] = 1;
    place.drawn_closer = true;
    return place;
  }
  const double share = reach(at, beyond, max_extrapolation);
  place.drawn_closer = share < 1;
  for (std::size_t i = 0; i < 4; ++i) place.weights[i] = share < 1 ? at[i] + share * (beyond[i] - at[i]) : beyond[i];
  return place;
}

class Embedder {
 public:
  Embedder(const TetMesh& mesh, const TriangleSoup& soup, const EmbedOptions& options, StageWatch& watch)
      : mesh_(mesh),
        soup_(soup),
        options_(options),
        watch_(watch),
        finder_(mesh, watch),
        outside_(soup.vertices.size()) {
    embedding_.tets.resize(soup.vertices.size());
    embedding_.weights.resize(soup.vertices.size());
    embedding_.distances.resize(soup.vertices.size());
  }

  Embedding run() {
    watch_.enter_part(0, 0.7);
    parallel_for(static_cast<std::int64_t>(soup_.vertices.size()), kGrain, watch_,
                 [&](std::int64_t begin, std::int64_t end) {
                   std::uint32_t near = 0;  // Neighbours in the file are neighbours in space, most often.
                   for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i)
                     embedding_.tets[i] = find_tet(i, near);
                 });
    if (needs_own_copies(mesh_, soup_, finder_, embedding_.tets, watch_))
      embedding_.report.other_copy = move_to_own_copies(mesh_, soup_, finder_, embedding_.tets, watch_);
    watch_.enter_part(0.7, 1);
    for_each_point([&](std::size_t i) { weigh(i); });
    count();
    return std::move(embedding_);
  }

 private:
  template <class Body>
  void for_each_point(const Body& body) {
    parallel_for(static_cast<std::int64_t>(soup_.vertices.size()), kGrain, watch_,
                 [&](std::int64_t begin, std::int64_t end) {
                   for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i) body(i);
                 });
  }

  std::uint32_t find_tet(std::size_t i, std::uint32_t& near) const {
    if (!is_finite(soup_.vertices[i])) return 0;
    const Vec3d point = to_double(soup_.vertices[i]);
    const std::uint32_t holder = finder_.holder(point);
    return holder != TetFinder::kNone ? holder : finder_.nearest(point, near);
  }

  void weigh(std::size_t i) {
    if (!is_finite(soup_.vertices[i])) {
      embedding_.weights[i] = {1, 0, 0, 0};
      embedding_.distances[i] = std::numeric_limits<float>::infinity();
      return;
    }
    const Vec3d point = to_double(soup_.vertices[i]);
    const TetCorners tet = corners_of(mesh_, mesh_.tets[embedding_.tets[i]]);
    Place place;
    if (finder_.holds(embedding_.tets[i], point) && least_weight(tet, point) > -kRounding) {
      place.weights = barycentric(tet, point);
    } else {
      place = place_outside(tet, point, options_.max_extrapolation);
    }
    outside_[i] = place.distance > 0 ? (place.drawn_closer ? kDrawn : kOutside) : kInside;
    const auto w1 = static_cast<float>(place.weights[1]), w2 = static_cast<float>(place.weights[2]),
               w3 = static_cast<float>(place.weights[3]);
    const double w0 = 1 - (double{w1} + double{w2} + double{w3});  // The sum is 1, as near as floats come.
    embedding_.weights[i] = {static_cast<float>(w0), w1, w2, w3};
    embedding_.distances[i] = static_cast<float>(place.distance);
  }

  void count() {
    EmbedReport& report = embedding_.report;
    for (std::size_t i = 0; i < outside_.size(); ++i) {
      if (!is_finite(soup_.vertices[i])) {
        ++report.non_finite;
        continue;
      }
      report.inside += outside_[i] == kInside;
      report.outside += outside_[i] != kInside;
      report.drawn_closer += outside_[i] == kDrawn;
      report.max_distance = std::max<double>(report.max_distance, embedding_.distances[i]);
    }
  }

  static constexpr std::uint8_t kInside = 0, kOutside = 1, kDrawn = 2;

  const TetMesh& mesh_;
  const TriangleSoup& soup_;
  const EmbedOptions& options_;
  StageWatch& watch_;
  TetFinder finder_;
  std::vector<std::uint8_t> outside_;
  Embedding embedding_;
};

}  // namespace

Embedding embed_points(const TetMesh& mesh, const TriangleSoup& soup, const EmbedOptions& options,
                       const Progress& progress) {
  require_usable(mesh, options);
  StageWatch watch(progress, "embed");
  if (soup.origin == mesh.origin) return Embedder(mesh, soup, options, watch).run();
  const TriangleSoup near{recounted(soup.vertices, soup.origin, mesh.origin), soup.triangles, mesh.origin};
  return Embedder(mesh, near, options, watch).run();
}

}  // namespace tetsoup
