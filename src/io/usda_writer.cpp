#include "io/usda_writer.h"

#include <cmath>

#include "io/utf8.h"

namespace tetsoup {

UsdaWriter::UsdaWriter(std::initializer_list<std::string> header) : text_("#usda 1.0\n(\n") {
  for (const std::string& entry : header) text_ += "    " + entry + '\n';
  text_ += ")\n";
}

void UsdaWriter::open(std::string_view type, std::string_view name, const std::vector<std::string>& metadata) {
  text_ += '\n';
  indent();
  text_.append("def ").append(type).append(" \"").append(name).append("\"");
  if (!metadata.empty()) {
    text_ += " (\n";
    for (const std::string& entry : metadata) {
      indent();
      text_.append("    ").append(entry).append("\n");
    }
    indent();
    text_ += ')';
  }
  text_ += '\n';
  indent();
  text_ += "{\n";
  ++depth_;
}

void UsdaWriter::close() {
  --depth_;
  indent();
  text_ += "}\n";
}

void UsdaWriter::line(std::string_view declaration, std::string_view value, std::string_view metadata) {
  indent();
  text_.append(declaration).append(" = ").append(value);
  if (!metadata.empty()) text_.append(" (").append(metadata).append(")");
  text_ += '\n';
}

void UsdaWriter::append_value(std::string& text, float value) {
  if (std::isnan(value)) {
    text += "nan";  // A sign, which some NaN have, is refused.
  } else {
    append_float(text, value);
  }
}

std::string usda_string(std::string_view text) {
  std::u32string codes = decode_utf8(text);
  std::u32string quoted = U"\"";
  for (const char32_t code : codes) {
    if (code == U'"' || code == U'\\') quoted += U'\\';
    quoted += code < 0x20 || code == 0x7F ? U' ' : code;
  }
  return encode_utf8(quoted += U'"');
}

std::string usda_schemas(std::initializer_list<std::string_view> schemas) {
  std::string text = "prepend apiSchemas = [";
  const char* separator = "\"";
  for (const std::string_view schema : schemas) {
    text.append(separator).append(schema).append("\"");
    separator = ", \"";
  }
  return text += ']';
}

}  // namespace tetsoup
