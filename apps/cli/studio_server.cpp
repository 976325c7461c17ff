#include "studio_server.h"

#include <fmt/format.h>
#include <httplib.h>

#include <cctype>
#include <chrono>
#include <fstream>
#include <iterator>
#include <thread>

#include "interrupt.h"
#include "tetsoup/error.h"

namespace tetsoup::cli {

namespace {

constexpr const char* kHost = "127.0.0.1";

const httplib::Headers kHeaders{
    {"Cross-Origin-Opener-Policy", "same-origin"},
    {"Cross-Origin-Embedder-Policy", "require-corp"},
    {"Cross-Origin-Resource-Policy", "same-origin"},
    {"X-Content-Type-Options", "nosniff"},
    {"Cache-Control", "no-cache"},
};

/// A name as part of an address.
std::string encoded(const std::string& name) {
  std::string text;
  for (const char c : name) {
    const bool plain = std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '.' || c == '-' || c == '_';
    text += plain ? std::string(1, c) : fmt::format("%{:02X}", static_cast<unsigned char>(c));
  }
  return text;
}

}  // namespace

struct StudioServer::State {
  httplib::Server server;
  StudioFiles files;
  int port = 0;

  bool is_own_host(const std::string& host) const {
    return host == fmt::format("{}:{}", kHost, port) || host == fmt::format("localhost:{}", port);
  }

  void send_model(const httplib::Request& request, httplib::Response& response) const {
    response.status = 404;
    if (!files.model || request.path != "/model/" + files.model->filename().string()) return;
    std::ifstream file(*files.model, std::ios::binary);
    if (!file) return;
    response.status = 200;
    response.set_content(std::string(std::istreambuf_iterator<char>(file), {}), "application/octet-stream");
  }

  void describe() {
    server.set_default_headers(kHeaders);
    server.set_file_extension_and_mimetype_mapping("js", "text/javascript");
    server.set_file_extension_and_mimetype_mapping("mjs", "text/javascript");
    server.set_file_extension_and_mimetype_mapping("wasm", "application/wasm");
    server.set_pre_routing_handler([this](const httplib::Request& request, httplib::Response& response) {
      if (is_own_host(request.get_header_value("Host"))) return httplib::Server::HandlerResponse::Unhandled;
      response.status = 403;
      response.set_content("This page is for the machine it is served from.\n", "text/plain");
      return httplib::Server::HandlerResponse::Handled;
    });
    server.Get("/model/.*",
               [this](const httplib::Request& request, httplib::Response& response) { send_model(request, response); });
    server.set_mount_point("/", files.page.string());
    server.set_error_handler([](const httplib::Request&, httplib::Response& response) {
      if (response.status == 404 && response.body.empty()) response.set_content("Not found.\n", "text/plain");
    });
  }
};

StudioServer::StudioServer(const StudioFiles& files, std::optional<int> port) : state_(std::make_unique<State>()) {
  state_->files = files;
  state_->describe();
  // Not SO_REUSEPORT, as the library would have it: two servers would share a port by turns.
  state_->server.set_socket_options([](socket_t socket) {
    const int yes = 1;
    setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
  });
  if (port) {
    if (!state_->server.bind_to_port(kHost, *port))
      throw IoError(fmt::format("--port: {} is taken or not allowed; leave it out for one that is free", *port));
    state_->port = *port;
  } else {
    state_->port = state_->server.bind_to_any_port(kHost);
    if (state_->port <= 0) throw IoError("no port of 127.0.0.1 is free");
  }
}

StudioServer::~StudioServer() = default;

std::string StudioServer::address() const {
  const std::string page = fmt::format("http://{}:{}/", kHost, state_->port);
  return state_->files.model ? page + "?model=" + encoded(state_->files.model->filename().string()) : page;
}

void StudioServer::serve() {
  std::thread watcher([this] {
    constexpr auto kLook = std::chrono::milliseconds(50);
    while (!interrupted() || !state_->server.is_running()) std::this_thread::sleep_for(kLook);
    state_->server.stop();
  });
  state_->server.listen_after_bind();
  watcher.join();
}

}  // namespace tetsoup::cli
