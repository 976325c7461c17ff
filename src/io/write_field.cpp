// The distance field and the pseudo volume as VTK ImageData, array by array, without a second copy in memory.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>

#include "base/require.h"
#include "base/vec.h"
#include "io/atomic_file.h"
#include "io/number_text.h"
#include "io/raw_numbers.h"
#include "tetsoup/io.h"

namespace tetsoup {

namespace {

struct FieldArray {
  const char* name;
  const char* type;
  std::size_t width;  // Bytes a value.
};

constexpr std::array<FieldArray, 4> kArrays{
    {{"distance", "Float32", 4}, {"signed_distance", "Float32", 4}, {"votes", "UInt8", 1}, {"inside", "UInt8", 1}}};

void append_triple(std::string& text, const char* attribute, double x, double y, double z) {
  text += ' ';
  text += attribute;
  text += "=\"";
  append_number(text, x);
  append_number(text += ' ', y);
  append_number(text += ' ', z);
  text += '"';
}

void append_extent(std::string& text, const char* attribute, const std::array<int, 3>& size) {
  text += ' ';
  text += attribute;
  text += "=\"";
  for (std::size_t axis = 0; axis < 3; ++axis) append_number(text += axis == 0 ? "0 " : " 0 ", size[axis] - 1);
  text += '"';
}

void append_constant(std::string& text, const char* name, double value) {
  text += "      <DataArray type=\"Float64\" Name=\"";
  text += name;
  text += "\" NumberOfTuples=\"1\" format=\"ascii\">";
  append_number(text, value);
  text += "</DataArray>\n";
}

std::string header_of(const DistanceField& field) {
  const GridFrame& frame = field.distance.frame;
  std::string text =
      "<?xml version=\"1.0\"?>\n"
      "<VTKFile type=\"ImageData\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">\n"
      "  <!-- Values lie at voxel centres. Distances of known_up_to or more are not known and stand as known_up_to;\n"
      "       signed_distance is negative inside. -->\n"
      "  <ImageData";
  append_extent(text, "WholeExtent", frame.size);
  const Vec3d origin = frame.origin + frame.soup_origin;
  append_triple(text, "Origin", origin.x, origin.y, origin.z);
  append_triple(text, "Spacing", frame.voxel_size, frame.voxel_size, frame.voxel_size);
  text += ">\n    <FieldData>\n";
  if (std::isfinite(field.band)) append_constant(text, "known_up_to", field.band);
  append_constant(text, "d_max", field.d_max);
  text += "    </FieldData>\n    <Piece";
  append_extent(text, "Extent", frame.size);
  text += ">\n      <PointData Scalars=\"signed_distance\">\n";
  std::size_t offset = 0;
  for (const FieldArray& array : kArrays) {
    text += std::string("        <DataArray type=\"") + array.type + "\" Name=\"" + array.name +
            "\" format=\"appended\" offset=\"" + std::to_string(offset) + "\"/>\n";
    offset += sizeof(std::uint64_t) + array.width * frame.voxel_count();
  }
  text +=
      "      </PointData>\n    </Piece>\n  </ImageData>\n"
      "  <AppendedData encoding=\"raw\">\n   _";
  return text;
}

// Writes append_value(buffer, x, y, z) of every voxel, a slice at a time.
template <class AppendValue>
void write_array(AtomicFile& file, const FieldArray& array, const GridFrame& frame, const AppendValue& append_value) {
  std::string buffer;
  append_raw(buffer, static_cast<std::uint64_t>(array.width * frame.voxel_count()));
  for (int z = 0; z < frame.size[2]; ++z) {
    for (int y = 0; y < frame.size[1]; ++y)
      for (int x = 0; x < frame.size[0]; ++x) append_value(buffer, x, y, z);
    file.write(buffer);
    buffer.clear();
  }
}

}  // namespace

void write_field(const std::filesystem::path& path, const DistanceField& field, const PseudoVolume& volume) {
  const GridFrame& frame = field.distance.frame;
  require(frame == volume.votes.frame && frame == volume.inside.frame, "volume", "another grid", "on the field's grid");
  // What is not known lies at the band or beyond; readers choke on infinity, so the band stands for it.
  const float limit = std::min(narrow(field.band), std::numeric_limits<float>::max());
  const auto distance = [&](int x, int y, int z) {
    const float d = field.distance.at(x, y, z);
    return d < limit ? d : limit;
  };
  AtomicFile file(path);
  file.write(header_of(field));
  write_array(file, kArrays[0], frame,
              [&](std::string& buffer, int x, int y, int z) { append_raw(buffer, distance(x, y, z)); });
  write_array(file, kArrays[1], frame, [&](std::string& buffer, int x, int y, int z) {
    append_raw(buffer, volume.inside.test(x, y, z) ? -distance(x, y, z) : distance(x, y, z));
  });
  write_array(file, kArrays[2], frame, [&](std::string& buffer, int x, int y, int z) {
    append_raw(buffer, static_cast<std::uint8_t>(volume.votes.at(x, y, z)));
  });
  write_array(file, kArrays[3], frame, [&](std::string& buffer, int x, int y, int z) {
    append_raw(buffer, static_cast<std::uint8_t>(volume.inside.test(x, y, z) ? 1 : 0));
  });
  file.write("\n  </AppendedData>\n</VTKFile>\n");
  file.commit();
}

}  // namespace tetsoup
