// The head of a request as a browser sends it, and no more of HTTP than the studio's page needs.
#pragma once

#include <string>
#include <string_view>

namespace tetsoup::cli {

struct HttpRequest {
  /// 200, or why it is refused: 400, 405, 413 (it brings a body), 505.
  int status = 200;
  bool head_only = false;  ///< HEAD instead of GET.
  std::string host;        ///< As given, lower case.
  /// Decoded, of segments that are names: begins with '/', has neither an empty segment nor "." or "..", no backslash,
  /// no NUL or other control character. What follows a '?' is dropped.
  std::string path;
};

/// @param head  From the first byte to the empty line, which it includes.
HttpRequest parse_http_request(std::string_view head);

}  // namespace tetsoup::cli
