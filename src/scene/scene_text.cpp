// A scene as a file for people to go on with: only what is not as by default, a place or a pin in one line.
#include <nlohmann/json.hpp>

#include "scene/problem.h"
#include "tetsoup/scene.h"

namespace tetsoup {

namespace scene {
namespace {

using Json = nlohmann::ordered_json;

Json vector_json(const Vec3d& v) {
  return Json::array({v.x, v.y, v.z});
}

/// All members of a struct.
class Writer {
 public:
  template <class Member, class Rule>
  void operator()(std::string_view key, const Member& member, const Rule& rule) {
    if (Json value = write(member, rule); !value.is_null()) object[std::string(key)] = std::move(value);
  }
  void angle(std::string_view key, double radians, const Range&) { object[std::string(key)] = degrees_of(radians); }
  void angles(std::string_view key, const Vec3d& radians, const Range&) {
    object[std::string(key)] = vector_json({degrees_of(radians.x), degrees_of(radians.y), degrees_of(radians.z)});
  }
  void instances(std::string_view key, const SceneBody& body) {
    if (body.grid) object[std::string(key)] = write(*body.grid, Object{});
    // A place takes from the body's what it does not say itself.
    for (const ScenePlace& place : body.instances) object[std::string(key)].push_back(changed(place, body.place));
  }
  void surface(std::string_view key, const SceneBody& body) {
    if (!body.surface) object[std::string(key)] = false;
    if (!body.surface_file.empty()) object[std::string(key)] = body.surface_file;
  }

  template <class Struct>
  static Json all(const Struct& value) {
    Writer writer;
    visit_fields(writer, const_cast<Struct&>(value));
    return writer.object;
  }
  /// Members that differ from those of another.
  template <class Struct>
  static Json changed(const Struct& value, const Struct& from) {
    const Json whole = all(value), other = all(from);
    Json result = Json::object();
    for (const auto& [key, member] : whole.items())
      if (!other.contains(key) || other[key] != member) result[key] = member;
    return result;
  }

  Json object = Json::object();

 private:
  template <class Member, class Rule>
  static Json write(const std::optional<Member>& member, const Rule& rule) {
    return member ? write(*member, rule) : Json();
  }
  template <class Number>
  requires std::is_arithmetic_v<Number>
  static Json write(Number member, const Range&) { return member; }
  static Json write(const Vec3d& member, const Range&) { return vector_json(member); }
  static Json write(const std::array<int, 3>& member, const Range&) { return member; }
  static Json write(const Box3& member, const Corners&) {
    return Json::array({vector_json(member.lo), vector_json(member.hi)});
  }
  static Json write(const std::string& member, const Text&) { return member.empty() ? Json() : Json(member); }
  template <class Value, std::size_t size>
  static Json write(const Value& member, const Words<Value, size>& words) {
    for (const Word<Value>& word : words.all)
      if (word.value == member) return word.word;
    return {};
  }
  template <class Member>
  requires HasFields<Member>
  static Json write(const Member& member, const Object&) {
    Json object = changed(member, Member{});
    return object.empty() && !std::is_same_v<Member, ScenePlane> && !std::is_same_v<Member, SceneGrid> ? Json()
                                                                                                       : object;
  }
  template <class Member>
  static Json write(const std::vector<Member>& members, const Objects&) {
    Json array = Json::array();
    for (const Member& member : members) array.push_back(changed(member, Member{}));
    return array.empty() ? Json() : array;
  }
};

/// Values without objects in them stand in one line.
bool is_short(const Json& value, int depth = 0) {
  constexpr std::size_t kLine = 100;
  if (value.is_object() && depth == 0 && value.dump().size() > kLine) return false;
  for (const auto& item : value)
    if ((item.is_object() && !item.empty()) || (item.is_structured() && !is_short(item, depth + 1))) return false;
  return value.dump().size() <= kLine;
}

std::string spaced(const Json& value) {
  if (value.is_number_float()) return number_words(value.get<double>());
  if (!value.is_structured()) return value.dump(-1, ' ', false, Json::error_handler_t::replace);
  std::string text(value.is_object() ? "{" : "[");
  bool first = true;
  for (const auto& [key, item] : value.items()) {
    text += first ? "" : ", ";
    first = false;
    if (value.is_object()) text += Json(key).dump() + ": ";
    text += spaced(item);
  }
  return text + (value.is_object() ? "}" : "]");
}

void append(std::string& text, const Json& value, std::size_t indent) {
  if (!value.is_structured() || is_short(value)) {
    text += spaced(value);
    return;
  }
  text += value.is_object() ? "{" : "[";
  bool first = true;
  for (const auto& [key, item] : value.items()) {
    text += first ? "\n" : ",\n";
    first = false;
    text += std::string(indent + 2, ' ');
    if (value.is_object()) text += Json(key).dump() + ": ";
    append(text, item, indent + 2);
  }
  text += "\n" + std::string(indent, ' ') + (value.is_object() ? "}" : "]");
}

}  // namespace
}  // namespace scene

std::string scene_text(const Scene& scene) {
  scene::Json json = scene::Writer::changed(scene, Scene{});
  // What everybody wants to change first is there to be changed.
  const scene::Json all = scene::Writer::all(scene);
  scene::Json ordered = scene::Json::object();
  for (const char* key : {"title", "seconds", "fps", "gravity", "solver", "substeps"})
    if (all.contains(key)) ordered[key] = all[key];
  for (const auto& [key, value] : json.items()) ordered[key] = value;
  std::string text;
  scene::append(text, ordered, 0);
  return text + "\n";
}

}  // namespace tetsoup
