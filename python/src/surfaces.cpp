// Render surfaces, the embedding that moves them with the tets, and what of a surface is nearest to a tet.
#include <nanobind/stl/filesystem.h>
#include <nanobind/stl/pair.h>

#include "arrays.h"
#include "bindings.h"
#include "progress.h"
#include "records.h"
#include "tetsoup/embed.h"
#include "tetsoup/io.h"
#include "tetsoup/label_volume.h"
#include "tetsoup/regions.h"
#include "tetsoup/render_mesh.h"

namespace tetsoup::python {

namespace {

namespace fs = std::filesystem;

using Names = std::tuple<std::string, std::string, std::string>;  // object, group, material

/// Names of strangers' files may be no UTF-8.
nb::str text_of(const std::string& name) {
  return nb::steal<nb::str>(PyUnicode_DecodeUTF8(name.data(), static_cast<Py_ssize_t>(name.size()), "replace"));
}

nb::typed<nb::list, nb::typed<nb::tuple, nb::str, nb::str, nb::str>> parts_of(const RenderMesh& mesh) {
  nb::typed<nb::list, nb::typed<nb::tuple, nb::str, nb::str, nb::str>> parts;
  for (const RenderMesh::Part& part : mesh.parts)
    parts.append(nb::make_tuple(text_of(part.object), text_of(part.group), text_of(part.material)));
  return parts;
}

RenderMesh make_surface(PointsIn vertices, IndicesIn face_sizes, IndicesIn corners, TexcoordsIn texcoords,
                        IndicesIn corner_texcoords, PointsIn normals, IndicesIn corner_normals,
                        const std::vector<Names>& parts, IndicesIn face_parts) {
  RenderMesh mesh{copy_rows<Vec3>(vertices),
                  copy_rows<std::uint32_t>(face_sizes),
                  copy_rows<std::uint32_t>(corners),
                  copy_rows<Vec2>(texcoords),
                  copy_rows<std::uint32_t>(corner_texcoords),
                  copy_rows<Vec3>(normals),
                  copy_rows<std::uint32_t>(corner_normals),
                  {},
                  copy_rows<std::uint32_t>(face_parts)};
  for (const auto& [object, group, material] : parts) mesh.parts.push_back({object, group, material});
  part_names(mesh);  // throws where sizes do not fit together
  return mesh;
}

/// A member as an array that keeps the surface alive.
template <class T, int Columns, auto Member>
auto rows(nb::handle_t<RenderMesh> self) {
  return rows_of<T, Columns>(nb::cast<const RenderMesh&>(self).*Member, self);
}
template <class T, auto Member>
auto list(nb::handle_t<RenderMesh> self) {
  return list_of<T>(nb::cast<const RenderMesh&>(self).*Member, self);
}

void bind_render_mesh(nb::module_& m) {
  using R = RenderMesh;
  nb::class_<R>(m, "RenderMesh")
      .def("__init__",
           [](R* self, PointsIn vertices, IndicesIn face_sizes, IndicesIn corners, TexcoordsIn texcoords,
              IndicesIn corner_texcoords, PointsIn normals, IndicesIn corner_normals, const std::vector<Names>& parts,
              IndicesIn face_parts) {
             new (self) R(make_surface(vertices, face_sizes, corners, texcoords, corner_texcoords, normals,
                                       corner_normals, parts, face_parts));
           })
      .def_prop_ro("vertices", &rows<float, 3, &R::vertices>)
      .def_prop_ro("face_sizes", &list<std::int32_t, &R::face_sizes>)
      .def_prop_ro("corners", &list<std::uint32_t, &R::corners>)
      .def_prop_ro("texcoords", &rows<float, 2, &R::texcoords>)
      .def_prop_ro("corner_texcoords", &list<std::int32_t, &R::corner_texcoords>)
      .def_prop_ro("normals", &rows<float, 3, &R::normals>)
      .def_prop_ro("corner_normals", &list<std::int32_t, &R::corner_normals>)
      .def_prop_ro("parts", [](const R& self) { return parts_of(self); })
      .def_prop_ro("face_parts", &list<std::int32_t, &R::face_parts>)
      .def("triangles",
           [](const R& self) {
             return owned_rows<std::uint32_t, 3>(call_unlocked([&] { return triangles_of(self).triangles; }));
           })
      .def("triangle_faces",
           [](const R& self) { return owned_list<std::int32_t>(call_unlocked([&] { return triangle_faces(self); })); })
      .def("with_vertices",
           [](const R& self, PointsIn vertices) {
             R moved = self;
             moved.vertices = copy_rows<Vec3>(vertices);
             moved.normals.clear();
             moved.corner_normals.clear();
             return moved;
           })
      .def("save", [](const R& self, const fs::path& path) { call_unlocked([&] { write_render_mesh(path, self); }); });
  m.def("read_render_mesh",
        [](const fs::path& path) { return call_unlocked([&] { return at_its_place(read_render_mesh(path)); }); });
}

void bind_embedding(nb::module_& m) {
  using E = Embedding;
  nb::class_<E>(m, "Embedding")
      .def("__init__",
           [](E* self, IndicesIn tets, WeightsIn weights, RealsIn distances, std::size_t inside, std::size_t outside,
              std::size_t drawn_closer, std::size_t other_copy, std::size_t non_finite, double max_distance) {
             new (self) E{copy_rows<std::uint32_t>(tets),
                          copy_rows<std::array<float, 4>>(weights),
                          copy_rows<float>(distances),
                          {inside, outside, drawn_closer, other_copy, non_finite, max_distance}};
           })
      .def_prop_ro("tets",
                   [](nb::handle_t<E> self) { return list_of<std::int32_t>(nb::cast<const E&>(self).tets, self); })
      .def_prop_ro("weights",
                   [](nb::handle_t<E> self) { return rows_of<float, 4>(nb::cast<const E&>(self).weights, self); })
      .def_prop_ro("distances",
                   [](nb::handle_t<E> self) { return list_of<float>(nb::cast<const E&>(self).distances, self); })
      .def_ro("report", &E::report)
      .def("deform",
           [](const E& self, const TetMesh& mesh, PointsIn positions) {
             return owned_rows<float, 3>(
                 call_unlocked([&] { return deform_points(self, mesh.tets, span_of<Vec3>(positions)); }));
           })
      .def("deform_normals",
           [](const E& self, const TetMesh& mesh, PointsIn positions, PointsIn normals) {
             return owned_rows<float, 3>(call_unlocked(
                 [&] { return deform_normals(self, mesh, span_of<Vec3>(positions), span_of<Vec3>(normals)); }));
           })
      .def("save", [](const E& self, const fs::path& path) { call_unlocked([&] { write_embedding(path, self); }); });
  m.def("read_embedding", [](const fs::path& path) { return call_unlocked([&] { return read_embedding(path); }); });
  m.def(
      "embed_points",
      [](const TetMesh& mesh, PointsIn vertices, FacesIn faces, std::optional<double> max_extrapolation,
         nb::object progress) {
        const TriangleSoup soup = copy_soup(vertices, faces);
        EmbedOptions options;
        options.max_extrapolation = max_extrapolation.value_or(options.max_extrapolation);
        return call_library(progress, [&](const Progress& watch) { return embed_points(mesh, soup, options, watch); });
      },
      nb::arg("mesh"), nb::arg("vertices"), nb::arg("faces"), nb::arg("max_extrapolation").none(),
      nb::arg("progress").none());
}

/// label_tets() or label_vertices().
template <class Function>
void bind_labels(nb::module_& m, const char* name, Function label) {
  m.def(
      name,
      [label](const TetMesh& mesh, PointsIn vertices, FacesIn faces, IndicesIn labels, nb::object progress) {
        const TriangleSoup soup = copy_soup(vertices, faces);
        const auto given = copy_rows<std::uint32_t>(labels);
        return owned_list<std::int32_t>(
            call_library(progress, [&](const Progress& watch) { return label(mesh, soup, given, watch); }));
      },
      nb::arg("mesh"), nb::arg("vertices"), nb::arg("faces"), nb::arg("labels"), nb::arg("progress").none());
}

void bind_regions(nb::module_& m) {
  bind_labels(m, "label_tets", &label_tets);
  bind_labels(m, "label_vertices", &label_vertices);
  m.def("label_parts", [](PointsIn vertices, FacesIn faces) {
    const TriangleSoup soup = copy_soup(vertices, faces);
    return owned_list<std::int32_t>(call_unlocked([&] { return label_parts(soup); }));
  });
  m.def("vertices_in_box", [](const TetMesh& mesh, const std::array<double, 3>& lo, const std::array<double, 3>& hi) {
    return owned_list<std::int32_t>(vertices_in_box(mesh, {{lo[0], lo[1], lo[2]}, {hi[0], hi[1], hi[2]}}));
  });
  m.def("vertices_below", [](const TetMesh& mesh, const std::array<double, 3>& normal, double offset) {
    return owned_list<std::int32_t>(vertices_below(mesh, {normal[0], normal[1], normal[2]}, offset));
  });
}

void bind_label_volumes(nb::module_& m) {
  using Triple = std::array<double, 3>;
  const auto vec = [](const Triple& t) { return Vec3d{t[0], t[1], t[2]}; };
  m.def(
      "label_surfaces",
      [vec](IndicesIn labels, const std::array<std::size_t, 3>& size, const std::array<Triple, 3>& steps,
            const Triple& origin, const std::vector<std::pair<std::uint32_t, std::string>>& names) {
        const LabelVolume volume{
            size, copy_rows<std::uint32_t>(labels), {vec(steps[0]), vec(steps[1]), vec(steps[2])}, vec(origin), names};
        return call_unlocked([&] {
          return std::make_pair(at_its_place(render_mesh_of(label_hull(volume))), at_its_place(label_surfaces(volume)));
        });
      },
      nb::arg("labels"), nb::arg("size"), nb::arg("steps"), nb::arg("origin"), nb::arg("names"));
}

}  // namespace

void bind_surfaces(nb::module_& m) {
  bind_label_volumes(m);
  bind_render_mesh(m);
  bind_embedding(m);
  bind_regions(m);
}

}  // namespace tetsoup::python
