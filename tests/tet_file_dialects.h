// The dialects that other programs write and ours do not: binary, mixed cells, tags with gaps.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/base64.h"
#include "io/number_text.h"
#include "io/raw_numbers.h"
#include "tetsoup/types.h"

namespace tetsoup {

template <class Number>
void append_big_endian(std::string& bytes, Number value) {
  std::string raw;
  append_raw(raw, value);
  bytes.append(raw.rbegin(), raw.rend());
}

/// Node tags 10, 13, 16, ... in two blocks, the second parametric; a triangle block stands before the tets.
inline std::string msh41_binary(const TetMesh& mesh) {
  std::string b = "$MeshFormat\n4.1 1 8\n";
  append_raw(b, std::int32_t{1});
  b += "\n$EndMeshFormat\n$PhysicalNames\n1\n3 1 \"a $Nodes b\"\n$EndPhysicalNames\n$Nodes\n";
  const std::uint64_t count = mesh.vertices.size(), half = count / 2;
  for (const std::uint64_t head : {std::uint64_t{2}, count, std::uint64_t{10}, 3 * count + 7}) append_raw(b, head);
  for (int block = 0; block < 2; ++block) {
    const std::uint64_t begin = block == 0 ? 0 : half, end = block == 0 ? half : count;
    for (const std::int32_t head : {block == 0 ? 3 : 2, 1, block}) append_raw(b, head);
    append_raw(b, end - begin);
    for (std::uint64_t i = begin; i < end; ++i) append_raw(b, 10 + 3 * i);
    for (std::uint64_t i = begin; i < end; ++i) {
      const Vec3& v = mesh.vertices[i];
      for (const float c : {v.x, v.y, v.z}) append_raw(b, static_cast<double>(c));
      for (int u = 0; block == 1 && u < 2; ++u) append_raw(b, 0.5);
    }
  }
  b += "\n$EndNodes\n$Elements\n";
  const std::uint64_t tets = mesh.tets.size();
  for (const std::uint64_t head : {std::uint64_t{2}, tets + 1, std::uint64_t{1}, tets + 1}) append_raw(b, head);
  for (const std::int32_t head : {2, 1, 2}) append_raw(b, head);
  for (const std::uint64_t number : {1U, 1U, 10U, 13U, 16U}) append_raw(b, number);
  for (const std::int32_t head : {3, 1, 4}) append_raw(b, head);
  append_raw(b, tets);
  for (std::uint64_t i = 0; i < tets; ++i) {
    append_raw(b, i + 2);
    for (const std::uint64_t vertex : mesh.tets[i]) append_raw(b, 10 + 3 * vertex);
  }
  return b + "\n$EndElements\n";
}

inline std::string msh22_binary(const TetMesh& mesh) {
  std::string b = "$MeshFormat\n2.2 1 8\n";
  append_raw(b, std::int32_t{1});
  b += "\n$EndMeshFormat\n$Nodes\n" + std::to_string(mesh.vertices.size()) + "\n";
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    append_raw(b, static_cast<std::int32_t>(5 * i + 2));
    for (const float c : {mesh.vertices[i].x, mesh.vertices[i].y, mesh.vertices[i].z})
      append_raw(b, static_cast<double>(c));
  }
  b += "\n$EndNodes\n$Elements\n" + std::to_string(mesh.tets.size() + 1) + "\n";
  for (const std::int32_t number : {2, 1, 2, 1, 0, 0, 2, 7, 12}) append_raw(b, number);
  for (const std::int32_t number : {4, static_cast<std::int32_t>(mesh.tets.size()), 1}) append_raw(b, number);
  for (std::size_t i = 0; i < mesh.tets.size(); ++i) {
    append_raw(b, static_cast<std::int32_t>(i + 2));
    append_raw(b, std::int32_t{0});
    for (const std::uint32_t vertex : mesh.tets[i]) append_raw(b, static_cast<std::int32_t>(5 * vertex + 2));
  }
  return b + "\n$EndElements\n";
}

/// Binary, doubles, with a field before and a metadata section after the points, a triangle before the tets.
inline std::string vtk_binary(const TetMesh& mesh) {
  std::string b =
      "# vtk DataFile Version 4.2\nvtk output\nBINARY\nDATASET UNSTRUCTURED_GRID\nFIELD FieldData 2\nTIME 1 1 double\n";
  append_big_endian(b, 0.25);
  b += "\nNOTES 1 2 string\n\xC3"
       "a b\x80\x02"
       "cd";
  b += "\nPOINTS " + std::to_string(mesh.vertices.size()) + " double\n";
  for (const Vec3& v : mesh.vertices)
    for (const float c : {v.x, v.y, v.z}) append_big_endian(b, static_cast<double>(c));
  b += "\nMETADATA\nINFORMATION 0\n\nCELLS " + std::to_string(mesh.tets.size() + 1) + " " +
       std::to_string(5 * mesh.tets.size() + 4) + "\n";
  for (const std::int32_t number : {3, 0, 1, 2}) append_big_endian(b, number);
  for (const Tet& tet : mesh.tets) {
    append_big_endian(b, std::int32_t{4});
    for (const std::uint32_t vertex : tet) append_big_endian(b, static_cast<std::int32_t>(vertex));
  }
  b += "\nCELL_TYPES " + std::to_string(mesh.tets.size() + 1) + "\n";
  append_big_endian(b, std::int32_t{5});
  for (std::size_t i = 0; i < mesh.tets.size(); ++i) append_big_endian(b, std::int32_t{10});
  return b + "\nCELL_DATA " + std::to_string(mesh.tets.size() + 1) + "\n";
}

/// Version 5.1 as meshio writes it, text or binary.
inline std::string vtk51(const TetMesh& mesh, bool binary) {
  std::string b = "# vtk DataFile Version 5.1\nwritten by another\n";
  b += binary ? "BINARY\n" : "ASCII\n";
  const auto put = [&](auto value) {
    if (binary)
      append_big_endian(b, value);
    else
      append_number(b, value), b += ' ';
  };
  b += "DATASET UNSTRUCTURED_GRID\nPOINTS " + std::to_string(mesh.vertices.size()) + " float\n";
  for (const Vec3& v : mesh.vertices)
    for (const float c : {v.x, v.y, v.z}) put(c);
  b += "\nCELLS " + std::to_string(mesh.tets.size() + 1) + " " + std::to_string(4 * mesh.tets.size()) +
       "\nOFFSETS vtktypeint64\n";
  for (std::size_t i = 0; i <= mesh.tets.size(); ++i) put(static_cast<std::int64_t>(4 * i));
  b += "\nCONNECTIVITY vtktypeint64\n";
  for (const Tet& tet : mesh.tets)
    for (const std::uint32_t vertex : tet) put(static_cast<std::int64_t>(vertex));
  b += "\nCELL_TYPES " + std::to_string(mesh.tets.size()) + "\n";
  for (std::size_t i = 0; i < mesh.tets.size(); ++i) put(std::int32_t{10});
  return b + "\n";
}

enum class VtuData { Text, AppendedRaw, AppendedBase64, BigEndian };

/// With a triangle before the tets, 32-bit integers and headers.
inline std::string vtu(const TetMesh& mesh, VtuData data) {
  std::string appended,
      b = "<?xml version=\"1.0\"?>\n<!-- a <Piece> to skip -->\n<VTKFile type='UnstructuredGrid' version=\"0.1\"";
  b += data == VtuData::BigEndian ? " byte_order=\"BigEndian\"" : " byte_order=\"LittleEndian\"";
  b += ">\n<UnstructuredGrid>\n<Piece NumberOfPoints=\"" + std::to_string(mesh.vertices.size()) +
       "\" NumberOfCells=\"" + std::to_string(mesh.tets.size() + 1) + "\">\n";
  const auto put_array = [&](const std::string& attributes, const auto& values) {
    b += "<DataArray " + attributes + " format=\"";
    if (data == VtuData::Text) {
      b += "ascii\">\n";
      for (const auto value : values) append_number(b, value), b += ' ';
      b += "\n</DataArray>\n";
      return;
    }
    const auto put = [&](std::string& bytes, auto value) {
      data == VtuData::BigEndian ? append_big_endian(bytes, value) : append_raw(bytes, value);
    };
    std::string raw;
    put(raw, static_cast<std::uint32_t>(values.size() * sizeof values[0]));
    for (const auto value : values) put(raw, value);
    if (data == VtuData::BigEndian) {
      append_base64(b += "binary\">\n ", raw);
      b += "\n</DataArray>\n";
    } else {
      b += "appended\" offset=\"" + std::to_string(appended.size()) + "\"/>\n";
      data == VtuData::AppendedRaw ? void(appended += raw) : append_base64(appended, raw);
    }
  };
  std::vector<float> points;
  for (const Vec3& v : mesh.vertices) points.insert(points.end(), {v.x, v.y, v.z});
  std::vector<std::int32_t> corners{0, 1, 2}, offsets{3};
  for (const Tet& tet : mesh.tets) {
    for (const std::uint32_t vertex : tet) corners.push_back(static_cast<std::int32_t>(vertex));
    offsets.push_back(offsets.back() + 4);
  }
  std::vector<std::int32_t> types(mesh.tets.size() + 1, 10);
  types[0] = 5;
  b += "<PointData/>\n<Points>\n";
  put_array("type=\"Float32\" NumberOfComponents=\"3\"", points);
  b += "</Points>\n<Cells>\n";
  put_array("type=\"Int32\" Name=\"connectivity\"", corners);
  put_array("Name=\"offsets\" type=\"Int32\"", offsets);
  put_array("type=\"Int32\" Name=\"types\"", types);
  b += "</Cells>\n</Piece>\n</UnstructuredGrid>\n";
  if (!appended.empty()) {
    b += data == VtuData::AppendedRaw ? "<AppendedData encoding=\"raw\">\n_" : "<AppendedData encoding=\"base64\">\n_";
    b += appended + "\n</AppendedData>\n";
  }
  return b + "</VTKFile>\n";
}

/// Keywords that hold no tets before, between and after ours; comments; Windows line ends.
inline std::string medit_with_extras(const TetMesh& mesh) {
  std::string b = "# a comment\r\nMeshVersionFormatted\r\n2\r\nDimension\r\n3\r\nVertices\r\n";
  append_line(b, mesh.vertices.size());
  for (const Vec3& v : mesh.vertices) append_line(b, v.x, v.y, v.z, 7);
  b += "Corners 2\n1\n2\nTriangles\n1\n1 2 3 4\nRequiredTriangles\n1\n1\n# again\nTetrahedra\n";
  append_line(b, mesh.tets.size());
  for (const Tet& t : mesh.tets) append_line(b, t[0] + 1, t[1] + 1, t[2] + 1, t[3] + 1, 3);
  return b + "Normals\n1\n0 0 1\nRidges\n0\nEnd\n";
}

/// Counted from 1, with attributes, markers and comments, as TetGen writes them.
inline std::string tetgen_nodes_from_one(const TetMesh& mesh) {
  std::string b = "# nodes\n" + std::to_string(mesh.vertices.size()) + "  3  1  1\n";
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    const Vec3& v = mesh.vertices[i];
    append_line(b += "   ", i + 1, v.x, v.y, v.z, 0.5F, -1);
  }
  return b + "# Generated by tetgen\n";
}
inline std::string tetgen_tets_from_one(const TetMesh& mesh) {
  std::string b = std::to_string(mesh.tets.size()) + "  4  1\n";
  for (std::size_t i = 0; i < mesh.tets.size(); ++i) {
    const Tet& t = mesh.tets[i];
    append_line(b += "   ", i + 1, t[0] + 1, t[1] + 1, t[2] + 1, t[3] + 1, 2);
  }
  return b + "# Generated by tetgen\n";
}

}  // namespace tetsoup
