// The tags of an XML file one after another: as much XML as VTK's files, 3MF and Collada need, and no
// more.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "io/tet_scanner.h"

namespace tetsoup {

struct XmlTag {
  std::string_view name;        ///< With a leading '/' for an end tag.
  std::string_view attributes;  ///< Everything behind the name.
  bool empty = false;           ///< Ends with "/>".

  /// Value of an attribute, empty if it is not there.
  std::string_view attribute(std::string_view key) const;
};

/// Next tag; the scanner then stands behind it. Declarations and comments are skipped. Nothing at the end of the file.
std::optional<XmlTag> next_tag(TetScanner& in);

/// What stands between the scanner and the next tag.
std::string_view text_before_tag(const TetScanner& in);

/// The line that the scanner is in, from 1.
std::size_t xml_line(const TetScanner& in);

/// Text without its entities, as programs mean it.
std::string unescaped_xml(std::string_view text);

/// Text as it may stand in an attribute.
std::string escaped_xml(std::string_view text);

}  // namespace tetsoup
