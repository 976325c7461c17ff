// All stages in a row, remembered.
#include "tetsoup/pipeline.h"

#include "arrays.h"
#include "bindings.h"
#include "options.h"
#include "progress.h"
#include "records.h"
#include "tetsoup/io.h"
#include "tetsoup/report.h"

#include <nanobind/stl/filesystem.h>

namespace tetsoup::python {

namespace {

/// A pipeline, and how far its results stand. Python's side lets one thread at a time in.
struct Session {
  Pipeline pipeline;
  MeshOptions options;
  std::optional<Stage> done;  ///< Results up to this stage may be read.
  std::string count_note;     ///< Of a search for a count of tets.

  void run_until(Stage last, const MeshOptions& chosen, nb::handle progress) {
    done.reset();
    count_note.clear();
    options = chosen;
    call_library(progress, [&](const Progress& watch) { pipeline.run_until(last, chosen, watch); });
    done = last;
  }

  void find_tet_count(const MeshOptions& chosen, nb::handle progress) {
    done.reset();
    count_note = call_library(progress, [&](const Progress& watch) {
                   return tetsoup::find_tet_count(pipeline, chosen, watch);
                 }).note();
    options = pipeline.options();
    done = Stage::Smooth;
  }
};

Stage stage_named(const std::string& name) {
  for (const auto& [word, stage] : kWords<Stage>)
    if (name == word) return stage;
  throw InvalidInput("stage = '" + name + "', must be one of 'soup', 'distance', 'pseudo_volume', 'lattice', 'smooth'");
}

/// The results of a stage; they live until the next run, so Python gets a copy.
const Pipeline& after(const Session& session, Stage stage) {
  if (!session.done || *session.done < stage)
    throw InvalidInput(std::string("the stage '") + word_of(stage) +
                       "' has not run with the last options: call run() first");
  return session.pipeline;
}

nb::typed<nb::dict, nb::str, double> stage_seconds(const Session& session) {
  nb::typed<nb::dict, nb::str, double> seconds;
  for (const auto& [word, stage] : kWords<Stage>) seconds[word] = session.pipeline.seconds(stage);
  return seconds;
}

nb::typed<nb::dict, nb::str, std::size_t> stage_run_counts(const Session& session) {
  nb::typed<nb::dict, nb::str, std::size_t> counts;
  for (const auto& [word, stage] : kWords<Stage>) counts[word] = session.pipeline.run_count(stage);
  return counts;
}

void save_preview(const Session& session, const std::filesystem::path& path, const std::string& title,
                  const std::array<std::string, 4>& captions, int width) {
  const Pipeline& pipeline = after(session, Stage::Smooth);
  PreviewScene scene;
  scene.soup = &pipeline.soup().soup;
  scene.volume = &pipeline.pseudo_volume();
  scene.lattice = &pipeline.lattice().mesh;
  scene.mesh = &pipeline.smooth().mesh;
  scene.title = title;
  scene.captions = captions;
  call_unlocked([&] { write_preview(path, scene, width); });
}

Fidelity fidelity(const Session& session) {
  const Pipeline& pipeline = after(session, Stage::Smooth);
  return call_unlocked([&] { return measure_fidelity(pipeline.smooth().mesh, pipeline.soup()); });
}

std::vector<std::string> notes(const Session& session, const Fidelity& fidelity) {
  const Pipeline& pipeline = after(session, Stage::Smooth);
  return call_unlocked([&] {
    const Quality quality = measure_quality(pipeline.smooth().mesh);
    std::vector<std::string> notes = notes_of({.pipeline = pipeline, .quality = quality, .fidelity = fidelity});
    if (!session.count_note.empty()) notes.push_back(session.count_note);
    return notes;
  });
}

void save_fields(const Session& session, const std::filesystem::path& path) {
  const Pipeline& pipeline = after(session, Stage::PseudoVolume);
  call_unlocked([&] { write_field(path, pipeline.distance(), pipeline.pseudo_volume()); });
}

}  // namespace

void bind_pipeline(nb::module_& m) {
  nb::class_<Session>(m, "Pipeline")
      .def(
          "__init__",
          [](Session* self, PointsIn vertices, FacesIn faces, nb::object progress) {
            const TriangleSoup soup = copy_soup(vertices, faces);
            new (self) Session{
                call_library(progress, [&](const Progress& watch) { return Pipeline(soup, watch); }), {}, {}, {}};
          },
          nb::arg("vertices"), nb::arg("faces"), nb::arg("progress").none())
      .def(
          "run_until",
          [](Session& self, const std::string& stage, nb::dict options, nb::object progress) {
            self.run_until(stage_named(stage), read_options(options), progress);
          },
          nb::arg("stage"), nb::arg("options"), nb::arg("progress").none())
      .def(
          "find_tet_count",
          [](Session& self, nb::dict options, nb::object progress) {
            self.find_tet_count(read_options(options), progress);
          },
          nb::arg("options"), nb::arg("progress").none())
      .def("soup", [](const Session& self) { return self.pipeline.soup(); })
      .def("soup_report", [](const Session& self) { return self.pipeline.soup().report; })
      .def("distance", [](const Session& self) { return after(self, Stage::Distance).distance(); })
      .def("pseudo_volume", [](const Session& self) { return after(self, Stage::PseudoVolume).pseudo_volume(); })
      .def("volume_report", [](const Session& self) { return after(self, Stage::PseudoVolume).pseudo_volume().report; })
      .def("lattice", [](const Session& self) { return after(self, Stage::Lattice).lattice().mesh; })
      .def("lattice_report", [](const Session& self) { return after(self, Stage::Lattice).lattice().report; })
      .def("mesh", [](const Session& self) { return after(self, Stage::Smooth).smooth().mesh; })
      .def("smooth_report", [](const Session& self) { return after(self, Stage::Smooth).smooth().report; })
      .def("options", [](const Session& self) { return describe_options(self.options); })
      .def("fidelity", &fidelity)
      .def("notes", &notes, nb::arg("fidelity"))
      .def("seconds", &stage_seconds)
      .def("run_counts", &stage_run_counts)
      .def("save_fields", &save_fields)
      .def("save_preview", &save_preview, nb::arg("path"), nb::arg("title"), nb::arg("captions"), nb::arg("width"));
}

}  // namespace tetsoup::python
