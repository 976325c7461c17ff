// Files in and out.
#include <nanobind/stl/filesystem.h>
#include <nanobind/stl/map.h>

#include "arrays.h"
#include "bindings.h"
#include "progress.h"
#include "records.h"
#include "tetsoup/io.h"
#include "tetsoup/report.h"

namespace tetsoup::python {

namespace fs = std::filesystem;

void bind_files(nb::module_& m) {
  m.def("read_soup", [](const fs::path& path) {
    TriangleSoup soup = call_unlocked([&] { return at_its_place(read_soup(path)); });
    return std::tuple(owned_rows<float, 3>(std::move(soup.vertices)),
                      owned_rows<std::uint32_t, 3>(std::move(soup.triangles)));
  });
  m.def("read_tets", [](const fs::path& path) { return call_unlocked([&] { return at_its_place(read_tets(path)); }); });
  m.def("is_tet_file", [](const fs::path& path) { return call_unlocked([&] { return is_tet_file(path); }); });
  m.def("tet_formats", [] {
    std::map<std::string, std::string> formats;
    for (const TetFormatInfo& info : tet_formats()) formats[info.name] = info.summary;
    return formats;
  });
  m.def("report_page", [](const TetMesh& mesh, PointsIn vertices, FacesIn faces, const std::string& title,
                          const std::string& up, const std::string& json) {
    const TriangleSoup soup = copy_soup(vertices, faces);
    return call_unlocked([&] { return report_page({title, &mesh, &soup, up, 1, json}); });
  });
  m.def("usable_memory", [] { return usable_memory(); });
}

}  // namespace tetsoup::python
