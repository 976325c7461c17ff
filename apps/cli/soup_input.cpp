#include "soup_input.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "arguments.h"
#include "commands.h"
#include "files.h"
#include "interrupt.h"
#include "options.h"
#include "summary.h"

namespace tetsoup::cli {

namespace {

/// About how far the points would be apart if they lay on the sides of their box, of which shapes fill a part.
double likely_size(const TriangleSoup& points) {
  constexpr float kNone = std::numeric_limits<float>::infinity();
  Vec3 lo{kNone, kNone, kNone}, hi{-kNone, -kNone, -kNone};
  std::size_t count = 0;
  for (const Vec3& v : points.vertices) {
    if (!std::isfinite(v.x + v.y + v.z)) continue;
    lo = {std::min(lo.x, v.x), std::min(lo.y, v.y), std::min(lo.z, v.z)};
    hi = {std::max(hi.x, v.x), std::max(hi.y, v.y), std::max(hi.z, v.z)};
    ++count;
  }
  if (count == 0) return 1;
  const double x = static_cast<double>(hi.x) - static_cast<double>(lo.x),
               y = static_cast<double>(hi.y) - static_cast<double>(lo.y),
               z = static_cast<double>(hi.z) - static_cast<double>(lo.z);
  const double size = 0.75 * std::sqrt(2 * (x * y + y * z + z * x) / static_cast<double>(count));
  return size > 0 ? size : 1;
}

}  // namespace

void add_point_flag(CLI::App& app, std::optional<double>& size) {
  add_flag(
      app, "--point-size", "X",
      [&size](const std::string& text) { size = parse_number("--point-size", text, kPositive); },
      "Of a file that holds points alone, take each as a triangle with\nedges this long: about as far as points "
      "lie "
      "apart")
      ->group("Soup");
}

Pipeline open_pipeline(const std::filesystem::path& input, std::optional<double> point_size, ProgressBar& bar,
                       double& read_seconds) {
  bar.show("read");
  const Stopwatch watch;
  const TriangleSoup soup = read_input_soup(input, point_size);
  read_seconds = watch.seconds();
  return open_pipeline(input, soup, bar);
}

Pipeline open_pipeline(const std::filesystem::path& input, const TriangleSoup& soup, ProgressBar& bar) {
  throw_if_interrupted();
  Pipeline pipeline(soup, bar.callback());
  const SoupReport& report = pipeline.soup().report;
  if (report.kind == SoupClass::Empty && report.triangle_count == 0 && !soup.vertices.empty())
    throw CannotMesh(
        fmt::format("{}: it holds points, not triangles ({} of them); --point-size {:.1g} takes each as a triangle of "
                    "that size, or "
                    "make a surface of them first, for instance by Poisson reconstruction in MeshLab or Open3D",
                    input.string(), grouped(soup.vertices.size()), likely_size(soup)));
  if (report.kind == SoupClass::Empty)
    throw CannotMesh(
        fmt::format("{}: no usable triangle: {} given, {} with non-finite coordinates, {} with indices out of "
                    "range; check how the file was exported",
                    input.string(), grouped(report.triangle_count), grouped(report.non_finite),
                    grouped(report.index_out_of_range)));
  return pipeline;
}

}  // namespace tetsoup::cli
