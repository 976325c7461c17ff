// The studio's server, over a connection as browsers and strangers open them: the bytes are what is sent. It answers or
// closes, and it answers the next one.
#include <netinet/in.h>
#include <sys/socket.h>

#include <csignal>
#include <fstream>
#include <thread>

#include "fuzz.h"
#include "studio_server.h"

namespace tetsoup::fuzz {
namespace {

struct Running {
  cli::StudioServer server;
  sockaddr_in address{};

  Running() : server({page(), own_folder() / "model.obj"}, std::nullopt) {
    const std::string text = server.address();
    const auto port = static_cast<std::uint16_t>(std::stoi(text.substr(text.find(':', text.find("//")) + 1)));
    address.sin_family = AF_INET;
    address.sin_port = htons(port);
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    std::thread([this] { server.serve(); }).detach();
  }

  static std::filesystem::path page() {
    std::ofstream(own_folder() / "model.obj") << "v 0 0 0\n";
    const std::filesystem::path folder = own_folder() / "page";
    std::filesystem::create_directories(folder);
    std::ofstream(folder / "index.html") << "<html></html>\n";
    return folder;
  }

  /// The answer to what is sent, if it comes within `patience`; a request that is not whole has none.
  std::string answer(std::string_view request, timeval patience) const {
    const int connection = ::socket(AF_INET, SOCK_STREAM, 0);
    expect(connection >= 0, "a socket");
    expect(::connect(connection, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0, "it listens");
    ::setsockopt(connection, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
    ::send(connection, request.data(), request.size(), MSG_NOSIGNAL);
    std::string text(1 << 16, '\0');
    std::size_t size = 0;
    for (ssize_t got = 0; (got = ::recv(connection, text.data() + size, text.size() - size, 0)) > 0;)
      size += static_cast<std::size_t>(got);
    ::close(connection);
    return text.substr(0, size);
  }
};

}  // namespace

void fuzz_one(Bytes bytes) {
  // Ends with the process.
  static const Running& running = *new Running;
  const std::string text(text_of(bytes));
  const std::string answer = running.answer(text, {0, 5000});
  expect(answer.empty() || answer.starts_with("HTTP/1."), "an answer is one of HTTP");
  static unsigned count = 0;
  constexpr unsigned kNowAndThen = 64;
  if (count++ % kNowAndThen == 0)
    expect(!running.answer("GET / HTTP/1.1\r\nHost: x\r\nConnection: close\r\n\r\n", {10, 0}).empty(),
           "the next one is answered");
}

}  // namespace tetsoup::fuzz
