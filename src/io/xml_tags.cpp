#include "io/xml_tags.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace tetsoup {

namespace {

constexpr std::string_view kBlanks = " \t\r\n";

}  // namespace

std::string_view XmlTag::attribute(std::string_view key) const {
  std::string_view rest = attributes;
  while (true) {
    const std::size_t equals = rest.find('=');
    if (equals == rest.npos) return {};
    std::string_view found = rest.substr(0, equals);
    found.remove_prefix(std::min(found.find_first_not_of(kBlanks), found.size()));
    found = found.substr(0, found.find_first_of(kBlanks));
    const std::size_t open = rest.find_first_of("\"'", equals);
    if (open == rest.npos) return {};
    const std::size_t close = rest.find(rest[open], open + 1);
    if (close == rest.npos) return {};
    if (found == key) return rest.substr(open + 1, close - open - 1);
    rest.remove_prefix(close + 1);
  }
}

std::optional<XmlTag> next_tag(TetScanner& in) {
  while (in.skip_past("<")) {
    const std::string_view rest = in.text().substr(in.position());
    const bool comment = rest.starts_with("!--");
    const std::size_t begin = in.position();
    if (!in.skip_past(comment ? "-->" : ">")) in.fail(comment ? "a comment has no end" : "a tag has no end");
    if (comment || rest.starts_with('?') || rest.starts_with('!')) continue;
    XmlTag tag;
    std::string_view inside = in.text().substr(begin, in.position() - 1 - begin);
    tag.empty = inside.ends_with('/');
    if (tag.empty) inside.remove_suffix(1);
    tag.name = inside.substr(0, inside.find_first_of(kBlanks));
    tag.attributes = inside.substr(tag.name.size());
    return tag;
  }
  return std::nullopt;
}

std::string_view text_before_tag(const TetScanner& in) {
  const std::string_view rest = in.text().substr(in.position());
  return rest.substr(0, rest.find('<'));
}

std::size_t xml_line(const TetScanner& in) {
  const std::string_view before = in.text().substr(0, in.position());
  return 1 + static_cast<std::size_t>(std::count(before.begin(), before.end(), '\n'));
}

std::string unescaped_xml(std::string_view text) {
  constexpr std::pair<std::string_view, char> kEntities[] = {
      {"&amp;", '&'}, {"&lt;", '<'}, {"&gt;", '>'}, {"&quot;", '"'}, {"&apos;", '\''}};
  std::string result;
  while (!text.empty()) {
    const auto* const entity = std::find_if(std::begin(kEntities), std::end(kEntities),
                                            [&](const auto& known) { return text.starts_with(known.first); });
    const bool known = entity != std::end(kEntities);
    result += known ? entity->second : text.front();
    text.remove_prefix(known ? entity->first.size() : 1);
  }
  return result;
}

std::string escaped_xml(std::string_view text) {
  std::string result;
  for (const char c : text) {
    if (c == '&')
      result += "&amp;";
    else if (c == '<')
      result += "&lt;";
    else if (c == '"')
      result += "&quot;";
    else
      result += c;
  }
  return result;
}

}  // namespace tetsoup
