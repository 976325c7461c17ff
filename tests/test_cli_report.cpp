// Reports that people look at: what the page holds, and the flag that writes it.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "base/base64.h"
#include "run_tool.h"
#include "tetsoup/error.h"
#include "tetsoup/report.h"

namespace tetsoup {
namespace {

TetMesh corner() {
  return {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 1, 2, 3}}};
}

/// What the page would read.
nlohmann::json data_of(const std::string& html) {
  const std::string mark = "id=\"tetsoup-report\">";
  const std::size_t from = html.find(mark) + mark.size();
  return nlohmann::json::parse(html.substr(from, html.find("</script>", from) - from));
}

TEST(ReportPage, holds_the_mesh_and_is_one_page) {
  const TetMesh mesh = corner();
  ReportPage page;
  page.mesh = &mesh;
  page.title = "corner";
  const std::string html = report_page(page);
  EXPECT_EQ(html.rfind("<!doctype html>", 0), 0U);
  EXPECT_NE(html.find("</html>"), std::string::npos);
  const nlohmann::json data = data_of(html);
  EXPECT_EQ(data["title"], "corner");
  EXPECT_EQ(data["report"]["quality"]["tet_count"], 1);
  EXPECT_TRUE(data["report"]["readiness"]["checks"].is_object());
  EXPECT_TRUE(data["surface"].is_null());
  EXPECT_EQ(decode_base64(data["mesh"]["vertices"].get<std::string>())->size(), 4 * 3 * sizeof(float));
  EXPECT_EQ(decode_base64(data["mesh"]["tets"].get<std::string>())->size(), 4 * sizeof(std::uint32_t));
}

TEST(ReportPage, needs_nothing_from_anywhere) {
  const TetMesh mesh = corner();
  ReportPage page;
  page.mesh = &mesh;
  const std::string html = report_page(page);
  for (const char* address : {"<script src", "<link rel=\"stylesheet\"", "src=\"http", "href=\"http", "@import"})
    EXPECT_EQ(html.find(address), std::string::npos) << address;
}

TEST(ReportPage, names_cannot_end_the_script_that_holds_them) {
  const TetMesh mesh = corner();
  ReportPage page;
  page.mesh = &mesh;
  page.title = "</script><script>alert(1)</script><!--";
  page.json = R"({"input": "</script>"})";
  const std::string html = report_page(page);
  EXPECT_EQ(html.find("alert(1)</script>"), std::string::npos);
  EXPECT_EQ(data_of(html)["title"], page.title);
}

TEST(ReportPage, what_is_wrong_is_said) {
  const TetMesh mesh = corner();
  EXPECT_THROW(report_page({}), InvalidInput);
  ReportPage page;
  page.mesh = &mesh;
  page.up = "w";
  EXPECT_THROW(report_page(page), InvalidInput);
  page.up = "x";
  page.json = "[1, 2";
  EXPECT_THROW(report_page(page), InvalidInput);
}

class ReportFlag : public test::Tool {};

TEST_F(ReportFlag, writes_a_page_with_what_json_says) {
  ASSERT_EQ(run({"sample", "torus", "-o", "torus.obj", "-q"}).exit_code, 0);
  ASSERT_EQ(
      run({"mesh", "torus.obj", "-o", "torus.msh", "--report", "torus.html", "--voxels", "32", "--tets", "300", "-q"})
          .exit_code,
      0);
  const nlohmann::json data = data_of(test::read_text(in_folder("torus.html")));
  EXPECT_EQ(data["title"], "torus.obj");
  EXPECT_EQ(data["report"]["soup"]["class"], "closed");
  EXPECT_EQ(data["report"]["quality"]["inverted_tets"], 0);
  EXPECT_FALSE(data["surface"].is_null());
}

TEST_F(ReportFlag, needs_a_name_that_browsers_open) {
  ASSERT_EQ(run({"sample", "torus", "-o", "torus.obj", "-q"}).exit_code, 0);
  const test::Outcome outcome = run({"mesh", "torus.obj", "-o", "torus.msh", "--report", "torus.txt"});
  EXPECT_EQ(outcome.exit_code, 3);
  EXPECT_NE(outcome.err.find("--report"), std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(in_folder("torus.msh")));
}

}  // namespace
}  // namespace tetsoup
