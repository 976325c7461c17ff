// Every kind of output, whose writer is killed at each call of the system that touches files, or has that call fail: a
// file is there as it was before or whole, and a writer that failed says so and leaves nothing else.
#include "traced_child.h"

#include <gtest/gtest.h>

#include <map>
#include <set>
#include <string>

#include "animation_fixtures.h"
#include "tet_models.h"
#include "tetsoup/distance.h"
#include "tetsoup/engines.h"
#include "tetsoup/io.h"
#include "tetsoup/pipeline.h"
#include "tetsoup/report.h"
#include "tetsoup/samples.h"

#if defined(__linux__) && defined(__x86_64__)

namespace tetsoup {

namespace fs = std::filesystem;

namespace {

/// One kind of output; makes the same files each time.
struct Output {
  std::string name;
  std::function<void(const fs::path& folder)> write;
};

class KilledWrites : public AnimationTest {
 protected:
  KilledWrites() { set_thread_count(1); }  // Threads do not live in a forked child.
  ~KilledWrites() override { set_thread_count(0); }

  void SetUp() override {
    AnimationTest::SetUp();
    if (run_traced([] { return 7; }, {}).exit_code != 7) GTEST_SKIP() << "processes cannot be traced here";
  }

  /// What its files hold when all is well, at any time between two calls, and before the first.
  struct Allowed {
    std::map<std::string, std::set<std::string>> contents;
    std::size_t call_count = 0;
  };

  int write(const Output& output) const {
    try {
      output.write(folder_);
      return 0;
    } catch (const IoError&) {
      return 1;
    } catch (...) {
      return 2;
    }
  }

  std::map<std::string, std::string> state() const {
    std::map<std::string, std::string> state;
    for (const auto& entry : fs::recursive_directory_iterator(folder_))
      if (entry.is_regular_file()) state[fs::relative(entry.path(), folder_).string()] = bytes_of(entry.path());
    return state;
  }

  void restore(const std::map<std::string, std::string>& before) const {
    for (const auto& entry : fs::directory_iterator(folder_)) fs::remove_all(entry.path());
    for (const auto& [name, bytes] : before) {
      fs::create_directories((folder_ / name).parent_path());
      put_file(folder_ / name, bytes);
    }
  }

  static bool is_temporary(const std::string& name) { return name.find(".tetsoup-") != name.npos; }

  /// A run in which nothing fails. Between what is written and the name it takes, it is brought to the disk.
  Allowed watch(const Output& output, const std::map<std::string, std::string>& before) const {
    Allowed allowed;
    for (const auto& [name, bytes] : before) allowed.contents[name].insert(bytes);
    bool synced = true;
    const auto note = [&](FileCall call) {
      if (call == FileCall::Write) synced = false;
      if (call == FileCall::Sync) synced = true;
      EXPECT_TRUE(synced || call != FileCall::Rename) << "renamed before it was on the disk";
      for (const auto& [name, bytes] : state())
        if (!is_temporary(name)) allowed.contents[name].insert(bytes);
    };
    const Trace trace = run_traced([&] { return write(output); }, {}, note);
    EXPECT_EQ(trace.exit_code, 0);
    note(FileCall::Close);
    allowed.call_count = trace.calls.size();
    return allowed;
  }

  void expect_allowed(const Allowed& allowed) const {
    for (const auto& [name, bytes] : state()) {
      if (is_temporary(name)) continue;
      const auto known = allowed.contents.find(name);
      EXPECT_TRUE(known != allowed.contents.end() && known->second.count(bytes) > 0) << name;
    }
  }

  void fail_in_turn(const Output& output, Fate fate) const {
    SCOPED_TRACE(output.name);
    restore({});
    ASSERT_EQ(write(output), 0);
    // Old files of the same names, which are to be replaced.
    std::map<std::string, std::string> before = state();
    for (auto& [name, bytes] : before)
      if (!name.ends_with(".pvd")) bytes = "old " + name;
    restore(before);
    const Allowed allowed = watch(output, before);
    for (std::size_t call = 0; call < allowed.call_count; ++call) {
      SCOPED_TRACE("call " + std::to_string(call));
      restore(before);
      const Trace trace = run_traced([&] { return write(output); }, Fault{call, fate});
      expect_allowed(allowed);
      for (const auto& [name, bytes] : before) EXPECT_TRUE(fs::exists(folder_ / name)) << name;
      if (fate == Fate::Killed) continue;
      EXPECT_TRUE(trace.exit_code == 0 || trace.exit_code == 1) << trace.exit_code;
      const FileCall failed = trace.calls[call];
      // What cannot be removed stays; where the file system knows no second names, renaming has to do.
      const bool matters = failed == FileCall::Write || failed == FileCall::Sync || failed == FileCall::Rename;
      EXPECT_TRUE(trace.exit_code == 1 || !matters) << static_cast<int>(failed);
      if (failed == FileCall::Remove) continue;
      for (const auto& [name, bytes] : state()) EXPECT_FALSE(is_temporary(name)) << name;
    }
  }

  std::vector<Output> tet_outputs() const {
    std::vector<Output> outputs;
    for (const TetFormatInfo& info : tet_formats()) {
      if (info.format == TetFormat::Surface) continue;
      outputs.push_back({info.name, [info](const fs::path& folder) {
                           write_tets(folder / ("x" + info.extension), two_regions(), info.format);
                         }});
    }
    for (const Engine& engine : engines())
      outputs.push_back({engine.name, [engine](const fs::path& folder) {
                           write_for_engine(engine, folder / ("x" + engine.extension), two_regions());
                         }});
    return outputs;
  }

  std::vector<Output> other_outputs() const {
    const TetMesh mesh = two_tets();
    const std::vector<Triangle> boundary = boundary_triangles(mesh);
    std::vector<Output> outputs;
    for (const char* name : {"s.obj", "s.stl", "s.ply"})
      outputs.push_back({name, [=](const fs::path& folder) { write_surface(folder / name, mesh.vertices, boundary); }});
    const RenderMesh render = render_mesh_of(TriangleSoup{mesh.vertices, boundary});
    outputs.push_back({"render mesh", [=](const fs::path& folder) { write_render_mesh(folder / "r.obj", render); }});
    const Embedding embedding = embed_points(mesh, TriangleSoup{mesh.vertices, boundary});
    for (const char* name : {"e.npz", "e.embedding"})
      outputs.push_back({name, [=](const fs::path& folder) { write_embedding(folder / name, embedding); }});
    outputs.push_back({"bytes", [](const fs::path& folder) {
                         write_file_atomic(folder / "b", std::as_bytes(std::span(std::string_view("bytes"))));
                       }});
    outputs.push_back({"field", [](const fs::path& folder) {
                         Pipeline pipeline(make_sample("torus"));
                         MeshOptions options;
                         options.distance.voxels = 8;
                         pipeline.run_until(Stage::PseudoVolume, options);
                         write_field(folder / "f.vti", pipeline.distance(), pipeline.pseudo_volume());
                       }});
    outputs.push_back({"page", [=](const fs::path& folder) {
                         ReportPage page;
                         page.mesh = &mesh;
                         write_report_page(folder / "p.html", page);
                       }});
    outputs.push_back({"preview", [=](const fs::path& folder) {
                         PreviewScene scene;
                         scene.mesh = &mesh;
                         write_preview(folder / "p.png", scene, 320);
                       }});
    return outputs;
  }

  std::vector<Output> animations() const {
    std::vector<Output> outputs;
    for (const char* name : {"frames", "x.pvd", "x.obj", "x.ply", "x.png", "x.webp", "x.glb"})
      outputs.push_back({name, [this, name](const fs::path& folder) { write_film(folder / name); }});
    return outputs;
  }

  void write_film(const fs::path& path) const {
    AnimationScene scene;
    scene.bodies.push_back({"bar", &bar_, nullptr, nullptr});
    AnimationOptions options;
    options.width = 64;
    options.height = 64;
    AnimationWriter writer({path}, scene, options);
    for (int i = 0; i < 2; ++i) {
      const std::vector<Vec3> points = bent(bar_.vertices, i);
      AnimationFrame frame;
      frame.time = i;
      frame.positions = {points};
      writer.add_frame(frame);
    }
    writer.finish();
  }
};

}  // namespace

TEST_F(KilledWrites, a_mesh_file_is_old_or_whole_wherever_its_writer_is_killed) {
  for (const Output& output : tet_outputs()) fail_in_turn(output, Fate::Killed);
}

TEST_F(KilledWrites, a_mesh_file_is_old_or_whole_whichever_call_fails) {
  for (const Output& output : tet_outputs()) fail_in_turn(output, Fate::Refused);
}

TEST_F(KilledWrites, surfaces_embeddings_fields_and_pages_are_old_or_whole_wherever_their_writer_is_killed) {
  for (const Output& output : other_outputs()) fail_in_turn(output, Fate::Killed);
}

TEST_F(KilledWrites, surfaces_embeddings_fields_and_pages_are_old_or_whole_whichever_call_fails) {
  for (const Output& output : other_outputs()) fail_in_turn(output, Fate::Refused);
}

TEST_F(KilledWrites, films_are_old_or_whole_wherever_their_writer_is_killed) {
  for (const Output& output : animations()) fail_in_turn(output, Fate::Killed);
}

TEST_F(KilledWrites, films_are_old_or_whole_whichever_call_fails) {
  for (const Output& output : animations()) fail_in_turn(output, Fate::Refused);
}

}  // namespace tetsoup

#endif
