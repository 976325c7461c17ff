// The text of an .usda file: prims within prims, attributes one a line.
#pragma once

#include <array>
#include <concepts>
#include <cstdint>
#include <initializer_list>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "io/number_text.h"
#include "tetsoup/render_mesh.h"
#include "tetsoup/types.h"

namespace tetsoup {

class UsdaWriter {
 public:
  /// @param header  What stands between the first parentheses, a line each.
  explicit UsdaWriter(std::initializer_list<std::string> header);

  /// Opens a prim; what follows is in it until close(). `metadata`: lines such as `kind = "component"`.
  void open(std::string_view type, std::string_view name, const std::vector<std::string>& metadata = {});
  void close();

  /// `type name = value`, the value as it is; and `(metadata)` behind it.
  void line(std::string_view declaration, std::string_view value, std::string_view metadata = {});
  template <class T>
  void array(std::string_view declaration, std::span<const T> values, std::string_view metadata = {}) {
    std::string text = "[";
    const char* separator = "";
    for (const T& value : values) {
      append_value(text += separator, value);
      separator = ", ";
    }
    line(declaration, text += ']', metadata);
  }
  template <class T>
  void array(std::string_view declaration, const std::vector<T>& values, std::string_view metadata = {}) {
    array(declaration, std::span<const T>(values), metadata);
  }

  std::string take() { return std::move(text_); }

 private:
  static void append_value(std::string& text, float value);
  template <std::integral Integer>
  static void append_value(std::string& text, Integer value) {
    append_number(text, value);
  }
  template <class T, std::size_t kSize>
  static void append_value(std::string& text, const std::array<T, kSize>& values) {
    const char* separator = "(";
    for (const T& value : values) {
      append_value(text += separator, value);
      separator = ", ";
    }
    text += ')';
  }
  static void append_value(std::string& text, const Vec3& v) { append_value(text, std::array{v.x, v.y, v.z}); }
  static void append_value(std::string& text, const Vec2& v) { append_value(text, std::array{v.x, v.y}); }
  void indent() { text_.append(4 * depth_, ' '); }

  std::string text_;
  std::size_t depth_ = 0;
};

/// A text in quotes; what is no UTF-8 and what would end the line is replaced.
std::string usda_string(std::string_view text);
/// `prepend apiSchemas = ["A", "B"]`
std::string usda_schemas(std::initializer_list<std::string_view> schemas);

}  // namespace tetsoup
