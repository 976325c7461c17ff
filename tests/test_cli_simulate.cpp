// `tetsoup simulate`, run as a user runs it.
#include <nlohmann/json.hpp>
#include <tuple>

#include "run_tool.h"

namespace tetsoup::test {
namespace {

using Words = std::vector<std::string>;
using Json = nlohmann::json;

/// A small body that falls on the ground.
constexpr const char* kScene = R"({"seconds": 0.5,
  "bodies": [{"box": [0.3, 0.3, 0.3], "mesh": {"cells": 2, "voxels": 16}, "place": {"translate": [0, 0, 0.3], "rotate": [20, 30, 0]}}],
  "obstacles": [{"plane": {}}]})";

class SimulateTool : public ToolTest {
 protected:
  void SetUp() override {
    ToolTest::SetUp();
    write_text(in_folder("box.json"), kScene);
  }

  Json report(Words words) const {
    words.insert(words.begin(), "simulate");
    words.insert(words.end(), {"--json", "-", "--quiet"});
    const Outcome outcome = run(words);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return Json::parse(outcome.out, nullptr, false);
  }

  Json frames_of(const std::string& folder) const {
    return Json::parse(read_text(in_folder(folder) / "frames.json")).at("frames");
  }

  void expect_error(const Words& words, int exit_code, const Words& needles) const {
    const Outcome outcome = run(words);
    EXPECT_EQ(outcome.exit_code, exit_code) << outcome.err;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    for (const std::string& needle : needles) EXPECT_NE(outcome.err.find(needle), std::string::npos) << outcome.err;
  }
};

TEST_F(SimulateTool, lists_the_scenes_and_writes_them_to_be_changed) {
  const std::string list = run({"simulate", "--list"}).out;
  for (const char* name : {"drop", "robots-on-tree", "robots-on-tree-massive", "stack", "twist", "cantilever"})
    EXPECT_NE(list.find(name), std::string::npos) << list;
  EXPECT_EQ(run({"simulate", "cantilever", "--save-scene", "my.json"}).exit_code, 0);
  EXPECT_EQ(report({"my.json", "--seconds", "0.1"}).at("state_hash"),
            report({"cantilever", "--seconds", "0.1"}).at("state_hash"));
}

TEST_F(SimulateTool, the_report_has_what_scripts_rely_on) {
  const Json json = report({"box.json"});
  EXPECT_GT(json.at("tet_count"), 20);
  EXPECT_EQ(json.at("frames"), 30);
  EXPECT_GT(json.at("real_time_factor"), 0);
  EXPECT_EQ(json.at("state_hash").get<std::string>().size(), 18U);
  EXPECT_EQ(json.at("body_count"), 1);
  EXPECT_GT(json.at("surface_triangles"), 100);
  for (const char* stage : {"load", "simulate", "embed", "write", "total"})
    EXPECT_GE(json.at("seconds").at(stage), 0) << stage;
  EXPECT_EQ(files(), Words{"box.json"});
}

TEST_F(SimulateTool, threads_leave_no_trace) {
  const Json one = report({"stack", "--seconds", "0.5", "--threads", "1"});
  EXPECT_EQ(one.at("state_hash"), report({"stack", "--seconds", "0.5", "--threads", "3"}).at("state_hash"));
}

TEST_F(SimulateTool, flags_take_the_place_of_what_the_scene_says) {
  const Json json =
      report({"box.json", "--seconds", "0.2", "--fps", "60", "--substeps", "3", "--solver", "potentials"});
  EXPECT_EQ(json.at("frames"), 12);
  EXPECT_EQ(json.at("solver"), "potentials");
  EXPECT_GE(json.at("substeps"), 3);
}

TEST_F(SimulateTool, a_folder_holds_frames_and_goes_on_to_the_same_hashes) {
  report({"box.json", "-o", "whole"});
  const Json whole = frames_of("whole");
  ASSERT_EQ(whole.size(), 31U);
  EXPECT_EQ(whole[30].at("frame"), 30);
  EXPECT_TRUE(fs::exists(in_folder("whole") / "frames.pvd"));
  EXPECT_TRUE(fs::exists(in_folder("whole") / "frame_0030.vtu"));
  report({"box.json", "-o", "part", "--seconds", "0.2"});
  EXPECT_EQ(frames_of("part").size(), 13U);
  const Json rest = report({"box.json", "-o", "part", "--resume"});
  EXPECT_EQ(rest.at("resumed_after"), 12);
  EXPECT_EQ(frames_of("part"), whole);
  EXPECT_EQ(read_text(in_folder("part") / "frames.pvd"), read_text(in_folder("whole") / "frames.pvd"));
  EXPECT_EQ(read_text(in_folder("part") / "frame_0030.vtu"), read_text(in_folder("whole") / "frame_0030.vtu"));
  EXPECT_EQ(report({"box.json", "-o", "part", "--resume"}).at("state_hash"), whole[30].at("state_hash"));
}

TEST_F(SimulateTool, what_ctrl_c_stops_can_go_on) {
  // Longer than anybody waits; `timeout` presses Ctrl-C. In the foreground, or it comes twice, to the tool and to its
  // group, and the second one kills.
  const std::string tool = std::string("cd ") + in_folder("").string() +
                           " && timeout --foreground --preserve-status -s INT 3 " + TETSOUP_CLI +
                           " simulate box.json -o part --seconds 3600 2> err.txt";
  const int status = std::system(tool.c_str());
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 130);
  EXPECT_NE(read_text(in_folder("err.txt")).find("--resume"), std::string::npos);
  const std::size_t done = frames_of("part").size() - 1;
  ASSERT_GT(done, 0U);
  const std::string seconds = std::to_string(static_cast<double>(done + 5) / 60);
  const Json rest = report({"box.json", "-o", "part", "--resume", "--seconds", seconds});
  EXPECT_EQ(rest.at("resumed_after"), done);
  EXPECT_EQ(rest.at("frames"), done + 5);
  EXPECT_EQ(rest.at("state_hash"), report({"box.json", "--seconds", seconds}).at("state_hash"));
}

TEST_F(SimulateTool, a_folder_without_its_state_or_a_frame_does_not_go_on) {
  report({"box.json", "-o", "dir", "--seconds", "0.2"});
  fs::rename(in_folder("dir") / "frame_0005.vtu", in_folder("dir") / "elsewhere");
  expect_error({"simulate", "box.json", "-o", "dir", "--resume"}, 3, {"frame_0005.vtu", "missing"});
  fs::rename(in_folder("dir") / "elsewhere", in_folder("dir") / "frame_0005.vtu");
  fs::remove(in_folder("dir") / "state.bin");
  expect_error({"simulate", "box.json", "-o", "dir", "--resume", "--seconds", "0.05"}, 3, {"state.bin", "missing"});
  EXPECT_EQ(frames_of("dir").size(), 13U);
  fs::remove(in_folder("dir") / "frames.json");
  expect_error({"simulate", "box.json", "-o", "dir", "--resume", "--seconds", "0.05"}, 3, {"state.bin", "missing"});
  EXPECT_TRUE(fs::exists(in_folder("dir") / "frame_0012.vtu"));
}

TEST_F(SimulateTool, a_run_killed_early_can_go_on_and_leaves_no_stale_frames) {
  const std::string tool = std::string("cd ") + in_folder("").string() + " && timeout -s KILL 2 " + TETSOUP_CLI +
                           " simulate box.json -o part --seconds 3600 2> err.txt";
  std::ignore = std::system(tool.c_str());
  ASSERT_TRUE(fs::exists(in_folder("part") / "frame_0004.vtu")) << "killed too early to tell";
  report({"box.json", "-o", "part", "--resume", "--seconds", "0.05"});
  EXPECT_EQ(frames_of("part").size(), 4U);
  EXPECT_FALSE(fs::exists(in_folder("part") / "frame_0004.vtu"));
  report({"box.json", "-o", "whole", "--seconds", "0.05"});
  EXPECT_EQ(frames_of("part"), frames_of("whole"));
  EXPECT_EQ(read_text(in_folder("part") / "frame_0003.vtu"), read_text(in_folder("whole") / "frame_0003.vtu"));
}

TEST_F(SimulateTool, ctrl_c_without_a_folder_leaves_nothing) {
  const std::string tool = std::string("cd ") + in_folder("").string() +
                           " && timeout --foreground --preserve-status -s INT 2 " + TETSOUP_CLI +
                           " simulate box.json -o x.obj --seconds 3600 2> err.txt";
  const int status = std::system(tool.c_str());
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 130);
  EXPECT_EQ(files(), Words{"box.json"});
}

TEST_F(SimulateTool, films_and_pictures_are_drawn) {
  report({"box.json", "--seconds", "0.02", "--preview"});
  EXPECT_TRUE(read_text(in_folder("box.webp")).starts_with("RIFF"));
  report({"box.json", "--seconds", "0.02", "-o", "x.glb", "-o", "skin.obj", "--preview", "x.png"});
  EXPECT_TRUE(read_text(in_folder("x.glb")).starts_with("glTF"));
  for (const char* name : {"skin_0000.obj", "skin_0001.obj", "x_0001.png"})
    EXPECT_TRUE(fs::exists(in_folder(name))) << name;
  report({"box.json", "--seconds", "0.02", "-o", "dir", "--preview"});
  report({"box.json", "--seconds", "0.04", "-o", "dir", "--preview", "--resume"});
  EXPECT_TRUE(fs::exists(in_folder("dir") / "preview_0002.png"));
  EXPECT_TRUE(fs::exists(in_folder("dir") / "preview.webp"));
}

TEST_F(SimulateTool, what_is_wrong_is_said_before_anything_is_made) {
  write_text(in_folder("wrong.json"), R"({"bodies": [{"box": [1, 1, 1], "material": {"poisson": 0.7}}]})");
  write_text(in_folder("broken.json"), "{\n  \"bodies\": [,]\n}");
  expect_error({"simulate"}, 2, {"SCENE", "--list"});
  expect_error({"simulate", "hop"}, 2, {"hop", "robots-on-tree"});
  expect_error({"simulate", "none.json"}, 3, {"none.json", "no such file"});
  expect_error({"simulate", "wrong.json"}, 3, {"wrong.json: bodies[0].material.poisson: 0.7"});
  expect_error({"simulate", "broken.json"}, 3, {"broken.json: line 2, column 14"});
  expect_error({"simulate", "box.json", "--resume"}, 2, {"--resume", "-o"});
  expect_error({"simulate", "box.json", "-o", "x.docx"}, 3, {"x.docx", ".glb"});
  expect_error({"simulate", "box.json", "-o", "a", "-o", "b"}, 2, {"-o b"});
  expect_error({"simulate", "box.json", "--preview", "x.gif"}, 3, {"x.gif", ".webp"});
  expect_error({"simulate", "box.json", "--seconds", "-1"}, 2, {"--seconds"});
  expect_error({"simulate", "box.json", "--solver", "magic"}, 2, {"--solver magic"});
  EXPECT_EQ(files(), (Words{"box.json", "broken.json", "wrong.json"}));
}

TEST_F(SimulateTool, a_folder_is_not_mixed_up_with_another_scene) {
  report({"box.json", "-o", "dir", "--seconds", "0.1"});
  expect_error({"simulate", "box.json", "-o", "dir"}, 3, {"dir", "--resume"});
  expect_error({"simulate", "box.json", "-o", "dir", "--resume", "--substeps", "3"}, 3, {"dir", "another scene"});
  expect_error({"simulate", "cantilever", "-o", "dir", "--resume"}, 3, {"dir", "another scene"});
  write_text(in_folder("dir") / "state.bin", "damaged");
  expect_error({"simulate", "box.json", "-o", "dir", "--resume"}, 3, {"state.bin", "damaged"});
}

}  // namespace
}  // namespace tetsoup::test
