#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <utility>

#include "base/groups.h"
#include "base/require.h"
#include "base/tet_faces.h"
#include "base/tet_geometry.h"
#include "base/triangle_samples.h"
#include "regions/label_places.h"
#include "regions/remove_edges.h"
#include "tetsoup/regions.h"

namespace tetsoup {
namespace {

constexpr int kPasses = 8;
constexpr int kFirstRemoval = 2, kSecondRemoval = 5;  // Passes before which crossing edges are removed.
constexpr std::int64_t kGrain = 16;                   // faces
constexpr double kReach = 0.6;        // Mean edges: a border may lie halfway between two layers of cells.
constexpr int kStepsInReach = 8;      // A layer thinner than a tenth of an edge may be missed.
constexpr int kHalvings = 6;          // Of a step: to .002 edges.
constexpr double kLeastCosine = 0.3;  // Between the way searched and a surface's normal, below which it is not that.

constexpr std::array<std::array<double, 3>, 3> kCornerWeights{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};

// A border's area, times a mean edge, against the volume that is labelled wrongly: spikes of single tets are given up,
// since their corners cannot all come to lie on the border.
constexpr double kEvening = 0.03;
constexpr int kEvenings = 4;     // Rounds; nearly all changes come in the first.
constexpr int kBalancings = 8;   // Of the labels' volumes; the best counts.
constexpr double kMostLack = 4;  // What a label's shares count for more or less is changed by its root at most.

/// A face between tets of two labels, seen from the lower one.
struct BorderFace {
  Triangle corners{};
  std::uint32_t behind = 0, ahead = 0;
};

struct Neighbour {
  std::uint32_t tet;
  double area;  ///< Of the face between.
};

double face_area(const TetMesh& mesh, const Triangle& t) {
  const Vec3d a = to_double(mesh.vertices[t[0]]);
  return length(cross(to_double(mesh.vertices[t[1]]) - a, to_double(mesh.vertices[t[2]]) - a)) / 2;
}

Groups<Neighbour> neighbours_of(const TetMesh& mesh, const std::vector<TetFace>& faces) {
  return {mesh.tets.size(), [&](const auto& put) {
            for (std::size_t begin = 0, end = 0; begin < faces.size(); begin = end) {
              end = face_run_end(faces, begin);
              if (end - begin != 2) continue;
              const auto one = static_cast<std::uint32_t>(faces[begin].slot / 4),
                         other = static_cast<std::uint32_t>(faces[begin + 1].slot / 4);
              const double area = face_area(mesh, faces[begin].corners);
              put(one, Neighbour{other, area});
              put(other, Neighbour{one, area});
            }
          }};
}

/// Which label each tet is to have.
class Labelling {
 public:
  Labelling(const TetMesh& mesh, const std::vector<TetFace>& faces, const TetLabels& shares, double edge)
      : shares_(shares), edge_(edge), neighbours_(neighbours_of(mesh, faces)) {
    for (const Tet& tet : mesh.tets) volumes_.push_back(signed_volume(corners_of(mesh, tet)));
    for (std::size_t t = 0; t < shares.size(); ++t)
      for (const LabelShare& s : shares[t]) weights_[s.label] = 1;
  }

  /// That of which it has most, where that does not make the border longer than it is worth. A part narrower than some
  /// tets fills few of them by half: so what a label's tets lack of its volume makes its shares count for more.
  std::vector<std::uint32_t> find() {
    const std::map<std::uint32_t, double> wanted = volumes(nullptr);
    std::vector<std::uint32_t> best;
    double least = std::numeric_limits<double>::infinity();
    for (int round = 0; round < kBalancings; ++round) {
      const std::vector<std::uint32_t> labels = evened();
      std::map<std::uint32_t, double> got = volumes(&labels);
      double miss = 0;
      for (const auto& [label, volume] : wanted) {
        miss += std::abs(got[label] - volume);
        const double lack = volume / std::max(got[label], volume / kMostLack);
        weights_[label] *= std::sqrt(std::max(lack, 1 / kMostLack));
      }
      if (miss < least) least = miss, best = labels;
    }
    return best;
  }

 private:
  double cost(std::size_t t, const LabelShare& s, const std::vector<std::uint32_t>& labels) const {
    double sum = -volumes_[t] * static_cast<double>(s.share) * weights_.at(s.label);
    for (const Neighbour& n : neighbours_[t])
      if (labels[n.tet] != s.label) sum += kEvening * edge_ * n.area;
    return sum;
  }

  std::vector<std::uint32_t> evened() const {
    std::vector<std::uint32_t> labels = largest_of(shares_);
    for (int round = 0; round < kEvenings; ++round) {
      for (std::size_t t = 0; t < labels.size(); ++t) {
        if (shares_[t].size() < 2) continue;
        double least = std::numeric_limits<double>::infinity();
        std::uint32_t choice = labels[t];
        for (const LabelShare& s : shares_[t])
          if (const double c = cost(t, s, labels); c < least) least = c, choice = s.label;
        labels[t] = choice;
      }
    }
    return labels;
  }

  /// Of every label: of the tets that have it, or of its shares.
  std::map<std::uint32_t, double> volumes(const std::vector<std::uint32_t>* labels) const {
    std::map<std::uint32_t, double> sum;
    for (std::size_t t = 0; t < volumes_.size(); ++t) {
      if (labels != nullptr) {
        sum[(*labels)[t]] += volumes_[t];
        continue;
      }
      for (const LabelShare& s : shares_[t]) sum[s.label] += volumes_[t] * static_cast<double>(s.share);
    }
    return sum;
  }

  const TetLabels& shares_;
  double edge_;
  Groups<Neighbour> neighbours_;
  std::vector<double> volumes_;
  std::map<std::uint32_t, double> weights_;
};

std::vector<BorderFace> border_faces(const TetMesh& mesh, const std::vector<TetFace>& faces,
                                     const std::vector<std::uint32_t>& labels) {
  std::vector<BorderFace> border;
  for (std::size_t begin = 0, end = 0; begin < faces.size(); begin = end) {
    end = face_run_end(faces, begin);
    if (end - begin != 2) continue;
    const auto label = [&](std::size_t i) { return labels[static_cast<std::size_t>(faces[i].slot / 4)]; };
    const std::size_t low = label(begin) < label(begin + 1) ? begin : begin + 1, high = 2 * begin + 1 - low;
    if (label(low) != label(high)) border.push_back({face_at(mesh, faces[low].slot), label(low), label(high)});
  }
  return border;
}

class BorderAims {
 public:
  BorderAims(const TetMesh& mesh, const LabelPlaces& places, const Vec3d& shift, double edge)
      : mesh_(mesh), places_(places), shift_(shift), reach_(kReach * edge) {}

  std::vector<FaceAim> find(const std::vector<BorderFace>& faces, StageWatch& watch) {
    add_up_normals(faces);
    std::vector<std::optional<FaceAim>> found(faces.size() * kSamples);
    parallel_for(static_cast<std::int64_t>(faces.size()), kGrain, watch, [&](std::int64_t begin, std::int64_t end) {
      for (auto f = static_cast<std::size_t>(begin); f < static_cast<std::size_t>(end); ++f)
        for (std::size_t s = 0; s < kSamples; ++s) found[kSamples * f + s] = aim_of(faces[f], kSampleWeights[s]);
    });
    std::vector<FaceAim> aims;
    for (const auto& aim : found)
      if (aim) aims.push_back(*aim);
    return aims;
  }

 private:
  using Corner = std::array<std::uint32_t, 3>;  ///< Vertex and the two labels.

  Vec3d at(std::uint32_t v) const { return to_double(mesh_.vertices[v]); }
  Vec3d area_normal(const Triangle& t) const { return cross(at(t[1]) - at(t[0]), at(t[2]) - at(t[0])); }

  void add_up_normals(const std::vector<BorderFace>& faces) {
    for (const BorderFace& face : faces)
      for (const std::uint32_t v : face.corners) normals_[{v, face.behind, face.ahead}] += area_normal(face.corners);
  }

  std::optional<FaceAim> aim_of(const BorderFace& face, const std::array<double, 3>& weights) const {
    FaceAim aim{face.corners, weights, {}, 0, length(area_normal(face.corners)) / 2 / kSamples};
    Vec3d from, normal;
    for (std::size_t i = 0; i < 3; ++i) {
      from += at(face.corners[i]) * weights[i];
      normal += normals_.at({face.corners[i], face.behind, face.ahead}) * weights[i];
    }
    if (!(length(normal) > 0)) return std::nullopt;
    normal = normal * (1 / length(normal));
    const auto way = way_to_border(from + shift_, normal, face);
    if (!way) return std::nullopt;
    const Vec3d on_border = from + normal * *way;
    aim.normal = normal;
    if (auto surface = places_.normal_near(on_border + shift_)) {
      const double cosine = dot(*surface, normal);
      if (std::abs(cosine) > kLeastCosine) aim.normal = *surface * (cosine < 0 ? -1 : 1);
    }
    aim.offset = dot(aim.normal, on_border);
    return aim;
  }

  /// Along the normal from where one of the two labels is to where it ends.
  std::optional<double> way_to_border(const Vec3d& from, const Vec3d& normal, const BorderFace& face) const {
    const std::uint32_t here = places_.at(from);
    if (here != face.behind && here != face.ahead) return std::nullopt;
    const Vec3d along = normal * (here == face.behind ? reach_ : -reach_);
    double same = 0, other = 0;
    for (int step = 1; step <= kStepsInReach; ++step) {
      other = static_cast<double>(step) / kStepsInReach;
      if (places_.at(from + along * other) != here) break;
      same = other;
    }
    if (same == other) return std::nullopt;
    for (int i = 0; i < kHalvings; ++i) {
      const double middle = (same + other) / 2;
      (places_.at(from + along * middle) == here ? same : other) = middle;
    }
    return (same + other) / 2 * (here == face.behind ? reach_ : -reach_);
  }

  const TetMesh& mesh_;
  const LabelPlaces& places_;
  Vec3d shift_;
  double reach_;
  std::map<Corner, Vec3d> normals_;
};

/// The boundary may slide along itself, but not leave its planes.
std::vector<FaceAim> hold_boundary(const TetMesh& mesh, const std::vector<TetFace>& faces) {
  std::vector<FaceAim> aims;
  for (const Triangle& t : lone_faces(mesh, faces)) {
    const Vec3d a = to_double(mesh.vertices[t[0]]);
    const Vec3d normal = cross(to_double(mesh.vertices[t[1]]) - a, to_double(mesh.vertices[t[2]]) - a);
    const double size = length(normal);
    if (!(size > 0)) continue;
    const Vec3d unit = normal * (1 / size);
    for (const auto& corner : kCornerWeights) aims.push_back({t, corner, unit, dot(unit, a), size / 2});
  }
  return aims;
}

double mean_edge(const TetMesh& mesh) {
  double sum = 0;
  for (const Tet& tet : mesh.tets) {
    const TetCorners p = corners_of(mesh, tet);
    for (const auto& [a, b] : kTetEdges) sum += length(p[static_cast<std::size_t>(a)] - p[static_cast<std::size_t>(b)]);
  }
  return sum / (6 * static_cast<double>(mesh.tets.size()));
}

}  // namespace

TetMesh fit_to_labels(const TetMesh& mesh, const TriangleSoup& soup, std::span<const std::uint32_t> labels,
                      const SmoothOptions& options, const Progress& progress) {
  require(labels.size() == soup.triangles.size(), "number of labels", labels.size(), "that of the triangles");
  StageWatch watch(progress, "regions");
  const LabelPlaces places(soup, labels, watch);
  if (!places.has_closed() || mesh.tets.empty()) return mesh;
  const Vec3d shift = mesh.origin - soup.origin;
  const double edge = mean_edge(mesh);
  const auto goes_on = [&](std::string_view, double) {
    watch.poll();
    return !watch.stopped();
  };
  const std::vector<FaceAim> held = hold_boundary(mesh, sorted_faces(mesh));
  TetMesh fitted = mesh;
  for (int pass = 0; pass < kPasses; ++pass) {
    watch.enter_part(static_cast<double>(pass) / kPasses, static_cast<double>(pass + 1) / kPasses);
    TetLabels shares = share_tets(fitted, places, shift, watch);
    if (pass == kFirstRemoval || pass == kSecondRemoval) {
      const auto ask = [&](const Tet& tet) { return share_tet(corners_of(fitted, tet), places, shift); };
      if (remove_crossing_edges(fitted, shares, options, ask) > 0) shares = share_tets(fitted, places, shift, watch);
    }
    const std::vector<TetFace> faces = sorted_faces(fitted);
    const std::vector<BorderFace> border = border_faces(fitted, faces, Labelling(fitted, faces, shares, edge).find());
    if (border.empty()) return fitted;
    std::vector<FaceAim> aims = BorderAims(fitted, places, shift, edge).find(border, watch);
    aims.insert(aims.end(), held.begin(), held.end());
    fitted = draw_faces(fitted, aims, options, goes_on);
  }
  return fitted;
}

}  // namespace tetsoup
