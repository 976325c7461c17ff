// Base64, as VTK's XML files hold binary data in.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace tetsoup {

void append_base64(std::string& text, std::string_view bytes);

/// Blanks are skipped; stops at the padding. Nothing if there is any other character.
std::optional<std::string> decode_base64(std::string_view text);

}  // namespace tetsoup
