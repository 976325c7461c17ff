// Which reader takes a file of tets, told from its first bytes, else from its extension.
#include <array>
#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <system_error>

#include "base/origin.h"
#include "io/file_names.h"
#include "io/tet_readers.h"
#include "tetsoup/error.h"
#include "tetsoup/io.h"

namespace tetsoup {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t kHeadBytes = 256;  // Enough for blanks, comments or an XML declaration before the first word.

struct Close {
  void operator()(std::FILE* file) const { std::fclose(file); }
};

[[noreturn]] void fail_with_errno(const fs::path& path) {
  throw IoError("cannot read '" + path.string() + "': " + std::error_code(errno, std::generic_category()).message());
}

// Reads to the end rather than asking for the size, so that pipes work; stops at `most` bytes.
std::string read_bytes(const fs::path& path, std::size_t most) {
  errno = 0;
  const std::unique_ptr<std::FILE, Close> file(std::fopen(path.c_str(), "rb"));
  if (!file) fail_with_errno(path);
  std::string bytes;
  std::array<char, 1 << 16> block;
  while (bytes.size() < most) {
    const std::size_t got = std::fread(block.data(), 1, std::min(block.size(), most - bytes.size()), file.get());
    bytes.append(block.data(), got);
    if (got == 0) break;
  }
  if (std::ferror(file.get()) != 0) fail_with_errno(path);
  return bytes;
}

std::string read_whole(const fs::path& path) {
  return read_bytes(path, static_cast<std::size_t>(-1));
}

enum class Content { Msh, Vtk, Vtu, Medit, Npz, Tetgen, WrittenOnly, Unknown };

Content content_of(std::string_view head) {
  const auto begins = [&](std::string_view mark) { return head.starts_with(mark); };
  if (begins("# vtk DataFile")) return Content::Vtk;
  if (begins("$MeshFormat") || begins("$Comments")) return Content::Msh;
  if (head.substr(0, kHeadBytes).find("<VTKFile") != head.npos) return Content::Vtu;
  if (head.substr(0, kHeadBytes).find("MeshVersionFormatted") != head.npos) return Content::Medit;
  return Content::Unknown;
}

Content content_named(const std::string& extension) {
  if (extension == ".msh") return Content::Msh;
  if (extension == ".vtk") return Content::Vtk;
  if (extension == ".vtu") return Content::Vtu;
  if (extension == ".mesh") return Content::Medit;
  if (extension == ".npz") return Content::Npz;
  if (extension == ".node" || extension == ".ele" || extension == ".face") return Content::Tetgen;
  for (const TetFormatInfo& info : tet_formats())
    if (extension == info.extension && extension != ".obj") return Content::WrittenOnly;
  return Content::Unknown;
}

TetMesh read_tetgen_set(const fs::path& path) {
  const TetgenSet set = tetgen_set(path);
  return parse_tetgen(read_whole(set.nodes), set.nodes.string(), read_whole(set.tets), set.tets.string());
}

bool names_tetgen_set(const fs::path& path) {
  std::error_code error;
  return content_named(lower_extension(path)) == Content::Tetgen ||
         (!fs::exists(path, error) && path.extension().empty() && fs::exists(tetgen_set(path).nodes, error));
}

}  // namespace

TetMesh WideTetMesh::narrowed() && {
  const Vec3d origin = origin_of(vertices, flat(std::span<const Tet>(tets)));
  return {counted_from(origin, vertices), std::move(tets), origin};
}

TetMesh read_tets(const fs::path& path) {
  if (names_tetgen_set(path)) return read_tetgen_set(path);
  const std::string bytes = read_whole(path);
  const std::string name = path.string();
  Content content = content_of(bytes);
  if (content == Content::Unknown) content = content_named(lower_extension(path));
  switch (content) {
    case Content::Msh:
      return parse_msh(bytes, name);
    case Content::Vtk:
      return parse_vtk(bytes, name);
    case Content::Vtu:
      return parse_vtu(bytes, name);
    case Content::Medit:
      return parse_medit(bytes, name);
    case Content::Npz:
      return parse_npz(bytes, name);
    case Content::WrittenOnly:
      throw IoError(name + ": tetsoup writes such files but does not read them; it reads " + readable_tet_extensions());
    default:
      throw IoError(name + ": neither its extension nor its first bytes are those of a tet mesh (" +
                    readable_tet_extensions() + ")");
  }
}

bool is_tet_file(const fs::path& path) {
  if (content_named(lower_extension(path)) != Content::Unknown || names_tetgen_set(path)) return true;
  std::error_code error;
  if (!fs::is_regular_file(path, error)) return false;
  try {
    return content_of(read_bytes(path, kHeadBytes)) != Content::Unknown;
  } catch (const IoError&) {
    return false;
  }
}

}  // namespace tetsoup
