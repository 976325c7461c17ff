// Names come from files of strangers: what is no UTF-8 must not make the files that we write unreadable.
#pragma once

#include <string>
#include <string_view>

namespace tetsoup {

/// The characters of a UTF-8 text; each byte that belongs to none is U+FFFD.
std::u32string decode_utf8(std::string_view text);
std::string encode_utf8(std::u32string_view text);

}  // namespace tetsoup
