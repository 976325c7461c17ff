// What zip files pack with: DEFLATE [RFC 1951], the one direction that is needed.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace tetsoup {

/// The bytes that were packed; nothing if the packed ones are damaged or hold more than `most`. Memory grows with what
/// is really there.
std::optional<std::string> inflate(std::string_view packed, std::size_t most);

}  // namespace tetsoup
