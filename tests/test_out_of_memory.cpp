// Each allocation fails in turn: what runs throws std::bad_alloc, loses nothing, and does its work the next time.
// Without what reads or writes JSON (glTF, scenes, reports): nlohmann's values allocate a little while they are
// destroyed, and end the process if they cannot.
#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <new>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "io/tet_readers.h"
#include "tet_models.h"
#include "tetsoup/io.h"
#include "tetsoup/pipeline.h"
#include "tetsoup/samples.h"
#include "tetsoup/simulate.h"
#include "tetsoup/tetsoup_c.h"

namespace {

constexpr std::size_t kNever = static_cast<std::size_t>(-1);
std::atomic<std::size_t> allocation_count{0};
std::atomic<std::size_t> first_failing{kNever}, last_failing{kNever};

void* allocate(std::size_t size, std::size_t alignment) {
  const std::size_t number = allocation_count.fetch_add(1);
  if (number >= first_failing && number <= last_failing) throw std::bad_alloc();
  void* memory =
      alignment > 0 ? std::aligned_alloc(alignment, (size + alignment - 1) / alignment * alignment) : std::malloc(size);
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}

}  // namespace

// Not inlined: the compiler would pair malloc with delete and warn.
[[gnu::noinline]] void* operator new(std::size_t size) {
  return allocate(size, 0);
}
[[gnu::noinline]] void* operator new(std::size_t size, std::align_val_t alignment) {
  return allocate(size, static_cast<std::size_t>(alignment));
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
[[gnu::noinline]] void operator delete(void* memory, std::align_val_t) noexcept {
  std::free(memory);
}
[[gnu::noinline]] void operator delete(void* memory, std::size_t, std::align_val_t) noexcept {
  std::free(memory);
}

namespace tetsoup {
namespace {

namespace fs = std::filesystem;

/// So many tries of a run with more allocations than that.
constexpr std::size_t kMostTries = 150;

/// Runs `act` with each of its allocations failing, alone and with all behind it; `look` sees what is left.
/// @return  Runs that threw std::bad_alloc.
std::size_t fail_in_turn(
    const std::function<void()>& act, const std::function<void()>& look = [] {}) {
  act();
  allocation_count = 0;
  act();
  const std::size_t count = allocation_count, stride = 1 + count / kMostTries;
  std::size_t thrown = 0;
  for (std::size_t i = 0; i < count; i += stride)
    for (const bool alone : {true, false}) {
      allocation_count = 0;
      last_failing = alone ? i : kNever - 1;
      first_failing = i;
      try {
        act();
      } catch (const std::bad_alloc&) {
        ++thrown;
      }
      first_failing = kNever;
      look();
    }
  return thrown;
}

class OutOfMemory : public FolderTest {
 protected:
  OutOfMemory() { set_thread_count(1); }  // So that the same allocation has the same number in every run.
  ~OutOfMemory() override { set_thread_count(0); }
};

MeshOptions few_voxels() {
  MeshOptions options;
  options.distance.voxels = 10;
  options.lattice.cells = 3;
  return options;
}

bool are_same(const TetMesh& a, const TetMesh& b) {
  return a.vertices == b.vertices && a.tets == b.tets;
}

std::vector<fs::path> corpus(const char* what) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(fs::path(TETSOUP_FUZZ_CORPUS) / what)) files.push_back(entry.path());
  return files;
}

}  // namespace

TEST_F(OutOfMemory, a_pipeline_that_ran_out_gives_the_same_mesh_the_next_time) {
  const TriangleSoup soup = make_sample("torus", {.damage = 0.1});
  const TetMesh whole = Pipeline(soup).run(few_voxels()).mesh;
  std::optional<Pipeline> pipeline;
  const std::size_t thrown = fail_in_turn(
      [&] {
        pipeline.emplace(soup);
        pipeline->run(few_voxels());
      },
      [&] {
        if (!pipeline) return;
        EXPECT_TRUE(are_same(pipeline->run(few_voxels()).mesh, whole));
      });
  EXPECT_GT(thrown, kMostTries);
}

TEST_F(OutOfMemory, a_pipeline_that_ran_out_over_a_changed_option_goes_back) {
  const TriangleSoup soup = make_sample("torus", {.damage = 0.1});
  MeshOptions wide = few_voxels();
  wide.pseudo_volume.k = 0.3;
  const TetMesh whole = Pipeline(soup).run(few_voxels()).mesh;
  Pipeline pipeline(soup);
  fail_in_turn(
      [&] {
        pipeline.run(few_voxels());
        pipeline.run(wide);
      },
      [&] { EXPECT_TRUE(are_same(pipeline.run(few_voxels()).mesh, whole)); });
}

TEST_F(OutOfMemory, readers_of_soups_pass_it_on) {
  for (const fs::path& path : corpus("soup")) {
    const std::string bytes = bytes_of(path);
    if (bytes.empty() || static_cast<SoupFormat>(bytes[0]) >= SoupFormat::Gltf) continue;
    const auto content = std::as_bytes(std::span(bytes)).subspan(1);
    const auto format = static_cast<SoupFormat>(bytes[0]);
    SCOPED_TRACE(path);
    const auto read = [&] {
      try {
        parse_render_mesh(content, format, "x");
        return true;
      } catch (const IoError&) {
        return false;
      }
    };
    const bool readable = read();
    fail_in_turn([&] { EXPECT_EQ(read(), readable); });
  }
}

TEST_F(OutOfMemory, readers_of_tets_pass_it_on) {
  using Parse = TetMesh (*)(std::string_view, const std::string&);
  constexpr std::array<Parse, 5> kParsers{parse_msh, parse_vtk, parse_vtu, parse_medit, parse_npz};
  const std::string name = "x";
  for (const fs::path& path : corpus("tets")) {
    const std::string bytes = bytes_of(path);
    if (bytes.empty() || static_cast<std::size_t>(bytes[0]) >= kParsers.size()) continue;
    SCOPED_TRACE(path);
    const auto read = [&] {
      try {
        kParsers[static_cast<std::size_t>(bytes[0])](std::string_view(bytes).substr(1), name);
        return true;
      } catch (const IoError&) {
        return false;
      }
    };
    const bool readable = read();
    fail_in_turn([&] { EXPECT_EQ(read(), readable); });
  }
}

TEST_F(OutOfMemory, files_are_whole_or_as_they_were) {
  const TetModel model = two_regions();
  for (const TetFormatInfo& info : tet_formats()) {
    if (info.format == TetFormat::Surface) continue;
    SCOPED_TRACE(info.name);
    const fs::path path = folder_ / ("x" + info.extension);
    write_tets(path, model, info.format);
    const std::vector<std::string> names = files();
    const std::string whole = bytes_of(folder_ / names.front());
    fail_in_turn([&] { write_tets(path, model, info.format); },
                 [&] {
                   EXPECT_EQ(files(), names);
                   EXPECT_EQ(bytes_of(folder_ / names.front()), whole);
                 });
    for (const std::string& file : names) fs::remove(folder_ / file);
  }
}

TEST_F(OutOfMemory, a_simulation_that_ran_out_can_be_stepped_and_saved) {
  const TetMesh mesh = block_of_tets(2);
  std::optional<Simulation> simulation;
  fail_in_turn(
      [&] {
        simulation.emplace();
        simulation->add_plane({0, 0, 1}, 0);
        simulation->add_body(mesh, {}, {.translate = {0, 0, 0.1}});
        simulation->add_body(mesh, {}, {.translate = {0.1, 0.2, 2.5}});
        simulation->pin({1, 2});
        simulation->step(1.0 / 60);
        simulation->restore_state(simulation->save_state());
      },
      [&] {
        if (!simulation) return;
        simulation->step(1.0 / 60);
        EXPECT_FALSE(simulation->save_state().empty());
      });
}

TEST_F(OutOfMemory, c_says_so_and_never_more) {
  tetsoup_soup* soup = nullptr;
  const TetMesh tet = two_tets();
  constexpr std::array<std::uint32_t, 12> kFaces{0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3};
  ASSERT_EQ(tetsoup_soup_create(&tet.vertices[0].x, 4, kFaces.data(), 4, &soup), TETSOUP_OK);
  std::size_t told = 0;
  fail_in_turn([&] {
    tetsoup_pipeline* pipeline = nullptr;
    tetsoup_status status = tetsoup_pipeline_create(soup, nullptr, nullptr, &pipeline);
    if (status == TETSOUP_OK)
      status = tetsoup_pipeline_run_until(pipeline, TETSOUP_STAGE_DISTANCE, nullptr, nullptr, nullptr);
    EXPECT_TRUE(status == TETSOUP_OK || status == TETSOUP_OUT_OF_MEMORY) << status << ' ' << tetsoup_last_error();
    if (status != TETSOUP_OK) ++told;
    tetsoup_pipeline_destroy(pipeline);
  });
  tetsoup_soup_destroy(soup);
  EXPECT_GT(told, 20U);
}

}  // namespace tetsoup
