#include "soup_input.h"

#include <fmt/format.h>

#include "commands.h"
#include "files.h"
#include "interrupt.h"
#include "summary.h"

namespace tetsoup::cli {

Pipeline open_pipeline(const std::filesystem::path& input, ProgressBar& bar, double& read_seconds) {
  bar.show("read");
  const Stopwatch watch;
  const TriangleSoup soup = read_input_soup(input);
  read_seconds = watch.seconds();
  return open_pipeline(input, soup, bar);
}

Pipeline open_pipeline(const std::filesystem::path& input, const TriangleSoup& soup, ProgressBar& bar) {
  throw_if_interrupted();
  Pipeline pipeline(soup, bar.callback());
  const SoupReport& report = pipeline.soup().report;
  if (report.kind == SoupClass::Empty && report.triangle_count == 0 && !soup.vertices.empty())
    throw CannotMesh(fmt::format(
        "{}: it holds points, not triangles ({} of them); make a surface of them first, for instance by Poisson "
        "reconstruction in MeshLab or Open3D",
        input.string(), grouped(soup.vertices.size())));
  if (report.kind == SoupClass::Empty)
    throw CannotMesh(
        fmt::format("{}: no usable triangle: {} given, {} with non-finite coordinates, {} with indices out of "
                    "range; check how the file was exported",
                    input.string(), grouped(report.triangle_count), grouped(report.non_finite),
                    grouped(report.index_out_of_range)));
  return pipeline;
}

}  // namespace tetsoup::cli
