// Nothing in a file is passed over: keys that are not known, values of another type, keys given twice.
#include <algorithm>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <set>

#include "base/listing.h"
#include "scene/check.h"
#include "scene/problem.h"
#include "scene/source.h"
#include "tetsoup/error.h"
#include "tetsoup/scene.h"

namespace tetsoup {

namespace scene {
namespace {

using Json = nlohmann::json;

/// The value as it stands in the file, not too long for a line.
std::string as_written(const Json& value) {
  constexpr std::size_t kMost = 40;
  std::string text = value.dump(-1, ' ', false, Json::error_handler_t::replace);
  if (text.size() <= kMost) return text;
  text.resize(kMost);
  while (!text.empty() && (static_cast<unsigned char>(text.back()) & 0x80U) != 0) text.pop_back();
  return text + "...";
}

[[noreturn]] void fail_type(const std::string& path, std::string_view wanted, const Json& value) {
  throw Problem(path, as_written(value) + " is not " + std::string(wanted));
}

double read_number(const std::string& path, const Json& value, const Range& range) {
  if (!value.is_number()) fail_type(path, "a number; give " + std::string(range.words), value);
  const double number = value.get<double>();
  check_number(path, number, range);
  return number;
}

/// 1e3 is as good as 1000.
template <class Whole>
Whole read_whole(const std::string& path, const Json& value, const Range& range) {
  const double number = read_number(path, value, range);
  if (number != std::floor(number)) fail_type(path, "whole; give " + std::string(range.words), value);
  return static_cast<Whole>(number);
}

const Json& read_array(const std::string& path, const Json& value, std::size_t size, std::string_view wanted) {
  if (!value.is_array() || value.size() != size) fail_type(path, wanted, value);
  return value;
}

class Reader {
 public:
  Reader(std::string path, const Json& object) : path_(std::move(path)), object_(object) {
    if (!object.is_object())
      fail_type(path_.empty() ? "the scene" : path_, "an object, as in {\"key\": value}", object);
  }

  template <class Member, class Rule>
  void operator()(std::string_view key, Member& member, const Rule& rule) {
    if (const Json* const value = find(key)) read(member_path(path_, key), *value, member, rule);
  }
  void angle(std::string_view key, double& radians, const Range& degrees) {
    if (const Json* const value = find(key)) radians = read_number(member_path(path_, key), *value, degrees) * kDegree;
  }
  void angles(std::string_view key, Vec3d& radians, const Range& degrees) {
    const Json* const value = find(key);
    if (value == nullptr) return;
    read(member_path(path_, key), *value, radians, degrees);
    radians = {radians.x * kDegree, radians.y * kDegree, radians.z * kDegree};
  }
  /// An array of places, or an object that is a grid.
  void instances(std::string_view key, SceneBody& body) {
    const Json* const value = find(key);
    if (value == nullptr) return;
    const std::string path = member_path(path_, key);
    if (value->is_object()) return read(path, *value, body.grid.emplace(), Object{});
    if (!value->is_array()) fail_type(path, "an array of places or an object with a count", *value);
    if (value->empty()) throw Problem(path, "there is no instance in it; leave it out for one at \"place\"");
    for (std::size_t i = 0; i < value->size(); ++i)
      read(item_path(path, i), (*value)[i], body.instances.emplace_back(body.place), Object{});
  }
  /// true, false, or the name of a file.
  void surface(std::string_view key, SceneBody& body) {
    const Json* const value = find(key);
    if (value == nullptr) return;
    if (value->is_string()) {
      body.surface_file = value->get<std::string>();
      if (body.surface_file.empty()) throw Problem(member_path(path_, key), "the name of the file is missing");
    } else if (value->is_boolean()) {
      body.surface = value->get<bool>();
    } else {
      fail_type(member_path(path_, key), "true, false or the name of a file", *value);
    }
  }

  /// @throws Problem  if a key was not asked for.
  void finish() const {
    for (const auto& [key, value] : object_.items()) {
      if (std::find(known_.begin(), known_.end(), key) != known_.end()) continue;
      throw Problem(member_path(path_, as_written(key)), "there is no such key here; there are " + listing(known_));
    }
  }

 private:
  const Json* find(std::string_view key) {
    known_.push_back(key);
    const auto found = object_.find(key);
    return found == object_.end() ? nullptr : &*found;
  }

  template <class Member, class Rule>
  static void read(const std::string& path, const Json& value, std::optional<Member>& member, const Rule& rule) {
    Member read_one{};
    read(path, value, read_one, rule);
    member = std::move(read_one);
  }
  static void read(const std::string& path, const Json& value, double& member, const Range& range) {
    member = read_number(path, value, range);
  }
  template <class Whole>
  requires std::is_integral_v<Whole>
  static void read(const std::string& path, const Json& value, Whole& member, const Range& range) {
    member = read_whole<Whole>(path, value, range);
  }
  static void read(const std::string& path, const Json& value, Vec3d& member, const Range& range) {
    const Json& three = read_array(path, value, 3, "three numbers, as in [0, 0, 1]");
    std::array<double, 3> n{};
    for (std::size_t i = 0; i < 3; ++i) n[i] = read_number(item_path(path, i), three[i], range);
    member = {n[0], n[1], n[2]};
  }
  static void read(const std::string& path, const Json& value, std::array<int, 3>& member, const Range& range) {
    const Json& three = read_array(path, value, 3, "three whole numbers, as in [5, 5, 5]");
    for (std::size_t i = 0; i < 3; ++i) member[i] = read_whole<int>(item_path(path, i), three[i], range);
  }
  static void read(const std::string& path, const Json& value, Box3& member, const Corners& corners) {
    const Json& two = read_array(path, value, 2, "two corners, as in [[0, 0, 0], [1, 1, 1]]");
    read(item_path(path, 0), two[0], member.lo, corners.range);
    read(item_path(path, 1), two[1], member.hi, corners.range);
  }
  static void read(const std::string& path, const Json& value, std::string& member, const Text&) {
    if (!value.is_string()) fail_type(path, "a text in quotation marks", value);
    member = value.get<std::string>();
    if (member.empty() || member.find('\0') != std::string::npos) throw Problem(path, "the text is empty");
  }
  template <class Value, std::size_t size>
  static void read(const std::string& path, const Json& value, Value& member, const Words<Value, size>& words) {
    const std::string given = value.is_string() ? value.get<std::string>() : value.dump();
    for (const Word<Value>& word : words.all) {
      if (given == word.word) {
        member = word.value;
        return;
      }
    }
    fail_type(path, "one of " + listing(words.all, [](const Word<Value>& word) { return word.word; }), value);
  }
  template <class Member>
  requires HasFields<Member>
  static void read(const std::string& path, const Json& value, Member& member, const Object&) {
    Reader reader(path, value);
    visit_fields(reader, member);
    reader.finish();
  }
  template <class Member>
  static void read(const std::string& path, const Json& value, std::vector<Member>& members, const Objects&) {
    if (!value.is_array()) fail_type(path, "an array, as in [{...}, {...}]", value);
    for (std::size_t i = 0; i < value.size(); ++i) read(item_path(path, i), value[i], members.emplace_back(), Object{});
  }

  std::string path_;
  const Json& object_;
  std::vector<std::string_view> known_;
};

/// "line 3, column 7" of the last byte that was read.
std::string place_in(std::string_view text, std::size_t byte) {
  const std::string_view before = text.substr(0, std::min(byte > 0 ? byte - 1 : 0, text.size()));
  const auto line = 1 + std::count(before.begin(), before.end(), '\n');
  const std::size_t start = before.rfind('\n') == std::string_view::npos ? 0 : before.rfind('\n') + 1;
  return "line " + std::to_string(line) + ", column " + std::to_string(before.size() - start + 1);
}

/// Refuses keys that are given twice, of which the library would take the last. A pass of its own: parsing with a
/// callback asks all elements of an array again at the end of each.
class KeyWatch : public nlohmann::json_sax<Json> {
 public:
  explicit KeyWatch(const char* name) : name_(name) {}

  bool start_object(std::size_t) override { return enter(); }
  bool start_array(std::size_t) override { return enter(); }
  bool end_object() override { return leave(); }
  bool end_array() override { return leave(); }
  bool key(std::string& key) override {
    if (open_.back().insert(key).second) return true;
    throw Problem(as_written(key), "this key is given twice in one object");
  }
  bool null() override { return true; }
  bool boolean(bool) override { return true; }
  bool number_integer(std::int64_t) override { return true; }
  bool number_unsigned(std::uint64_t) override { return true; }
  bool number_float(double, const std::string&) override { return true; }
  bool string(std::string&) override { return true; }
  bool binary(Json::binary_t&) override { return true; }
  /// Who parses the text in earnest says it.
  bool parse_error(std::size_t, const std::string&, const nlohmann::detail::exception&) override { return false; }

 private:
  bool enter() {
    constexpr std::size_t kDeepest = 16;  // scenes are five deep
    if (open_.size() > kDeepest) throw Problem(name_, "brackets are nested too deeply");
    open_.emplace_back();
    return true;
  }
  bool leave() {
    open_.pop_back();
    return true;
  }

  const char* name_;
  std::vector<std::set<std::string>> open_;
};

Json parse_json(std::string_view text, const char* name) {
  KeyWatch watch(name);
  Json::sax_parse(text.begin(), text.end(), &watch);
  try {
    return Json::parse(text.begin(), text.end());
  } catch (const Json::parse_error& error) {
    const std::string what = error.what();
    const std::size_t reason = what.find("; last read");
    const std::size_t first = what.find("syntax error while parsing");
    throw Problem(place_in(text, error.byte),
                  first == std::string::npos ? "this is not JSON" : "not JSON: " + what.substr(first, reason - first));
  } catch (const Json::exception&) {
    throw Problem(name, "a number is too large");
  }
}

}  // namespace
}  // namespace scene

Scene parse_scene(std::string_view text, const std::filesystem::path& folder, std::string_view name) {
  try {
    const nlohmann::json json = scene::parse_json(text, "the scene");
    scene::Reader reader("", json);
    Scene result;
    scene::visit_fields(reader, result);
    reader.finish();
    result.folder = folder;
    scene::check(result);
    return result;
  } catch (const scene::Problem& problem) {
    throw IoError(std::string(name) + ": " + problem.what());
  }
}

namespace scene {
namespace {

/// A part of a scene that stands alone.
template <class Struct>
Struct parse_part(std::string_view text, const char* name) {
  try {
    const Json json = parse_json(text, name);
    Reader reader(name, json);
    Struct result;
    visit_fields(reader, result);
    reader.finish();
    return result;
  } catch (const Problem& problem) {
    throw InvalidInput(problem.what());
  }
}

}  // namespace
}  // namespace scene

MeshOptions parse_mesh_options(std::string_view text) {
  return scene::parse_part<MeshOptions>(text, "mesh");
}
SimulationOptions parse_simulation_options(std::string_view text) {
  return scene::parse_part<SimulationOptions>(text, "simulation");
}
SimMaterial parse_material(std::string_view text) {
  return scene::parse_part<SimMaterial>(text, "material");
}
Pose parse_place(std::string_view text) {
  return scene::pose_of(scene::parse_part<ScenePlace>(text, "place"));
}

Scene read_scene(const std::filesystem::path& path) {
  std::error_code error;
  if (std::filesystem::is_directory(path, error))
    throw IoError(path.string() + ": this is a folder; name a file in it");
  std::ifstream file(path, std::ios::binary);
  if (!file) throw IoError(path.string() + ": cannot be read; check the path and its permissions");
  const std::string text{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  if (file.bad()) throw IoError(path.string() + ": cannot be read to its end");
  return parse_scene(text, path.parent_path(), path.filename().string());
}

}  // namespace tetsoup
