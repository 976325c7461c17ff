// tetsoup._core: the library as Python sees it. It holds no logic: it converts, calls, and wraps what comes back. What
// users call is Python, in python/tetsoup.
#include <nanobind/nanobind.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include "arrays.h"
#include "bindings.h"
#include "options.h"
#include "progress.h"
#include "records.h"
#include "tetsoup/samples.h"
#include "tetsoup/tetsoup.h"

namespace tetsoup::python {

namespace {

template <class E>
void bind_error(nb::module_& m, const char* name, nb::handle base, const char* doc) {
  nb::exception<E> error(m, name, base);
  error.doc() = doc;
}

void bind_errors(nb::module_& m) {
  bind_error<InvalidInput>(m, "InvalidInput", PyExc_ValueError,
                           "An option or an array is not what it must be; the text names it, its value and the range.");
  bind_error<IoError>(
      m, "IoError", PyExc_OSError,
      "A file cannot be read, parsed or written; the text names the file and the line, byte or reason.");
  bind_error<Cancelled>(m, "Cancelled", PyExc_RuntimeError, "A progress callback answered False.");
}

void bind_samples(nb::module_& m) {
  m.def("sample_names", &sample_names);
  m.def(
      "make_sample",
      [](const std::string& name, double damage, std::uint64_t seed, std::optional<double> wall) {
        TriangleSoup soup =
            call_unlocked([&] { return make_sample(name, {.damage = damage, .seed = seed, .wall = wall}); });
        return std::tuple(owned_rows<float, 3>(std::move(soup.vertices)),
                          owned_rows<std::uint32_t, 3>(std::move(soup.triangles)));
      },
      nb::arg("name"), nb::arg("damage"), nb::arg("seed"), nb::arg("wall").none());
}

}  // namespace

}  // namespace tetsoup::python

NB_MODULE(_core, m) {
  using namespace tetsoup::python;
  m.attr("VERSION") = TETSOUP_VERSION;
  bind_errors(m);
  bind_reports(m);
  bind_meshes(m);
  bind_stages(m);
  bind_pipeline(m);
  bind_surfaces(m);
  bind_calibration(m);
  bind_models(m);
  bind_simulation(m);
  bind_files(m);
  bind_samples(m);
  m.def("default_options", [](const std::string& group) { return default_options(group); });
  m.def("set_thread_count", &tetsoup::set_thread_count);
  m.def("thread_count", &tetsoup::thread_count);
}
