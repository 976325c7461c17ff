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

  /// A connection on which that has been said.
  int connected(const std::string& text) const {
    const int connection = socket(AF_INET, SOCK_STREAM, 0);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(static_cast<std::uint16_t>(port_));
    inet_pton(AF_INET, "127.0.0.1", &address.sin_addr);
    EXPECT_EQ(connect(connection, reinterpret_cast<sockaddr*>(&address), sizeof address), 0);
    EXPECT_EQ(send(connection, text.data(), text.size(), MSG_NOSIGNAL), static_cast<ssize_t>(text.size()));
    return connection;
  }
  /// All that is answered until the other side ends it.
  std::string said_to(const std::string& text) const {
    const int connection = connected(text);
    std::string answer(4096, '\0');
    std::size_t size = 0;
    for (ssize_t count = 1; count > 0 && size < answer.size();) {
      count = recv(connection, answer.data() + size, answer.size() - size, 0);
      if (count > 0) size += static_cast<std::size_t>(count);
    }
    close(connection);
    answer.resize(size);
    return answer;
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

TEST_F(Studio, links_and_ends_of_strings_in_a_path_lead_nowhere) {
  std::filesystem::create_symlink(in_folder("secret.txt"), in_folder("page/link.txt"));
  std::filesystem::create_directory_symlink(in_folder(""), in_folder("page/up"));
  serve({});
  for (const char* path : {"/link.txt", "/up/secret.txt"}) EXPECT_EQ(get(path)->status, 404) << path;
  for (const char* path :
       {"/index.html%00", "/assets/app.js%00.css", "/assets%0aapp.js", "/assets%5capp.js", "/%zz", "/%"})
    EXPECT_EQ(get(path)->status, 400) << path;
  EXPECT_EQ(get("/index.html?%00")->status, 200);
}

TEST_F(Studio, the_page_may_load_nothing_but_its_own) {
  serve({});
  const std::string policy = get("/")->get_header_value("Content-Security-Policy");
  for (const char* part : {"default-src 'self'", "'wasm-unsafe-eval'", "object-src 'none'", "frame-ancestors 'none'"})
    EXPECT_NE(policy.find(part), policy.npos) << policy;
  EXPECT_EQ(policy.find("'unsafe-eval'"), policy.npos) << policy;
}

TEST_F(Studio, a_thousand_ranges_are_the_file_once) {
  const std::string megabyte(std::size_t{1} << 20, 'x');
  test::write_text(in_folder("page/large.txt"), megabyte);
  serve({});
  std::string ranges = "bytes=0-";
  for (int i = 0; i < 1000; ++i) ranges += ",0-";
  const auto answer = get("/large.txt", {{"Range", ranges}});
  ASSERT_TRUE(answer);
  EXPECT_EQ(answer->status, 200);
  EXPECT_EQ(answer->body, megabyte);
  EXPECT_EQ(get("/large.txt", {{"Range", "bytes=99999999999999999999-"}})->status, 200);
}

TEST_F(Studio, bodies_are_refused_before_they_are_sent) {
  serve({});
  const std::string at = "/ HTTP/1.1\r\nHost: 127.0.0.1:" + std::to_string(port_) + "\r\n";
  EXPECT_TRUE(said_to("POST " + at + "Content-Length: 99999999999\r\n\r\n").starts_with("HTTP/1.1 405"));
  EXPECT_TRUE(said_to("GET " + at + "Content-Length: 99999999999\r\n\r\n").starts_with("HTTP/1.1 413"));
  EXPECT_TRUE(said_to("GET " + at + "Transfer-Encoding: chunked\r\n\r\n").starts_with("HTTP/1.1 413"));
}

TEST_F(Studio, heads_that_are_none_are_refused) {
  serve({});
  const std::string host = "Host: 127.0.0.1:" + std::to_string(port_) + "\r\n";
  const auto code = [&](const std::string& text) { return said_to(text).substr(0, 12); };
  EXPECT_EQ(code("GET / HTTP/1.1\r\n" + host + "X: " + std::string(9000, 'x') + "\r\n\r\n"), "HTTP/1.1 431");
  EXPECT_EQ(code("GET / HTTP/1.1\r\n" + host + host + "\r\n"), "HTTP/1.1 400");
  EXPECT_EQ(code("GET / HTTP/1.1\r\n\r\n"), "HTTP/1.1 400");
  EXPECT_EQ(code("GET / HTTP/1.1\r\n" + host + "none\r\n\r\n"), "HTTP/1.1 400");
  EXPECT_EQ(code("GET / HTTP/9\r\n" + host + "\r\n"), "HTTP/1.1 505");
  EXPECT_EQ(code("hello\r\n\r\n"), "HTTP/1.1 400");
  const std::string head = said_to("HEAD / HTTP/1.1\r\n" + host + "\r\n");
  EXPECT_TRUE(head.starts_with("HTTP/1.1 200") && head.ends_with("\r\n\r\n")) << head;
}

TEST_F(Studio, those_who_only_wait_keep_nobody_out) {
  serve({});
  std::vector<int> slow;
  for (int i = 0; i < 300; ++i) slow.push_back(connected("GET / HT"));
  const auto start = std::chrono::steady_clock::now();
  const auto page = get("/");
  ASSERT_TRUE(page);
  EXPECT_EQ(page->status, 200);
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(3));
  for (const int one : slow) close(one);
}

TEST_F(Studio, whoever_does_not_end_a_head_is_cut_off) {
  serve({});
  const auto start = std::chrono::steady_clock::now();
  EXPECT_EQ(said_to("GET / HT"), "");
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(9));
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
