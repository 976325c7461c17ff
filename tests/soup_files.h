// What the tests of the soup readers share: bytes by formula, and the two kinds of damage every reader must survive.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <cstring>
#include <new>
#include <random>
#include <string>
#include <string_view>

#include "tetsoup/error.h"
#include "tetsoup/io.h"

namespace tetsoup::test {

/// The largest single piece of memory asked for since the last reset: shows who believes a header.
inline std::atomic<std::size_t> largest_allocation{0};

inline TriangleSoup parse(std::string_view bytes, SoupFormat format) {
  return parse_soup(std::as_bytes(std::span(bytes)), format, "sample");
}

inline std::string error_of(std::string_view bytes, SoupFormat format) {
  try {
    parse(bytes, format);
  } catch (const IoError& error) {
    return error.what();
  }
  return "no error";
}

#define EXPECT_ERROR(bytes, format, text) \
  EXPECT_NE(error_of(bytes, format).find(text), std::string::npos) << error_of(bytes, format)

/// Bytes of a number, least significant first unless `big`.
template <class Number>
std::string raw(Number value, bool big = false) {
  std::string bytes(sizeof(Number), '\0');
  std::memcpy(bytes.data(), &value, sizeof(Number));
  if (big) std::reverse(bytes.begin(), bytes.end());
  return bytes;
}

inline RenderMesh parse_mesh(std::string_view bytes, SoupFormat format) {
  return parse_render_mesh(std::as_bytes(std::span(bytes)), format, "sample");
}

/// Bit for bit: NaN equals itself.
template <class T>
bool same_bits(const std::vector<T>& a, const std::vector<T>& b) {
  return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

/// A render mesh is the soup, and what its corners name is there.
inline void expect_same_surface(const RenderMesh& mesh, const TriangleSoup& soup) {
  const TriangleSoup cut = triangles_of(mesh);
  EXPECT_TRUE(same_bits(cut.vertices, soup.vertices));
  EXPECT_TRUE(same_bits(cut.triangles, soup.triangles));
  EXPECT_EQ(triangle_faces(mesh).size(), soup.triangles.size());
  EXPECT_EQ(mesh.face_parts.size(), mesh.face_sizes.size());
  const auto expect_choices = [&](const std::vector<std::uint32_t>& choices, std::size_t count) {
    EXPECT_TRUE(choices.empty() || choices.size() == mesh.corners.size());
    for (const std::uint32_t choice : choices) EXPECT_TRUE(choice < count || choice == RenderMesh::kNone);
  };
  expect_choices(mesh.corner_texcoords, mesh.texcoords.size());
  expect_choices(mesh.corner_normals, mesh.normals.size());
  for (const std::uint32_t size : mesh.face_sizes) EXPECT_GE(size, 3U);
}

/// Parses, as a soup and as a render mesh alike, or throws IoError that names the file; in both cases within memory the
/// bytes can justify.
inline bool parses_soberly(std::string_view bytes, SoupFormat format) {
  constexpr std::size_t kMemoryPerByte = 64, kMemoryAlways = 1 << 16;
  largest_allocation = 0;
  bool parsed = false;
  try {
    const TriangleSoup soup = parse(bytes, format);
    EXPECT_LE(soup.vertices.size(), bytes.size());
    EXPECT_LE(soup.triangles.size(), bytes.size());
    parsed = true;
    expect_same_surface(parse_mesh(bytes, format), soup);
  } catch (const IoError& error) {
    EXPECT_TRUE(std::string_view(error.what()).starts_with("sample")) << error.what();
    EXPECT_FALSE(parsed) << "as a soup alone, but not as a render mesh: " << error.what();
    EXPECT_THROW(parse_mesh(bytes, format), IoError);
  }
  EXPECT_LE(largest_allocation, kMemoryPerByte * bytes.size() + kMemoryAlways);
  return parsed;
}

/// Prefixes shorter than `complete` bytes must throw: the file promised more.
inline void expect_truncations_throw(const std::string& sample, SoupFormat format, std::size_t complete) {
  ASSERT_TRUE(parses_soberly(sample, format)) << error_of(sample, format);
  for (std::size_t length = 0; length < sample.size(); ++length) {
    // A copy of exactly this size, so that AddressSanitizer sees a read beyond it.
    const std::vector<char> prefix(sample.begin(), sample.begin() + static_cast<std::ptrdiff_t>(length));
    const bool parsed = parses_soberly({prefix.data(), prefix.size()}, format);
    EXPECT_FALSE(parsed && length < complete) << "prefix of " << length << " bytes";
    if (::testing::Test::HasFailure()) return;
  }
}

/// Replaces random bytes, `flips` in total, one to four at a time.
inline void expect_damage_survived(const std::string& sample, SoupFormat format, int flips, unsigned seed) {
  constexpr std::string_view kSpecial("0123456789-.e/ \n\r\\#\"{}[],:\0\xff\x7f\x80", 30);
  std::mt19937 random(seed);
  while (flips > 0 && !::testing::Test::HasFailure()) {
    std::vector<char> damaged(sample.begin(), sample.end());
    for (unsigned i = 0; i <= random() % 4; ++i, --flips) {
      char& victim = damaged[random() % damaged.size()];
      const auto kind = random() % 3;
      if (kind == 0) victim = static_cast<char>(victim ^ (1 << random() % 8));
      if (kind == 1) victim = static_cast<char>(random() & 0xff);
      if (kind == 2) victim = kSpecial[random() % kSpecial.size()];
    }
    parses_soberly({damaged.data(), damaged.size()}, format);
  }
}

}  // namespace tetsoup::test

// Not inlined: the compiler would pair malloc with delete and warn.
[[gnu::noinline]] void* operator new(std::size_t size) {
  std::size_t largest = tetsoup::test::largest_allocation;
  while (size > largest && !tetsoup::test::largest_allocation.compare_exchange_weak(largest, size)) {
  }
  if (void* memory = std::malloc(size > 0 ? size : 1)) return memory;
  throw std::bad_alloc();
}
/// What std::stable_sort() asks for memory with.
[[gnu::noinline]] void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  try {
    return operator new(size);
  } catch (const std::bad_alloc&) {
    return nullptr;
  }
}
[[gnu::noinline]] void operator delete(void* memory) noexcept {
  std::free(memory);
}
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept {
  std::free(memory);
}
