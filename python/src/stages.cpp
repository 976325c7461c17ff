// The stages between soup and mesh, one by one.
#include "arrays.h"
#include "bindings.h"
#include "options.h"
#include "progress.h"
#include "records.h"
#include "tetsoup/quality.h"
#include "tetsoup/tetsoup.h"

namespace tetsoup::python {

namespace {

constexpr const char* kDistanceFieldDoc =
    "Unsigned distance to a soup on a regular grid, in the soup's unit. Arrays are indexed [z, y, x].";
constexpr const char* kPseudoVolumeDoc =
    "Which voxels a soup intuitively occupies, and how many rays said so. Arrays are indexed [z, y, x].";

/// Where the grid lies: the same three attributes for every field.
template <class Field, class FrameOf>
void bind_frame(nb::class_<Field>& field, const FrameOf& frame_of) {
  field
      .def_prop_ro(
          "shape",
          [frame_of](const Field& self) {
            const auto& size = frame_of(self).size;
            return std::tuple(size[2], size[1], size[0]);
          },
          "Voxels along z, y and x, padding included.")
      .def_prop_ro(
          "origin", [frame_of](const Field& self) { return python_value(frame_of(self).origin); },
          "Centre of voxel [0, 0, 0], as (x, y, z).")
      .def_prop_ro(
          "voxel_size", [frame_of](const Field& self) { return frame_of(self).voxel_size; },
          "Edge of a voxel, in the soup's unit.")
      .def_prop_ro(
          "pad", [frame_of](const Field& self) { return frame_of(self).pad; },
          "Voxels on each side beyond the soup's box.");
}

/// One byte a voxel from value(x, y, z).
template <class Value>
std::vector<std::uint8_t> every_voxel(const GridFrame& frame, const Value& value) {
  return call_unlocked([&] {
    std::vector<std::uint8_t> values;
    values.reserve(frame.voxel_count());
    for (int z = 0; z < frame.size[2]; ++z)
      for (int y = 0; y < frame.size[1]; ++y)
        for (int x = 0; x < frame.size[0]; ++x) values.push_back(static_cast<std::uint8_t>(value(x, y, z)));
    return values;
  });
}

void bind_fields(nb::module_& m) {
  nb::class_<DistanceField> distance(m, "DistanceField", kDistanceFieldDoc);
  distance
      .def_prop_ro(
          "values",
          [](const DistanceField& self) {
            return owned_volume<float>(call_unlocked([&] { return dense(self.distance).values; }), self.distance.frame);
          },
          nb::rv_policy::move, "Distances, (z, y, x) float32; infinity beyond the band. A new array at every access.")
      .def_ro("d_max", &DistanceField::d_max, "Largest distance over the voxels of the unpadded box.")
      .def_ro("band", &DistanceField::band, "Values below this are known; infinity if all are.");
  bind_frame(distance, [](const DistanceField& f) -> const GridFrame& { return f.distance.frame; });

  nb::class_<PseudoVolume> volume(m, "PseudoVolume", kPseudoVolumeDoc);
  volume
      .def_prop_ro(
          "inside",
          [](const PseudoVolume& self) {
            const GridFrame& frame = self.inside.frame;
            return owned_volume<bool>(
                every_voxel(frame, [&](int x, int y, int z) { return self.inside.test(x, y, z); }), frame);
          },
          nb::rv_policy::move, "Inside or not, (z, y, x) bool. A new array at every access.")
      .def_prop_ro(
          "votes",
          [](const PseudoVolume& self) {
            const GridFrame& frame = self.votes.frame;
            return owned_volume<std::uint8_t>(
                every_voxel(frame, [&](int x, int y, int z) { return self.votes.at(x, y, z); }), frame);
          },
          nb::rv_policy::move, "Rays that call a voxel inside, 0..rays, (z, y, x) uint8. A new array at every access.")
      .def_ro("rays", &PseudoVolume::rays, "26 or 13.")
      .def_ro("report", &PseudoVolume::report, "How it was decided.")
      .def("overlap", [](const PseudoVolume& self, const TetMesh& mesh) {
        return call_unlocked([&] { return intersection_over_union(mesh, self.inside); });
      });
  bind_frame(volume, [](const PseudoVolume& v) -> const GridFrame& { return v.inside.frame; });
}

void bind_functions(nb::module_& m) {
  m.def(
      "unsigned_distance",
      [](const CleanSoup& soup, nb::dict options, nb::object progress) {
        const DistanceOptions chosen = read_options(options, "distance").distance;
        return call_library(progress, [&](const Progress& watch) { return unsigned_distance(soup, chosen, watch); });
      },
      nb::arg("soup"), nb::arg("options"), nb::arg("progress").none());
  m.def(
      "widen_distance",
      [](const DistanceField& field, const CleanSoup& soup, double band_voxels, nb::object progress) {
        return call_library(progress, [&](const Progress& watch) {
          DistanceField wider = field;
          widen_distance(wider, soup, band_voxels, watch);
          return wider;
        });
      },
      nb::arg("field"), nb::arg("soup"), nb::arg("band_voxels"), nb::arg("progress").none());
  m.def(
      "classify_volume",
      [](const DistanceField& field, nb::dict options, nb::object progress) {
        const PseudoVolumeOptions chosen = read_options(options, "pseudo_volume").pseudo_volume;
        return call_library(progress, [&](const Progress& watch) { return classify_volume(field, chosen, watch); });
      },
      nb::arg("field"), nb::arg("options"), nb::arg("progress").none());
  m.def(
      "fill_lattice",
      [](const PseudoVolume& volume, const CleanSoup& soup, nb::dict options, nb::object progress) {
        const LatticeOptions chosen = read_options(options, "lattice").lattice;
        LatticeMesh lattice =
            call_library(progress, [&](const Progress& watch) { return fill_lattice(volume, soup, chosen, watch); });
        return std::pair(std::move(lattice.mesh), std::move(lattice.report));
      },
      nb::arg("volume"), nb::arg("soup"), nb::arg("options"), nb::arg("progress").none());
  m.def(
      "smooth_tets",
      [](const TetMesh& mesh, const PseudoVolume* volume, const CleanSoup* soup, PointsIn enclosed, nb::dict options,
         nb::object progress) {
        const SmoothOptions chosen = read_options(options, "smooth").smooth;
        const std::vector<Vec3> points = copy_rows<Vec3>(enclosed);
        const SmoothTarget target{.inside = volume == nullptr ? nullptr : &volume->inside,
                                  .volume = volume == nullptr ? std::nullopt : volume->report.bounded_volume,
                                  .soup = soup == nullptr ? nullptr : &soup->soup,
                                  .enclosed = points};
        SmoothResult result =
            call_library(progress, [&](const Progress& watch) { return smooth_tets(mesh, target, chosen, watch); });
        return std::pair(std::move(result.mesh), std::move(result.report));
      },
      nb::arg("mesh"), nb::arg("volume").none(), nb::arg("soup").none(), nb::arg("enclosed"), nb::arg("options"),
      nb::arg("progress").none());
  m.def("fidelity", [](const TetMesh& mesh, PointsIn vertices, FacesIn faces) {
    const TriangleSoup soup = copy_soup(vertices, faces);
    return call_unlocked([&] { return measure_fidelity(mesh, clean_soup(soup)); });
  });
  m.def("boundary_distance", [](const TetMesh& mesh, PointsIn vertices, FacesIn faces, double unit) {
    const TriangleSoup soup = copy_soup(vertices, faces);
    return call_unlocked([&] { return boundary_distance(mesh, soup, unit); });
  });
}

}  // namespace

void bind_stages(nb::module_& m) {
  bind_fields(m);
  bind_functions(m);
}

}  // namespace tetsoup::python
