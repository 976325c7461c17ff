// Where a glTF buffer's bytes come from when they are not in the file's own binary part.
#include "io/gltf_document.h"

namespace tetsoup::readers::gltf {
namespace {

int base64_digit(char c) {
  if (c >= 'A' && c <= 'Z') return c - 'A';
  if (c >= 'a' && c <= 'z') return c - 'a' + 26;
  if (c >= '0' && c <= '9') return c - '0' + 52;
  if (c == '+' || c == '-') return 62;
  if (c == '/' || c == '_') return 63;
  return -1;
}

int hex_digit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return -1;
}

std::string percent_decoded(std::string_view text) {
  std::string decoded;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool escape =
        text[i] == '%' && i + 2 < text.size() && hex_digit(text[i + 1]) >= 0 && hex_digit(text[i + 2]) >= 0;
    decoded += escape ? static_cast<char>(hex_digit(text[i + 1]) * 16 + hex_digit(text[i + 2])) : text[i];
    if (escape) i += 2;
  }
  return decoded;
}

}  // namespace

std::vector<std::byte> read_data_uri(const std::string& where, std::string_view uri) {
  constexpr std::string_view kMark = ";base64,";
  const std::size_t mark = uri.substr(0, 256).find(kMark);
  if (mark == std::string_view::npos) fail(where, "a data URI that is not base64");
  std::string_view text = uri.substr(mark + kMark.size());
  while (text.ends_with('=')) text.remove_suffix(1);
  std::vector<std::byte> bytes;
  bytes.reserve(text.size() / 4 * 3 + 2);
  unsigned bits = 0, bit_count = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const int digit = base64_digit(text[i]);
    if (digit < 0) fail(where, "character " + std::to_string(i) + " of its base64 data is none of base64");
    bits = (bits << 6 | static_cast<unsigned>(digit)) & 0xffff;
    bit_count += 6;
    if (bit_count < 8) continue;
    bit_count -= 8;
    bytes.push_back(static_cast<std::byte>(bits >> bit_count & 0xff));
  }
  return bytes;
}

std::filesystem::path resolve_file_uri(const std::string& where, const std::string& uri,
                                       const std::filesystem::path& folder) {
  namespace fs = std::filesystem;
  const std::string shown = in_quotes(std::string_view(uri).substr(0, 128));
  const std::string decoded = percent_decoded(uri);
  const fs::path relative(decoded);
  if (decoded.empty() || decoded.find('\0') != std::string::npos || decoded.find("://") != std::string::npos ||
      relative.is_absolute()) {
    fail(where, shown + " is not a path relative to the file");
  }
  std::error_code error;
  const fs::path root = fs::canonical(folder.empty() ? fs::path(".") : folder, error);
  const fs::path target = error ? fs::path() : fs::canonical(root / relative, error);
  if (error) fail(where, shown + ": " + error.message());
  const fs::path inside = target.lexically_relative(root);
  if (inside.empty() || *inside.begin() == "..") fail(where, shown + " lies outside the file's folder");
  return target;
}

}  // namespace tetsoup::readers::gltf
