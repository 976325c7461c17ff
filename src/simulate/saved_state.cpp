#include "simulate/saved_state.h"

#include <cstring>
#include <type_traits>

#include "base/hash.h"
#include "tetsoup/error.h"

namespace tetsoup::simulate {
namespace {

/// Of the layout below, and of what it belongs to.
constexpr std::uint64_t kVersion = 0x31'6574'6174'7374;  // "tstate1"

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
  visit(reader, world);
}

}  // namespace tetsoup::simulate
