// Names one after another, as messages list what there is.
#pragma once

#include <string>
#include <string_view>

namespace tetsoup {

/// "a, b, c": name_of(item) of all items.
template <class Items, class NameOf>
std::string listing(const Items& items, const NameOf& name_of) {
  std::string text;
  for (const auto& item : items) {
    if (!text.empty()) text += ", ";
    text += std::string_view(name_of(item));
  }
  return text;
}
template <class Names>
std::string listing(const Names& names) {
  return listing(
      names, [](const auto& name) -> const auto& { return name; });
}

}  // namespace tetsoup
