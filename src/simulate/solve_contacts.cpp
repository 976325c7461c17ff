#include <algorithm>
#include <cmath>

#include "base/elementary.h"
#include "simulate/world.h"

namespace tetsoup::simulate {
namespace {

/// Time in which a depth is mostly undone, s: fast to the eye, slow beside a substep, so nothing pops.
constexpr double kPushTime = 0.02;
/// However deep, a vertex is not pushed out faster than this, m/s.
constexpr double kPushSpeed = 2;

struct V {
  float x, y, z;
};
V operator+(const V& a, const V& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
V operator-(const V& a, const V& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
V operator*(const V& a, float s) {
  return {a.x * s, a.y * s, a.z * s};
}
float dot(const V& a, const V& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
V cross(const V& a, const V& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// Places, their displacements in this substep, and how to change both.
class Movers {
 public:
  Movers(World& world, double h)
      : world_(world), moves_(world.moves), motions_(world.motions), rate_(static_cast<float>(1 / h)) {}

  /// Where it was when the substep began, seen from the float of another vertex's place, so that it is exact.
  V start(std::uint32_t v, std::uint32_t from) const {
    const kernel::Place &p = world_.places[v], &f = world_.places[from];
    const kernel::Offset& r = world_.remainders[v];
    return V{p.x - f.x, p.y - f.y, p.z - f.z} + V{r.x, r.y, r.z};
  }
  V start(std::uint32_t v, const Vec3& from) const {
    const kernel::Place& p = world_.places[v];
    const kernel::Offset& r = world_.remainders[v];
    return V{p.x - from.x, p.y - from.y, p.z - from.z} + V{r.x, r.y, r.z};
  }
  V displacement(std::uint32_t v) const { return {moves_[v].x, moves_[v].y, moves_[v].z}; }
  float inverse_mass(std::uint32_t v) const { return world_.places[v].inverse_mass; }
  void move(std::uint32_t v, const V& by) {
    moves_[v].x += by.x, moves_[v].y += by.y, moves_[v].z += by.z;
    motions_[v].x += by.x * rate_, motions_[v].y += by.y * rate_, motions_[v].z += by.z * rate_;
  }

 private:
  const World& world_;
  std::vector<kernel::Offset>& moves_;
  std::vector<kernel::Motion>& motions_;
  float rate_;
};

/// How contacts push in substeps of one length.
struct Push {
  float share, most;

  explicit Push(double h)
      : share(static_cast<float>(1 - elementary::exp(-h / kPushTime))), most(static_cast<float>(kPushSpeed * h)) {}

  /// The displacement along the normal that a contact with this gap must have at least.
  float wanted(float gap) const { return gap >= 0 ? -gap : std::min(-gap * share, most); }

  /// What is to be added to the relative displacement u: along the normal what lacks, and against sliding at most
  /// friction times as much [Coulomb]; nothing if nothing lacks.
  bool correction(const V& u, const V& normal, float gap, float friction, V& out) const {
    const float along = dot(u, normal), lacking = wanted(gap) - along;
    if (!(lacking > 0)) return false;
    const V sliding = u - normal * along;
    const float slid = std::sqrt(dot(sliding, sliding));
    out = normal * lacking;
    if (slid > 0) out = out - sliding * (std::min(friction * lacking, slid) / slid);
    return true;
  }
};

/// A vertex, or a point between two.
struct EdgePoint {
  std::uint32_t a, b;
  float along, slack;

  V blend(const V& at_a, const V& at_b) const { return at_a * (1 - along) + at_b * along; }
  V start(const Movers& m, std::uint32_t from) const { return blend(m.start(a, from), m.start(b, from)); }
  V displacement(const Movers& m) const { return blend(m.displacement(a), m.displacement(b)); }
  float inverse_mass(const Movers& m) const {
    return m.inverse_mass(a) * (1 - along) * (1 - along) + m.inverse_mass(b) * along * along;
  }
  void move(Movers& m, const V& impulse) const {
    m.move(a, impulse * (m.inverse_mass(a) * (1 - along)));
    if (along > 0) m.move(b, impulse * (m.inverse_mass(b) * along));
  }
};

bool solve(const Contact& c, const EdgePoint& point, const Push& push, Movers& m) {
  const std::uint32_t from = c.corners[0];
  const V a = m.start(from, from), b = m.start(c.corners[1], from), d = m.start(c.corners[2], from);
  const V n = cross(b - a, d - a);
  const float size = std::sqrt(dot(n, n));
  if (!(size > 0)) return false;
  const V normal = n * (1 / size);
  const V apart = point.start(m, from) - (a * c.weights[0] + b * c.weights[1] + d * c.weights[2]);
  const float gap = dot(apart, normal);
  if (dot(apart, apart) - gap * gap > c.reach * c.reach) return false;
  V u = point.displacement(m);
  float weight = point.inverse_mass(m);
  for (std::size_t i = 0; i < 3; ++i) {
    u = u - m.displacement(c.corners[i]) * c.weights[i];
    weight += m.inverse_mass(c.corners[i]) * c.weights[i] * c.weights[i];
  }
  V correction{};
  if (!(weight > 0) || !push.correction(u, normal, gap + point.slack, c.friction, correction)) return false;
  const V impulse = correction * (1 / weight);
  point.move(m, impulse);
  for (std::size_t i = 0; i < 3; ++i) m.move(c.corners[i], impulse * (-c.weights[i] * m.inverse_mass(c.corners[i])));
  return true;
}

bool solve(const ObstacleContact& c, const Push& push, Movers& m) {
  if (!(m.inverse_mass(c.vertex) > 0)) return false;
  const V normal{c.normal.x, c.normal.y, c.normal.z};
  V correction{};
  if (!push.correction(m.displacement(c.vertex), normal, c.gap + dot(normal, m.start(c.vertex, c.from)), c.friction,
                       correction))
    return false;
  m.move(c.vertex, correction);
  return true;
}

}  // namespace

void solve_springs(World& world, double h) {
  Movers m(world, h);
  for (const Spring& spring : world.springs) {
    const float w = m.inverse_mass(spring.slot);
    if (!(spring.stiffness > 0) || !(w > 0)) continue;
    const float share = w / (w + static_cast<float>(1 / (spring.stiffness * h * h)));
    const Vec3 lacking = to_float(spring.target - world.place(spring.slot));
    m.move(spring.slot, (V{lacking.x, lacking.y, lacking.z} - m.displacement(spring.slot)) * share);
  }
}

void solve_attachments(World& world, double h) {
  Movers m(world, h);
  for (const Attachment& link : world.attachments) {
    const float a = m.inverse_mass(link.a), b = m.inverse_mass(link.b);
    if (!(a + b > 0)) continue;
    const Vec3 apart_before = to_float(world.place(link.b) - world.place(link.a));
    const V apart = V{apart_before.x, apart_before.y, apart_before.z} + m.displacement(link.b) - m.displacement(link.a);
    m.move(link.a, apart * (a / (a + b)));
    m.move(link.b, apart * (-b / (a + b)));
  }
}

void solve_contacts(World& world, double h) {
  Movers m(world, h);
  const Push push(h);
  world.report.contacts = world.report.touching = 0;
  for (const Contact& c : world.contacts.between)
    world.report.contacts += solve(c, {c.vertex, c.vertex, 0, 0}, push, m) ? 1 : 0;
  for (const EdgeContact& e : world.contacts.across)
    world.report.contacts += solve(e.contact, {e.contact.vertex, e.other_end, e.along, e.slack}, push, m) ? 1 : 0;
  for (const ObstacleContact& c : world.contacts.with_obstacles) world.report.touching += solve(c, push, m) ? 1 : 0;
}

}  // namespace tetsoup::simulate
