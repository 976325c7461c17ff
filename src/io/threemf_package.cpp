#include "io/threemf_package.h"

#include <algorithm>
#include <array>
#include <optional>
#include <set>

#include "io/number_text.h"
#include "io/parse_number.h"
#include "io/xml_tags.h"
#include "io/zip_reader.h"

namespace tetsoup::readers::threemf {
namespace {

/// Names of parts begin with a slash, those of members do not.
std::string without_slash(std::string_view path) {
  while (path.starts_with('/')) path.remove_prefix(1);
  return std::string(path);
}

/// One part's text, read tag by tag.
class PartReader {
 public:
  PartReader(std::string_view text, const std::string& where, const std::string& path, Part& part)
      : in_(text, where), where_(where), path_(path), part_(part) {}

  void read() {
    while (const auto tag = next_tag(in_)) read_tag(*tag);
  }

 private:
  void read_tag(const XmlTag& tag) {
    if (tag.name == "vertex") {
      if (object_) object_->vertices.push_back({number(tag, "x"), number(tag, "y"), number(tag, "z")});
    } else if (tag.name == "triangle") {
      add_triangle(tag);
    } else if (tag.name == "object") {
      open_object(tag);
    } else if (tag.name == "/object") {
      object_ = nullptr;
    } else if (tag.name == "component") {
      if (object_) object_->components.push_back(placement(tag));
    } else if (tag.name == "item") {
      part_.items.push_back(placement(tag));
    } else if (tag.name == "basematerials") {
      group_ = &groups_[std::string(tag.attribute("id"))];
    } else if (tag.name == "base" && group_) {
      group_->push_back(static_cast<std::uint32_t>(part_.materials.size()));
      part_.materials.push_back(unescaped_xml(tag.attribute("name")));
    }
  }

  void open_object(const XmlTag& tag) {
    const std::string id(tag.attribute("id"));
    const auto [place, is_new] = part_.objects.try_emplace(id);
    if (!is_new) fail("there are two objects of id " + in_quotes(id.substr(0, 32)));
    object_ = &place->second;
    object_->name = unescaped_xml(tag.attribute("name"));
    object_group_ = tag.attribute("pid");
    object_material_ = material(object_group_, tag.attribute("pindex"), 0);
    if (tag.empty) object_ = nullptr;
  }

  void add_triangle(const XmlTag& tag) {
    if (!object_) return;
    const auto corner = [&](std::string_view key) { return vertex_index(number(tag, key)); };
    object_->triangles.push_back({corner("v1"), corner("v2"), corner("v3")});
    const std::string_view own = tag.attribute("pid"), entry = tag.attribute("p1");
    object_->materials.push_back(entry.empty() ? object_material_
                                               : material(own.empty() ? object_group_ : own, entry, object_material_));
  }

  /// `otherwise` where there is no such material: colours and textures have groups of their own.
  std::uint32_t material(std::string_view group, std::string_view entry, std::uint32_t otherwise) const {
    const auto found = groups_.find(std::string(group));
    double index = 0;
    if (found == groups_.end() || !parse_real(entry, index)) return otherwise;
    const std::uint32_t i = vertex_index(index);
    return i < found->second.size() ? found->second[i] : otherwise;
  }

  Placement placement(const XmlTag& tag) const {
    const std::string_view part = tag.attribute("p:path");
    return {part.empty() ? path_ : without_slash(part), std::string(tag.attribute("objectid")),
            transform(tag.attribute("transform"))};
  }

  /// Twelve numbers, three for what becomes of each axis and three for the place; none: nothing is moved.
  Affine transform(std::string_view text) const {
    Affine result;
    if (text.empty()) return result;
    const char* at = text.data();
    const char* const end = at + text.size();
    for (std::size_t i = 0; i < 12; ++i) {
      while (at != end && (*at == ' ' || *at == '\t' || *at == '\n' || *at == '\r')) ++at;
      if (!parse_number(at, end, result.rows[i % 3][i / 3])) fail("a transform is not twelve numbers");
    }
    return result;
  }

  double number(const XmlTag& tag, std::string_view key) const {
    const std::string_view text = tag.attribute(key);
    double value = 0;
    if (!parse_real(text, value))
      fail("<" + std::string(tag.name) + ">: '" + std::string(key) + "' is " +
           (text.empty() ? "missing" : "no number: " + in_quotes(text.substr(0, 32))));
    return value;
  }

  [[noreturn]] void fail(const std::string& what) const { fail_at_line(where_, xml_line(in_), what); }

  TetScanner in_;
  const std::string& where_;
  const std::string& path_;
  Part& part_;
  Object* object_ = nullptr;
  std::vector<std::uint32_t>* group_ = nullptr;
  std::map<std::string, std::vector<std::uint32_t>, std::less<>> groups_;
  std::string_view object_group_;
  std::uint32_t object_material_ = 0;
};

class PackageReader {
 public:
  explicit PackageReader(const Source& source)
      : bytes_(reinterpret_cast<const char*>(source.bytes.data()), source.bytes.size()),
        name_(source.name),
        members_(read_zip_directory(bytes_, name_, "a 3MF file")) {}

  Package read() {
    package_.root = find_root();
    std::vector<std::string> wanted{package_.root};
    std::set<std::string> known{package_.root};
    while (!wanted.empty()) {
      const std::string path = std::move(wanted.back());
      wanted.pop_back();
      const Part& part = read_part(path);
      const auto want = [&](const Placement& placement) {
        if (known.insert(placement.part).second) wanted.push_back(placement.part);
      };
      std::for_each(part.items.begin(), part.items.end(), want);
      for (const auto& [id, object] : part.objects)
        std::for_each(object.components.begin(), object.components.end(), want);
    }
    return std::move(package_);
  }

 private:
  const ZipMember* find(const std::string& path) const {
    const auto found = std::find_if(members_.begin(), members_.end(),
                                    [&](const ZipMember& member) { return without_slash(member.name) == path; });
    return found == members_.end() ? nullptr : &*found;
  }

  /// Text is packed to a tenth or a thirtieth; a file that says it is far more wants our memory.
  std::string unpack(const ZipMember& member) {
    constexpr std::size_t kFreeBytes = 1 << 24, kMostPerByte = 100;
    const std::size_t most = kFreeBytes + kMostPerByte * bytes_.size();
    std::string text = unpacked_member(bytes_, name_, member, most - std::min(most, package_.unpacked_bytes));
    package_.unpacked_bytes += text.size();
    return text;
  }

  std::string find_root() {
    if (const ZipMember* const relations = find("_rels/.rels")) {
      const std::string text = unpack(*relations);
      TetScanner in(text, name_);
      while (const auto tag = next_tag(in)) {
        if (tag->name == "Relationship" && tag->attribute("Type").ends_with("/3dmodel"))
          return without_slash(tag->attribute("Target"));
      }
    }
    return "3D/3dmodel.model";
  }

  const Part& read_part(const std::string& path) {
    const ZipMember* const member = find(path);
    if (!member) fail(name_, "holds no 3MF model: there is no part " + in_quotes(path.substr(0, 128)));
    const std::string where = name_ + ", " + path;
    const std::string text = unpack(*member);
    Part& part = package_.parts[path];
    PartReader(text, where, path, part).read();
    return part;
  }

  std::string_view bytes_;
  std::string name_;
  std::vector<ZipMember> members_;
  Package package_;
};

}  // namespace

Package read_package(const Source& source) {
  return PackageReader(source).read();
}

}  // namespace tetsoup::readers::threemf
