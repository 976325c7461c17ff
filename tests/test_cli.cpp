// The command-line tool, run as a user runs it: what it explains and what it refuses.
#include "run_tool.h"

namespace tetsoup::test {

namespace {

using Words = std::vector<std::string>;

TEST_F(Tool, without_words_it_names_the_command_to_start_with) {
  const Outcome outcome = run({});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_NE(outcome.out.find("tetsoup mesh IN"), std::string::npos);
}

TEST_F(Tool, help_has_examples_on_every_level) {
  for (const Words& words : {Words{"--help"}, Words{"mesh", "--help"}, Words{"inspect", "--help"}, Words{"field", "-h"},
                             Words{"sample", "--help"}, Words{"simulate", "--help"}}) {
    const Outcome outcome = run(words);
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_NE(outcome.out.find("Examples:\n  tetsoup "), std::string::npos) << outcome.out;
    EXPECT_EQ(outcome.err, "");
  }
}

TEST_F(Tool, help_of_mesh_names_every_flag_that_scripts_rely_on) {
  const std::string help = run({"mesh", "--help"}).out;
  for (const char* flag :
       {"--voxels",   "--voxel-size", "--k ",        "--band-voxels", "--band ",     "--rays",   "--placement",
        "--cavities", "--cells",      "--cell-size", "--rho-min",     "--translate", "--rotate", "--passes",
        "--strength", "--min-angle",  "--threads",   "--json",        "--preview",   "--quiet",  "--format",
        "--memory",   "--tets",       "--vertices",  "--edge",        "--lattice",   "--fit"})
    EXPECT_NE(help.find(flag), std::string::npos) << flag;
}

TEST_F(Tool, prints_its_version) {
  const Outcome outcome = run({"--version"});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_TRUE(outcome.out.starts_with("tetsoup ")) << outcome.out;
}

TEST_F(Tool, refuses_an_option_out_of_range_by_its_name) {
  const std::vector<std::array<std::string, 2>> wrong{{"--voxels", "0"},
                                                      {"--voxels", "12abc"},
                                                      {"--voxels", "1e2"},
                                                      {"--voxels", "4097"},
                                                      {"--voxels", ""},
                                                      {"--voxels", "99999999999"},
                                                      {"--voxel-size", "0"},
                                                      {"--voxel-size", "nan"},
                                                      {"--voxel-size", "inf"},
                                                      {"--voxel-size", "0x1p3"},
                                                      {"--k", "1.01"},
                                                      {"--k", "0"},
                                                      {"--k", "automatic"},
                                                      {"--band-voxels", "-1"},
                                                      {"--band-voxels", "4097"},
                                                      {"--band", "1,5"},
                                                      {"--rays", "14"},
                                                      {"--placement", "Entry"},
                                                      {"--cavities", "both"},
                                                      {"--cells", "1025"},
                                                      {"--tets", "0"},
                                                      {"--tets", "2e3"},
                                                      {"--vertices", "-5"},
                                                      {"--edge", "0"},
                                                      {"--lattice", "fcc"},
                                                      {"--cell-size", "1e999"},
                                                      {"--rho-min", "0"},
                                                      {"--translate", "1,2"},
                                                      {"--translate", "1,2,3,4"},
                                                      {"--rotate", "1,nan,0"},
                                                      {"--rotate", "1, 2,3"},
                                                      {"--passes", "-1"},
                                                      {"--passes", "2.5"},
                                                      {"--strength", "0"},
                                                      {"--min-angle", "60"},
                                                      {"--threads", "-1"},
                                                      {"--memory", "0"},
                                                      {"--format", "docx"}};
  for (const auto& [flag, value] : wrong) {
    const Outcome outcome = run({"mesh", "cube.obj", "-o", "x.msh", flag, value});
    EXPECT_EQ(outcome.exit_code, 2) << flag << " " << value;
    expect_error_line(outcome, {flag});
    EXPECT_EQ(outcome.out, "");
  }
  const Outcome huge = run({"mesh", "cube.obj", "-o", "x.msh", "--edge", "1e300"});  // only the mesher knows the box
  EXPECT_EQ(huge.exit_code, 2);
  expect_error_line(huge, {"edge = 1e+300", "the box"});
  EXPECT_EQ(files(), Words{"cube.obj"});
}

TEST_F(Tool, refuses_wrong_usage_with_the_word_that_is_wrong) {
  const std::vector<std::pair<Words, Words>> wrong{
      {{"mesh", "cube.obj"}, {"-o"}},
      {{"mesh", "-o", "x.msh"}, {"IN"}},
      {{"mesh", "cube.obj", "-o"}, {"--output"}},
      {{"mesh", "cube.obj", "-o", "x.msh", "--voxels"}, {"--voxels"}},
      {{"mesh", "cube.obj", "-o", "x.msh", "--unknown", "3"}, {"--unknown", "mesh --help"}},
      {{"mesh", "cube.obj", "other.obj", "-o", "x.msh"}, {"other.obj"}},
      {{"mesh", "cube.obj", "-o", "x.msh", "--voxels", "9", "--voxel-size", ".1"}, {"--voxels", "--voxel-size"}},
      {{"mesh", "cube.obj", "-o", "x.msh", "--k", "1", "--band", ".1"}, {"--k", "--band"}},
      {{"mesh", "cube.obj", "-o", "x.msh", "--cells", "9", "--cell-size", ".1"}, {"--cells", "--cell-size"}},
      {{"mesh", "cube.obj", "-o", "x.msh", "--tets", "90", "--cells", "9"}, {"--tets", "--cells"}},
      {{"mesh", "cube.obj", "-o", "x.msh", "--edge", "9", "--vertices", "9"}, {"--edge", "--vertices"}},
      {{"mesh", "cube.obj", "-o", "x.msh", "--cells", "9", "--cells", "8"}, {"--cells"}},
      {{"mesh", "cube.obj", "-o", "x.msh", "-o", "x.msh"}, {"x.msh"}},
      {{"mesh", "cube.obj", "-o", "x.msh", "--json", "x.msh"}, {"--json", "x.msh"}},
      {{"mesh", "cube.obj", "-o", "x.msh", "-o", "y.msh", "--format", "vtk"}, {"--format"}},
      {{"mesh", "-", "-o", "x.msh"}, {"IN"}},
      {{"field", "cube.obj", "-o", "x.vti", "--cells", "9"}, {"--cells", "field --help"}},
      {{"sample", "dodo"}, {"dodo", "torus"}},
      {{"sample", "torus", "--damage", "1"}, {"--damage"}},
      {{"sample", "torus", "--seed", "-1"}, {"--seed"}},
      {{"sample", "-o", "x.obj"}, {"NAME"}},
      {{"cube.obj"}, {"tetsoup mesh cube.obj"}},
      {{"dance"}, {"dance", "mesh"}}};
  for (const auto& [words, parts] : wrong) {
    const Outcome outcome = run(words);
    EXPECT_EQ(outcome.exit_code, 2) << outcome.err;
    expect_error_line(outcome, parts);
  }
  EXPECT_EQ(files(), Words{"cube.obj"});
}

TEST_F(Tool, names_the_file_it_cannot_read_or_write) {
  write_text(in_folder("cut.ply"), "ply\nformat ascii 1.0\nelement vertex 3\n");
  fs::create_directory(in_folder("folder.obj"));
  const std::vector<std::pair<Words, Words>> wrong{
      {{"mesh", "missing.obj", "-o", "x.msh"}, {"missing.obj"}},
      {{"mesh", "torus", "-o", "x.msh"}, {"tetsoup sample torus"}},
      {{"mesh", "folder.obj", "-o", "x.msh"}, {"folder.obj"}},
      {{"mesh", "cut.ply", "-o", "x.msh"}, {"cut.ply"}},
      {{"mesh", "cube.obj", "-o", "x.docx"}, {"x.docx"}},
      {{"mesh", "cube.obj", "-o", "x"}, {"x"}},
      {{"mesh", "cube.obj", "-o", "nowhere/x.msh"}, {"nowhere"}},
      {{"mesh", "cube.obj", "-o", "x.msh", "--json", "nowhere/x.json"}, {"--json", "nowhere"}},
      {{"mesh", "cube.obj", "-o", "x.msh", "--preview", "x.jpg"}, {"--preview", ".png"}},
      {{"mesh", "cube.obj", "-o", "folder.obj"}, {"folder.obj"}},
      {{"field", "cube.obj", "-o", "x.vtk"}, {"x.vtk", ".vti"}},
      {{"inspect", "missing.msh"}, {"missing.msh"}},
      {{"sample", "torus", "-o", "x.msh"}, {"x.msh"}}};
  for (const auto& [words, parts] : wrong) {
    const Outcome outcome = run(words);
    EXPECT_EQ(outcome.exit_code, 3) << outcome.err;
    expect_error_line(outcome, parts);
  }
  EXPECT_EQ(files(), (Words{"cube.obj", "cut.ply", "folder.obj"}));
}

TEST_F(Tool, never_writes_over_its_input) {
  const Outcome outcome = run({"mesh", "cube.obj", "-o", "./cube.obj"});
  EXPECT_EQ(outcome.exit_code, 2);
  expect_error_line(outcome, {"-o", "cube.obj", "input"});
  EXPECT_EQ(run({"inspect", "cube.obj", "--json", "cube.obj"}).exit_code, 2);
  EXPECT_EQ(read_text(in_folder("cube.obj")), kCube);
}

TEST_F(Tool, tells_a_file_without_a_finite_triangle_from_a_wrong_one) {
  write_text(in_folder("nothing.obj"), "v nan 0 0\nv 0 0 0\nv 1 1 1\nf 1 2 3\n");
  const Outcome outcome = run({"mesh", "nothing.obj", "-o", "x.msh"});
  EXPECT_EQ(outcome.exit_code, 4);
  expect_error_line(outcome, {"nothing.obj", "1 with non-finite"});
  EXPECT_EQ(run({"field", "nothing.obj", "-o", "x.vti"}).exit_code, 4);
  EXPECT_EQ(run({"inspect", "nothing.obj"}).exit_code, 0);
  EXPECT_EQ(files(), (Words{"cube.obj", "nothing.obj"}));
}

TEST_F(Tool, refuses_a_grid_that_does_not_fit_and_says_what_would) {
  write_text(in_folder("cube.msh"), "an older result");
  const Outcome outcome = run({"mesh", "cube.obj", "-o", "cube.msh", "--voxels", "1000", "--memory", "0.01"});
  EXPECT_EQ(outcome.exit_code, 2);
  expect_error_line(outcome, {"voxels"});
  EXPECT_EQ(read_text(in_folder("cube.msh")), "an older result");
  EXPECT_EQ(files(), (Words{"cube.msh", "cube.obj"}));
}

TEST_F(Tool, a_report_that_cannot_be_written_is_an_error_and_leaves_no_mesh) {
  if (!fs::exists("/dev/full")) GTEST_SKIP() << "needs /dev/full";
  const Outcome outcome = run({"mesh", "cube.obj", "-o", "cube.msh", "--voxels", "24", "--json", "-"}, "/dev/full");
  EXPECT_EQ(outcome.exit_code, 3);
  expect_error_line(outcome, {"standard output"});
  EXPECT_EQ(files(), Words{"cube.obj"});
}

TEST_F(Tool, help_that_cannot_be_written_is_an_error) {
  if (!fs::exists("/dev/full")) GTEST_SKIP() << "needs /dev/full";
  for (const Words& words : {Words{"--help"}, Words{"mesh", "--help"}, Words{"--version"}, Words{}}) {
    const Outcome outcome = run(words, "/dev/full");
    EXPECT_EQ(outcome.exit_code, 3);
    expect_error_line(outcome, {"standard output"});
  }
}

TEST_F(Tool, sends_a_tet_mesh_to_inspect) {
  ASSERT_EQ(mesh_cube({"-q"}).exit_code, 0);
  const Outcome outcome = run({"mesh", "cube.msh", "-o", "x.msh"});
  EXPECT_EQ(outcome.exit_code, 3);
  expect_error_line(outcome, {"cube.msh", "tetsoup inspect"});
}

}  // namespace

}  // namespace tetsoup::test
