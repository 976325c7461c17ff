// What each engine wants, as a table; docs/FORMATS.md says where each wish was read.
#pragma once

#include <map>
#include <string_view>
#include <vector>

#include "tetsoup/engines.h"

namespace tetsoup {

/// In alphabetical order.
std::vector<Engine> engine_table();

/// Other names that people know an engine by.
const std::map<std::string_view, std::string_view>& engine_aliases();

}  // namespace tetsoup
