// Which file wants what; frames go to each of them in turn.
#include <memory>
#include <optional>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "base/require.h"
#include "io/animation/cast.h"
#include "io/animation/file_log.h"
#include "io/animation/glb_film.h"
#include "io/animation/painter.h"
#include "io/animation/surface_series.h"
#include "io/animation/vtu_series.h"
#include "io/animation/webp_film.h"
#include "io/file_names.h"
#include "io/pictures/png_writer.h"
#include "tetsoup/animation.h"
#include "tetsoup/error.h"

namespace tetsoup {

namespace {

namespace fs = std::filesystem;
using namespace animation;

struct FilmFile {
  fs::path path;
  WebpFilm film;
};
struct GlbFile {
  fs::path path;
  GlbFilm film;
};

void check(const AnimationOptions& options) {
  require(options.fps > 0 && options.fps <= 1000, "fps", options.fps, "above 0, up to 1000");
  require(options.width >= 64 && options.width <= 4096, "width", options.width, "in 64..4096");
  require(options.height >= 64 && options.height <= 4096, "height", options.height, "in 64..4096");
  if (!options.view) return;
  const Box3& box = *options.view;
  require(box.lo.x <= box.hi.x && box.lo.y <= box.hi.y && box.lo.z <= box.hi.z, "view", "its low corner",
          "below its high corner");
}

void make_folder(const fs::path& folder) {
  if (folder.empty()) return;
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw IoError("cannot make folder '" + folder.string() + "': " + error.message());
}

}  // namespace

AnimationFrame animation_frame(const Simulation& simulation) {
  AnimationFrame frame{simulation.time(), simulation.state_hash(), {}, {}, {}};
  for (std::size_t b = 0; b < simulation.body_count(); ++b) {
    frame.positions.push_back(simulation.positions(b));
    frame.velocities.push_back(simulation.velocities(b));
  }
  return frame;
}

struct AnimationWriter::State {
  State(AnimationScene scene, const AnimationOptions& chosen) : options(chosen), cast(make_cast(std::move(scene))) {}

  AnimationOptions options;
  Cast cast;
  FileLog log;
  std::vector<VtuSeries> tets;
  std::vector<SurfaceSeries> surfaces;
  std::vector<fs::path> pictures, obstacles;  // Obstacles' files that are still to be written.
  std::vector<FilmFile> films;
  std::vector<GlbFile> glbs;
  std::optional<Painter> painter;
  double last_time = 0;
  bool finished = false;

  void open(const fs::path& path);
  void draw(FrameView& view, std::size_t number);
};

void AnimationWriter::State::open(const fs::path& path) {
  const std::string extension = lower_extension(path);
  if (extension.empty() || fs::is_directory(path)) {
    make_folder(path);
    tets.emplace_back(cast, path / "frames.pvd", "frame", options.first_frame);
    return obstacles.push_back(path / "obstacles.obj");
  }
  const bool is_film = extension == ".webp" || extension == ".glb";
  if (is_film && options.first_frame > 0)
    throw IoError("cannot continue '" + path.string() + "': a film starts with frame 0; give it the old frames again");
  const fs::path beside = path.parent_path() / (path.stem().string() + "_obstacles.obj");
  if (extension == ".pvd") {
    tets.emplace_back(cast, path, path.stem().string(), options.first_frame);
    obstacles.push_back(beside);
  } else if (extension == ".obj" || extension == ".ply") {
    surfaces.emplace_back(cast, path);
    obstacles.push_back(beside);
  } else if (extension == ".png") {
    pictures.push_back(path);
  } else if (extension == ".webp") {
    films.push_back({path, WebpFilm(options.width, options.height, options.fps)});
  } else if (extension == ".glb") {
    glbs.push_back({path, GlbFilm(cast, options.up)});
  } else {
    throw IoError("cannot write '" + path.string() +
                  "': an animation is a folder, .pvd, .obj, .ply, .png, .webp or .glb");
  }
  make_folder(path.parent_path());
}

void AnimationWriter::State::draw(FrameView& view, std::size_t number) {
  if (pictures.empty() && films.empty()) return;
  if (!options.view) options.view = default_view(cast, view, options.up);
  if (!painter) painter.emplace(cast, *options.view, options);
  const Image image = painter->draw(view);
  if (!pictures.empty()) {
    const std::vector<std::byte> png = encode_png(image);
    for (const fs::path& path : pictures)
      log.write(numbered(path, path.stem().string(), number, path.extension().string()),
                {reinterpret_cast<const char*>(png.data()), png.size()});
  }
  for (FilmFile& file : films) file.film.add(image);
}

AnimationWriter::AnimationWriter(std::vector<fs::path> paths, AnimationScene scene, const AnimationOptions& options) {
  check(options);
  state_ = std::make_unique<State>(std::move(scene), options);
  for (const fs::path& path : paths) state_->open(path);
}

AnimationWriter::~AnimationWriter() = default;
AnimationWriter::AnimationWriter(AnimationWriter&&) noexcept = default;
AnimationWriter& AnimationWriter::operator=(AnimationWriter&&) noexcept = default;

void AnimationWriter::add_frame(const AnimationFrame& frame) {
  State& s = *state_;
  require(!s.finished, "frame", s.log.report.frame_count, "added before finish()");
  FrameView view(s.cast, frame);
  require(std::isfinite(frame.time) && (s.log.report.frame_count == 0 || frame.time > s.last_time), "time", frame.time,
          "finite and later than the frame before");
  for (const fs::path& path : std::exchange(s.obstacles, {})) write_obstacles(s.cast, path, s.log);
  const std::size_t number = s.options.first_frame + s.log.report.frame_count;
  for (VtuSeries& series : s.tets) series.add(view, number, s.log);
  for (const SurfaceSeries& series : s.surfaces) series.add(view, number, s.log);
  s.draw(view, number);
  for (GlbFile& file : s.glbs) file.film.add(view);
  s.last_time = frame.time;
  ++s.log.report.frame_count;
}

void AnimationWriter::finish() {
  State& s = *state_;
  if (std::exchange(s.finished, true) || s.log.report.frame_count == 0) return;
  for (FilmFile& file : s.films) s.log.write(file.path, file.film.finish());
  for (GlbFile& file : s.glbs) file.film.write(file.path, s.log);
}

const AnimationReport& AnimationWriter::report() const {
  return state_->log.report;
}

Box3 AnimationWriter::view() const {
  return state_->options.view.value_or(Box3{});
}

}  // namespace tetsoup
