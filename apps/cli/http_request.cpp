#include "http_request.h"

#include <algorithm>
#include <cctype>
#include <optional>

namespace tetsoup::cli {

namespace {

constexpr std::string_view kLineEnd = "\r\n";

HttpRequest refused(int status) {
  HttpRequest request;
  request.status = status;
  return request;
}

int hex_value(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  const int letter = std::tolower(static_cast<unsigned char>(c));
  return letter >= 'a' && letter <= 'f' ? letter - 'a' + 10 : -1;
}

bool is_control(char c) {
  return static_cast<unsigned char>(c) < ' ' || c == '\x7f';
}

std::optional<std::string> decoded(std::string_view text) {
  std::string result;
  for (std::size_t i = 0; i < text.size(); ++i) {
    char c = text[i];
    if (c == '%') {
      const int high = i + 2 < text.size() ? hex_value(text[i + 1]) : -1, low = high < 0 ? -1 : hex_value(text[i + 2]);
      if (low < 0) return {};
      c = static_cast<char>(high * 16 + low);
      i += 2;
    }
    if (is_control(c) || c == '\\') return {};
    result += c;
  }
  return result;
}

/// "/" or "/name/name".
bool has_plain_segments(std::string_view path) {
  if (path == "/") return true;
  while (!path.empty()) {
    if (path.front() != '/') return false;
    path.remove_prefix(1);
    const std::string_view segment = path.substr(0, path.find('/'));
    if (segment.empty() || segment == "." || segment == "..") return false;
    path.remove_prefix(segment.size());
  }
  return true;
}

std::string lower(std::string_view text) {
  std::string result(text);
  std::transform(result.begin(), result.end(), result.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return result;
}

std::string_view trimmed(std::string_view text) {
  const auto is_blank = [](char c) { return c == ' ' || c == '\t'; };
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

/// The next line without its end; cut off `text`.
std::string_view take_line(std::string_view& text) {
  const std::size_t end = text.find(kLineEnd);
  const std::string_view line = text.substr(0, end);
  text.remove_prefix(end == text.npos ? text.size() : end + kLineEnd.size());
  return line;
}

/// "GET /path?query HTTP/1.1"
void read_request_line(std::string_view line, HttpRequest& request) {
  const std::size_t first = line.find(' '), last = line.rfind(' ');
  if (first == line.npos || first == last) {
    request.status = 400;
    return;
  }
  const std::string_view method = line.substr(0, first), version = line.substr(last + 1);
  const std::string_view target = line.substr(first + 1, last - first - 1);
  const auto path = decoded(target.substr(0, target.find('?')));
  if (version != "HTTP/1.1" && version != "HTTP/1.0")
    request.status = version.starts_with("HTTP/") ? 505 : 400;
  else if (method != "GET" && method != "HEAD")
    request.status = 405;
  else if (!path || path->empty() || !has_plain_segments(*path))
    request.status = 400;
  else
    request.path = *path;
  request.head_only = method == "HEAD";
}

}  // namespace

HttpRequest parse_http_request(std::string_view head) {
  HttpRequest request;
  read_request_line(take_line(head), request);
  if (request.status != 200) return refused(request.status);
  int hosts = 0;
  while (!head.empty()) {
    const std::string_view line = take_line(head);
    if (line.empty()) break;
    const std::size_t colon = line.find(':');
    if (colon == line.npos || colon == 0 ||
        std::any_of(line.begin(), line.begin() + static_cast<std::ptrdiff_t>(colon),
                    [](char c) { return is_control(c) || c == ' '; }))
      return refused(400);
    const std::string name = lower(line.substr(0, colon));
    const std::string_view value = trimmed(line.substr(colon + 1));
    if (std::any_of(value.begin(), value.end(), [](char c) { return is_control(c) && c != '\t'; })) return refused(400);
    if (name == "host") {
      ++hosts;
      request.host = lower(value);
    }
    if (name == "transfer-encoding" || (name == "content-length" && value != "0")) return refused(413);
  }
  return hosts == 1 ? request : refused(400);
}

}  // namespace tetsoup::cli
