// tetsoup studio as a browser meets it: what is served, with which headers, and what is refused.
#include <gtest/gtest.h>
#include <httplib.h>
#include <ifaddrs.h>
#include <netinet/in.h>
#include <signal.h>

#include <chrono>
#include <string>
#include <thread>

#include "run_tool.h"

namespace tetsoup {
namespace {

/// A page of three files, served by the tool until the test ends.
class Studio : public test::Tool {
 protected:
  void SetUp() override {
    Tool::SetUp();
    std::filesystem::create_directories(in_folder("page/assets"));
    test::write_text(in_folder("page/index.html"), "<!doctype html>page");
    test::write_text(in_folder("page/assets/app.js"), "export {}");
    test::write_text(in_folder("page/assets/core.wasm"), std::string("\0asm", 4));
    test::write_text(in_folder("secret.txt"), "secret");
  }
  void TearDown() override {
    stop();
    Tool::TearDown();
  }

  /// Starts the server and waits until it says where it is.
  void serve(std::vector<std::string> more) {
    std::vector<std::string> words{"studio", "--page", "page"};
    words.insert(words.end(), more.begin(), more.end());
    const std::string out = in_folder("out.txt").string(), err = in_folder("err.txt").string();
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    constexpr int kMode = 0600;
    posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, out.c_str(), O_WRONLY | O_CREAT | O_TRUNC, kMode);
    posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, err.c_str(), O_WRONLY | O_CREAT | O_TRUNC, kMode);
    child_ = start(words, actions);
    posix_spawn_file_actions_destroy(&actions);
    for (int i = 0; i < 500 && said_.find("Ctrl-C") == said_.npos; ++i) {
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
      said_ = test::read_text(out);
    }
    const std::string before = "http://127.0.0.1:";
    const std::size_t at = said_.find(before);
    ASSERT_NE(at, said_.npos) << said_ << test::read_text(err);
    port_ = std::stoi(said_.substr(at + before.size()));
  }

  /// @return  The exit code.
  int stop() {
    if (child_ <= 0) return -1;
    kill(child_, SIGINT);
    return wait_for(std::exchange(child_, -1));
  }

  httplib::Result get(const std::string& path, const httplib::Headers& headers = {}) const {
    httplib::Client client("127.0.0.1", port_);
    return client.Get(path, headers);
  }

  std::string said_;
  int port_ = 0;

 private:
  pid_t child_ = -1;
};

TEST_F(Studio, the_page_is_served_isolated_and_with_its_types) {
  serve({});
  const auto page = get("/");
  ASSERT_TRUE(page);
  EXPECT_EQ(page->status, 200);
  EXPECT_EQ(page->body, "<!doctype html>page");
  EXPECT_EQ(page->get_header_value("Cross-Origin-Opener-Policy"), "same-origin");
  EXPECT_EQ(page->get_header_value("Cross-Origin-Embedder-Policy"), "require-corp");
  EXPECT_EQ(page->get_header_value("Content-Type"), "text/html");
  EXPECT_EQ(get("/assets/app.js")->get_header_value("Content-Type"), "text/javascript");
  const auto core = get("/assets/core.wasm");
  EXPECT_EQ(core->get_header_value("Content-Type"), "application/wasm");
  EXPECT_EQ(core->get_header_value("Cross-Origin-Embedder-Policy"), "require-corp");
  EXPECT_EQ(core->body, std::string("\0asm", 4));
}

TEST_F(Studio, nothing_but_the_page_is_served) {
  serve({});
  EXPECT_EQ(get("/nothing.js")->status, 404);
  for (const char* path : {"/../secret.txt", "/%2e%2e/secret.txt", "/assets/../../secret.txt", "/..%2fsecret.txt",
                           "/model/secret.txt", "/model/../secret.txt", "/model/..%2fsecret.txt", "//secret.txt"}) {
    const auto answer = get(path);
    ASSERT_TRUE(answer) << path;
    EXPECT_NE(answer->status, 200) << path;
    EXPECT_EQ(answer->body.find("secret"), std::string::npos) << path;
  }
}

TEST_F(Studio, a_model_is_offered_under_its_own_name) {
  std::filesystem::rename(in_folder("cube.obj"), in_folder("a cube & more.obj"));
  serve({"a cube & more.obj"});
  EXPECT_NE(said_.find("/?model=a%20cube%20%26%20more.obj\n"), said_.npos) << said_;
  const auto model = get("/model/a%20cube%20%26%20more.obj");
  ASSERT_TRUE(model);
  EXPECT_EQ(model->status, 200);
  EXPECT_EQ(model->body, test::kCube);
  EXPECT_EQ(get("/model/other.obj")->status, 404);
}

TEST_F(Studio, pages_of_other_hosts_cannot_ask) {
  serve({});
  EXPECT_EQ(get("/", {{"Host", "evil.example:80"}})->status, 403);
  EXPECT_EQ(get("/", {{"Host", "127.0.0.1:1"}})->status, 403);
  EXPECT_EQ(get("/", {{"Host", "localhost:" + std::to_string(port_)}})->status, 200);
}

TEST_F(Studio, other_machines_cannot_connect) {
  serve({});
  ifaddrs* all = nullptr;
  ASSERT_EQ(getifaddrs(&all), 0);
  for (const ifaddrs* one = all; one != nullptr; one = one->ifa_next) {
    if (one->ifa_addr == nullptr || one->ifa_addr->sa_family != AF_INET) continue;
    char name[INET_ADDRSTRLEN] = "";
    const auto* const address = reinterpret_cast<const sockaddr_in*>(one->ifa_addr);
    inet_ntop(AF_INET, &address->sin_addr, name, sizeof name);
    if (std::string(name).starts_with("127.")) continue;
    httplib::Client client(name, port_);
    client.set_connection_timeout(1);
    EXPECT_FALSE(client.Get("/")) << name;
  }
  freeifaddrs(all);
}

TEST_F(Studio, ctrl_c_ends_it) {
  serve({});
  EXPECT_EQ(stop(), 0);
  EXPECT_FALSE(get("/"));
}

TEST_F(Studio, a_port_that_is_taken_is_named) {
  serve({});
  const test::Outcome second = run({"studio", "--page", "page", "--port", std::to_string(port_)}, "/dev/null");
  EXPECT_EQ(second.exit_code, 3);
  expect_error_line(second, {"--port", std::to_string(port_)});
}

TEST_F(Studio, what_is_missing_is_said) {
  const test::Outcome no_page = run({"studio", "--page", "."});
  EXPECT_EQ(no_page.exit_code, 3);
  expect_error_line(no_page, {"index.html"});
  const test::Outcome no_model = run({"studio", "--page", "page", "none.obj"});
  EXPECT_EQ(no_model.exit_code, 3);
  expect_error_line(no_model, {"none.obj"});
  const test::Outcome no_port = run({"studio", "--page", "page", "--port", "70000"});
  EXPECT_EQ(no_port.exit_code, 2);
  expect_error_line(no_port, {"--port", "65535"});
}

}  // namespace
}  // namespace tetsoup
