#include "simulate/saved_state.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <initializer_list>
#include <type_traits>
#include <utility>

#include "base/hash.h"
#include "simulate/check.h"
#include "tetsoup/error.h"

namespace tetsoup::simulate {
namespace {

/// Of the layout below, and of what it belongs to.
constexpr std::uint64_t kVersion = 0x33'6574'6174'7374;  // "tstate3"

/// Over words of eight bytes and what is left.
std::uint64_t hash_of(std::span<const std::byte> bytes) {
  WordHash hash;
  for (std::size_t i = 0; i < bytes.size(); i += 8) {
    std::uint64_t word = 0;
    std::memcpy(&word, bytes.data() + i, std::min<std::size_t>(8, bytes.size() - i));
    hash.add(word);
  }
  return hash.value();
}

/// Puts values one after another, or takes them out again.
class Writer {
 public:
  template <class T>
  void value(const T& v) {
    static_assert(std::is_trivially_copyable_v<T>);
    const auto* first = reinterpret_cast<const std::byte*>(&v);
    bytes.insert(bytes.end(), first, first + sizeof(T));
  }
  template <class T>
  void list(const std::vector<T>& all) {
    value(std::uint64_t{all.size()});
    const auto* first = reinterpret_cast<const std::byte*>(all.data());
    bytes.insert(bytes.end(), first, first + sizeof(T) * all.size());
  }
  std::vector<std::byte> bytes;
};

class Reader {
 public:
  explicit Reader(std::span<const std::byte> bytes) : rest_(bytes) {}
  bool is_at_end() const { return rest_.empty(); }
  template <class T>
  void value(T& v) {
    take(&v, sizeof(T));
  }
  template <class T>
  void list(std::vector<T>& all) {
    std::uint64_t count = 0;
    value(count);
    if (count > rest_.size() / sizeof(T)) throw InvalidInput("the saved state is damaged");
    all.resize(count);
    take(all.data(), count * sizeof(T));
  }

 private:
  void take(void* to, std::size_t size) {
    if (size > rest_.size()) throw InvalidInput("the saved state is damaged");
    if (size > 0) std::memcpy(to, rest_.data(), size);
    rest_ = rest_.subspan(size);
  }
  std::span<const std::byte> rest_;
};

/// What a state fits: anything with the same parts, pins, springs, attachments and obstacles.
std::vector<std::uint64_t> shape_of(const World& world) {
  std::vector<std::uint64_t> shape{static_cast<std::uint64_t>(world.options.solver), world.places.size(),
                                   world.springs.size(), world.attachments.size(), world.obstacles.size()};
  for (const Part& part : world.parts) shape.push_back(world.rest_of(part).piece.tets.size());
  for (const kernel::Place& p : world.places) shape.push_back(p.inverse_mass > 0 ? 1 : 0);
  return shape;
}

/// All that a step changes; `start` is not in it, since every substep begins with it anew.
template <class Archive, class AnyWorld>
void visit(Archive& archive, AnyWorld& world) {
  archive.value(world.time);
  archive.list(world.places);
  archive.list(world.remainders);
  archive.list(world.motions);
  archive.list(world.springs);
  archive.list(world.contacts.between);
  archive.value(world.report);
  for (auto& part : world.parts) {
    archive.value(part.last_h);
    archive.value(part.clamped);
    archive.list(part.rotations);
  }
}

/// What is read before it is known to be sound; members as in the world.
struct Snapshot {
  double time = 0;
  std::vector<kernel::Place> places;
  std::vector<kernel::Offset> remainders;
  std::vector<kernel::Motion> motions;
  std::vector<Spring> springs;
  ContactSet contacts;
  SimulationReport report;
  std::vector<Part> parts;
};

/// Metres, and metres a second, beyond which no simulation gets; squares are still numbers.
constexpr float kFarthest = 1e12F;

/// False also for what is no number.
bool are_within(std::initializer_list<float> values, float lo, float hi) {
  return std::all_of(values.begin(), values.end(), [&](float v) { return v >= lo && v <= hi; });
}

bool are_within(const Vec3d& p) {
  const auto is_within = [](double v) { return std::abs(v) <= static_cast<double>(kFarthest); };
  return is_within(p.x) && is_within(p.y) && is_within(p.z);
}

bool fits_vertices(const World& world, const Snapshot& s) {
  if (s.places.size() != world.places.size() || s.motions.size() != world.motions.size() ||
      s.remainders.size() != world.remainders.size())
    return false;
  for (std::size_t i = 0; i < s.places.size(); ++i) {
    const kernel::Place& p = s.places[i];
    const kernel::Motion& m = s.motions[i];
    const kernel::Offset& r = s.remainders[i];
    if (!are_within({r.x, r.y, r.z}, -kFarthest, kFarthest) || r.inverse_mass != 0) return false;
    if (!are_within({p.x, p.y, p.z, m.x, m.y, m.z}, -kFarthest, kFarthest)) return false;
    if (p.inverse_mass != world.places[i].inverse_mass || m.mass != world.motions[i].mass) return false;
  }
  return true;
}

bool fits_springs(const World& world, const Snapshot& s) {
  return std::equal(s.springs.begin(), s.springs.end(), world.springs.begin(), world.springs.end(),
                    [](const Spring& a, const Spring& own) {
                      return a.slot == own.slot && are_within(a.target) && a.stiffness >= 0 &&
                             a.stiffness <= kMaxSpring;
                    });
}

bool fits_contact(const World& world, const Contact& c) {
  if (c.part >= world.parts.size() || c.vertex >= world.places.size()) return false;
  const Part& part = world.parts[c.part];
  const std::vector<Triangle>& triangles = world.surfaces[part.surface].triangles;
  if (c.triangle >= triangles.size()) return false;
  for (std::size_t i = 0; i < 3; ++i)
    if (c.corners[i] != part.begin + triangles[c.triangle][i]) return false;
  constexpr float kRounding = 1e-3F;
  return are_within({c.weights[0], c.weights[1], c.weights[2]}, -kRounding, 1 + kRounding) &&
         are_within({c.friction, c.reach}, 0, kFarthest);
}

bool fits_part(const Part& part, const Part& own) {
  // Quaternions of no length would turn into numbers that are none.
  constexpr float kRounding = 1e-3F;
  const auto are_unit = [&](const kernel::TetRotations& r) {
    for (int lane = 0; lane < kernel::kTetLanes; ++lane) {
      float square = 0;
      for (const auto& q : r.q) square += q[lane] * q[lane];
      if (!(std::abs(square - 1) < kRounding)) return false;
    }
    return true;
  };
  return part.last_h >= 0 && part.last_h <= 1 && part.rotations.size() == own.rotations.size() &&
         std::all_of(part.rotations.begin(), part.rotations.end(), are_unit);
}

bool fits_report(const SimulationReport& report, const SimulationReport& own) {
  return report.tet_count == own.tet_count && report.left_out == own.left_out &&
         report.loose_vertices == own.loose_vertices && report.parts == own.parts && report.substeps >= 0 &&
         report.substeps <= 60 * kMaxSubsteps;
}

/// Whatever the bytes were: no index leads out of the world, every number is one.
bool fits(const World& world, const Snapshot& s) {
  const std::vector<Contact>& contacts = s.contacts.between;
  const auto before = [](const Contact& a, const Contact& b) {
    return std::pair(a.part, a.vertex) < std::pair(b.part, b.vertex);
  };
  return s.time >= 0 && s.time <= static_cast<double>(kFarthest) && fits_vertices(world, s) && fits_springs(world, s) &&
         std::all_of(contacts.begin(), contacts.end(), [&](const Contact& c) { return fits_contact(world, c); }) &&
         std::is_sorted(contacts.begin(), contacts.end(), before) && fits_report(s.report, world.report) &&
         std::equal(s.parts.begin(), s.parts.end(), world.parts.begin(), world.parts.end(), fits_part);
}

/// Takes over what fits.
void adopt(World& world, Snapshot&& s) {
  world.time = s.time;
  world.places = std::move(s.places);
  world.remainders = std::move(s.remainders);
  world.motions = std::move(s.motions);
  world.springs = std::move(s.springs);
  world.contacts.between = std::move(s.contacts.between);
  world.report = s.report;
  for (std::size_t i = 0; i < world.parts.size(); ++i) {
    world.parts[i].last_h = s.parts[i].last_h;
    world.parts[i].clamped = s.parts[i].clamped;
    world.parts[i].rotations = std::move(s.parts[i].rotations);
  }
}

}  // namespace

std::vector<std::byte> save_state(const World& world) {
  const std::vector<std::uint64_t> shape = shape_of(world);
  Writer writer;
  writer.value(kVersion);
  writer.value(hash_of(std::as_bytes(std::span(shape))));
  visit(writer, world);
  writer.value(hash_of(writer.bytes));
  return std::move(writer.bytes);
}

void restore_state(World& world, std::span<const std::byte> bytes) {
  std::uint64_t version = 0, shape = 0, sum = 0;
  if (bytes.size() < sizeof(sum)) throw InvalidInput("the saved state is damaged");
  Reader(bytes.last(sizeof(sum))).value(sum);
  const auto content = bytes.first(bytes.size() - sizeof(sum));
  if (sum != hash_of(content)) throw InvalidInput("the saved state is damaged");
  Reader reader(content);
  reader.value(version);
  reader.value(shape);
  const std::vector<std::uint64_t> own = shape_of(world);
  if (version != kVersion || shape != hash_of(std::as_bytes(std::span(own))))
    throw InvalidInput("the saved state is of a simulation that was built otherwise");
  Snapshot snapshot;
  snapshot.parts.resize(world.parts.size());
  visit(reader, snapshot);
  if (!reader.is_at_end() || !fits(world, snapshot)) throw InvalidInput("the saved state is damaged");
  adopt(world, std::move(snapshot));
}

}  // namespace tetsoup::simulate
