// One thread and one poll() for all connections: none can block another, and each costs a few kilobytes whatever it
// sends. Bodies, ranges and connections that stay are not spoken here: browsers do without.
#include "studio_server.h"

#include <arpa/inet.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <chrono>
#include <list>
#include <utility>
#include <vector>

#include "http_request.h"
#include "interrupt.h"
#include "tetsoup/error.h"

namespace tetsoup::cli {

namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr const char* kHost = "127.0.0.1";
constexpr std::size_t kMostHeadBytes = 8192;
constexpr std::size_t kMostConnections = 128;
constexpr std::chrono::seconds kForHead{5};      ///< From the connection to the end of the head.
constexpr std::chrono::seconds kForPiece{10};    ///< Without a byte taken of the answer.
constexpr std::chrono::seconds kForFarewell{1};  ///< For what is still on its way when the answer is sent.
constexpr int kLook = 50;                        ///< Milliseconds between two looks at Ctrl-C.

/// Nothing of other origins, nothing that is not a file of the page; WebAssembly and its workers may run.
constexpr const char* kHeaders =
    "Cross-Origin-Opener-Policy: same-origin\r\n"
    "Cross-Origin-Embedder-Policy: require-corp\r\n"
    "Cross-Origin-Resource-Policy: same-origin\r\n"
    "Content-Security-Policy: default-src 'self'; script-src 'self' 'wasm-unsafe-eval' blob:; worker-src 'self' blob:; "
    "style-src 'self' 'unsafe-inline'; img-src 'self' data: blob:; font-src 'self' data:; connect-src 'self' data: "
    "blob:; "
    "object-src 'none'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'\r\n"
    "X-Content-Type-Options: nosniff\r\n"
    "Referrer-Policy: no-referrer\r\n"
    "Cache-Control: no-cache\r\n"
    "Connection: close\r\n";

const char* type_of(const fs::path& file) {
  static constexpr std::array<std::array<const char*, 2>, 11> kTypes{{{".html", "text/html"},
                                                                      {".js", "text/javascript"},
                                                                      {".mjs", "text/javascript"},
                                                                      {".css", "text/css"},
                                                                      {".wasm", "application/wasm"},
                                                                      {".json", "application/json"},
                                                                      {".svg", "image/svg+xml"},
                                                                      {".png", "image/png"},
                                                                      {".webp", "image/webp"},
                                                                      {".ico", "image/x-icon"},
                                                                      {".txt", "text/plain"}}};
  const std::string extension = file.extension().string();
  for (const auto& [name, type] : kTypes)
    if (extension == name) return type;
  return "application/octet-stream";
}

const char* reason_of(int status) {
  switch (status) {
    case 200:
      return "OK";
    case 403:
      return "Forbidden";
    case 404:
      return "Not Found";
    case 405:
      return "Method Not Allowed";
    case 413:
      return "Content Too Large";
    case 431:
      return "Request Header Fields Too Large";
    case 505:
      return "HTTP Version Not Supported";
    default:
      return "Bad Request";
  }
}

/// A name as part of an address.
std::string encoded(const std::string& name) {
  std::string text;
  for (const char c : name) {
    const bool plain = std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '.' || c == '-' || c == '_';
    text += plain ? std::string(1, c) : fmt::format("%{:02X}", static_cast<unsigned char>(c));
  }
  return text;
}

/// A file descriptor that is closed once.
class Descriptor {
 public:
  explicit Descriptor(int number = -1) : number_(number) {}
  Descriptor(Descriptor&& other) noexcept : number_(std::exchange(other.number_, -1)) {}
  Descriptor& operator=(Descriptor&& other) noexcept {
    std::swap(number_, other.number_);
    return *this;
  }
  ~Descriptor() {
    if (number_ >= 0) ::close(number_);
  }
  int get() const { return number_; }
  bool is_open() const { return number_ >= 0; }

 private:
  int number_;
};

struct Connection {
  enum class Doing { Reading, Answering, Leaving } doing = Doing::Reading;
  Descriptor socket;
  Clock::time_point deadline;
  std::string head;      ///< Of the request, so far.
  std::string answer;    ///< Still to be sent.
  Descriptor file;       ///< What follows the answer,
  std::size_t left = 0;  ///< this many bytes of it.
};

}  // namespace

struct StudioServer::State {
  StudioFiles files;
  fs::path page;  ///< Without symbolic links.
  Descriptor socket;
  int port = 0;
  std::list<Connection> connections;

  bool is_own_host(const std::string& host) const {
    return host == fmt::format("{}:{}", kHost, port) || host == fmt::format("localhost:{}", port);
  }

  /// Empty if there is none. Links in the page's folder could lead out of it; the model is whatever the user named.
  fs::path file_of(const std::string& path) const {
    if (files.model && path == "/model/" + files.model->filename().string()) return *files.model;
    const fs::path file = page / (path == "/" ? "index.html" : path.substr(1));
    std::error_code error;
    return fs::canonical(file, error) == file && !error ? file : fs::path();
  }

  void refuse(Connection& c, int status, bool head_only = false) const {
    const std::string text =
        status == 403 ? "This page is for the machine it is served from.\n" : std::string(reason_of(status)) + ".\n";
    c.answer = fmt::format("HTTP/1.1 {} {}\r\n{}Content-Type: text/plain\r\n{}Content-Length: {}\r\n\r\n", status,
                           reason_of(status), kHeaders, status == 405 ? "Allow: GET, HEAD\r\n" : "", text.size());
    if (!head_only) c.answer += text;
  }

  void answer(Connection& c) const {
    const HttpRequest request = parse_http_request(c.head);
    if (request.status != 200) return refuse(c, request.status);
    if (!is_own_host(request.host)) return refuse(c, 403, request.head_only);
    const fs::path path = file_of(request.path);
    struct stat status {};
    // Not to be blocked by a pipe of that name.
    if (!path.empty()) c.file = Descriptor(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
    if (!c.file.is_open() || ::fstat(c.file.get(), &status) != 0 || !S_ISREG(status.st_mode)) {
      c.file = Descriptor();
      return refuse(c, 404, request.head_only);
    }
    c.answer = fmt::format("HTTP/1.1 200 OK\r\n{}Content-Type: {}\r\nContent-Length: {}\r\n\r\n", kHeaders,
                           type_of(path), status.st_size);
    if (!request.head_only) c.left = static_cast<std::size_t>(status.st_size);
  }

  void listen(std::optional<int> wanted);
  void accept_all();
  bool go_on(Connection& c) const;
  bool read_head(Connection& c) const;
  static bool send_more(Connection& c);
  bool stays(Connection& c) const;
  void look();
};

void StudioServer::State::listen(std::optional<int> wanted) {
  socket = Descriptor(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
  // Not SO_REUSEPORT: two servers would share a port by turns.
  const int yes = 1;
  ::setsockopt(socket.get(), SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<std::uint16_t>(wanted.value_or(0)));
  ::inet_pton(AF_INET, kHost, &address.sin_addr);
  auto* const any = reinterpret_cast<sockaddr*>(&address);
  socklen_t size = sizeof address;
  if (::bind(socket.get(), any, size) != 0 || ::listen(socket.get(), SOMAXCONN) != 0 ||
      ::getsockname(socket.get(), any, &size) != 0) {
    if (wanted)
      throw IoError(fmt::format("--port: {} is taken or not allowed; leave it out for one that is free", *wanted));
    throw IoError("no port of 127.0.0.1 is free");
  }
  port = ntohs(address.sin_port);
}

/// Where there are too many, the one that has waited longest goes: those that only wait cannot keep others out.
void StudioServer::State::accept_all() {
  for (;;) {
    Descriptor accepted(::accept4(socket.get(), nullptr, nullptr, SOCK_CLOEXEC | SOCK_NONBLOCK));
    if (!accepted.is_open()) return;
    if (connections.size() >= kMostConnections) {
      const auto reads = [](const Connection& c) { return c.doing != Connection::Doing::Answering; };
      const auto oldest = std::find_if(connections.begin(), connections.end(), reads);
      connections.erase(oldest == connections.end() ? connections.begin() : oldest);
    }
    Connection& c = connections.emplace_back();
    c.socket = std::move(accepted);
    c.deadline = Clock::now() + kForHead;
  }
}

bool StudioServer::State::read_head(Connection& c) const {
  std::array<char, 4096> bytes;
  const ssize_t count = ::recv(c.socket.get(), bytes.data(), bytes.size(), 0);
  if (count < 0) return errno == EAGAIN || errno == EINTR;
  if (count == 0) return false;
  c.head.append(bytes.data(), static_cast<std::size_t>(count));
  const std::size_t end = c.head.find("\r\n\r\n");
  if (end == c.head.npos && c.head.size() <= kMostHeadBytes) return true;
  if (end == c.head.npos || end > kMostHeadBytes) {
    refuse(c, 431);
  } else {
    c.head.resize(end + 4);
    answer(c);
  }
  c.doing = Connection::Doing::Answering;
  c.deadline = Clock::now() + kForPiece;
  return true;
}

bool StudioServer::State::send_more(Connection& c) {
  constexpr std::size_t kPiece = std::size_t{1} << 16;
  if (c.answer.empty() && c.left > 0) {
    c.answer.resize(std::min(kPiece, c.left));
    const ssize_t count = ::read(c.file.get(), c.answer.data(), c.answer.size());
    if (count <= 0) return false;  // The file has become shorter: the browser sees that the answer is cut off.
    c.answer.resize(static_cast<std::size_t>(count));
    c.left -= c.answer.size();
  }
  const ssize_t sent = ::send(c.socket.get(), c.answer.data(), c.answer.size(), MSG_NOSIGNAL);
  if (sent < 0) return errno == EAGAIN || errno == EINTR;
  c.answer.erase(0, static_cast<std::size_t>(sent));
  c.deadline = Clock::now() + kForPiece;
  if (c.answer.empty() && c.left == 0) {
    // What is on its way must be taken, or the system would cut off the answer with it.
    ::shutdown(c.socket.get(), SHUT_WR);
    c.file = Descriptor();
    c.doing = Connection::Doing::Leaving;
    c.deadline = Clock::now() + kForFarewell;
  }
  return true;
}

/// @return  Whether the connection stays.
bool StudioServer::State::go_on(Connection& c) const {
  if (c.doing == Connection::Doing::Reading) return read_head(c);
  if (c.doing == Connection::Doing::Answering) return send_more(c);
  std::array<char, 4096> unread;
  const ssize_t count = ::recv(c.socket.get(), unread.data(), unread.size(), 0);
  return count > 0 || (count < 0 && (errno == EAGAIN || errno == EINTR));
}

/// What goes wrong with one, be it memory, is no matter of the others.
bool StudioServer::State::stays(Connection& c) const {
  try {
    return go_on(c);
  } catch (const std::exception&) {
    return false;
  }
}

void StudioServer::State::look() {
  std::vector<pollfd> waiting{{socket.get(), POLLIN, 0}};
  for (const Connection& c : connections)
    waiting.push_back(
        {c.socket.get(), static_cast<short>(c.doing == Connection::Doing::Answering ? POLLOUT : POLLIN), 0});
  if (::poll(waiting.data(), waiting.size(), kLook) < 0) return;
  const auto now = Clock::now();
  std::size_t i = 1;
  for (auto c = connections.begin(); c != connections.end(); ++i) {
    const bool keep = now < c->deadline && (waiting[i].revents == 0 || stays(*c));
    c = keep ? std::next(c) : connections.erase(c);
  }
  if (waiting[0].revents != 0) accept_all();
}

StudioServer::StudioServer(const StudioFiles& files, std::optional<int> port) : state_(std::make_unique<State>()) {
  state_->files = files;
  state_->page = fs::canonical(files.page);
  state_->listen(port);
}

StudioServer::~StudioServer() = default;

std::string StudioServer::address() const {
  const std::string page = fmt::format("http://{}:{}/", kHost, state_->port);
  return state_->files.model ? page + "?model=" + encoded(state_->files.model->filename().string()) : page;
}

void StudioServer::serve() {
  while (!interrupted()) state_->look();
}

}  // namespace tetsoup::cli
