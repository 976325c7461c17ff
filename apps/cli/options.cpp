#include "options.h"

#include <cmath>

#include "angles.h"
#include "arguments.h"
#include "tetsoup/error.h"
#include "tetsoup/io.h"

namespace tetsoup::cli {

namespace {

// The ranges are those of the public headers; they are checked here so that the message names the flag.
constexpr Range kVoxels{.low = 1, .high = 4096, .words = "a whole number from 1 to 4096"};
constexpr Range kWantedOrAuto{.low = 1, .high = 134217728, .words = "a whole number from 1 to 134217728, or auto"};
constexpr Range kWanted{.low = 1, .high = 134217728, .words = "a whole number from 1 to 134217728"};
constexpr Range kCells{.low = 1, .high = 1024, .words = "a whole number from 1 to 1024"};
constexpr Range kShare{.low = 0, .high = 1, .low_included = false, .words = "a number above 0, at most 1"};
constexpr Range kPasses{.low = 0, .high = 1000, .words = "a whole number from 0 to 1000"};
constexpr Range kAngle{.low = 0, .high = 60, .high_included = false, .words = "degrees from 0 to below 60"};
constexpr Range kObtuse{.low = 90, .high = 180, .words = "degrees from 90 to 180"};
constexpr Range kRatio{.low = 1, .words = "a number from 1"};
constexpr Range kThreads{.low = 0, .high = 4096, .words = "a whole number from 0 (all cores) to 4096"};

constexpr const char* kGridGroup = "Voxel grid";
constexpr const char* kVolumeGroup = "Inside or outside";
constexpr const char* kLatticeGroup = "Tet lattice";
constexpr const char* kSmoothGroup = "Smoothing";
constexpr const char* kRunGroup = "Run";

}  // namespace

CLI::Option* add_flag(CLI::App& app, const std::string& names, const std::string& value_name,
                      const std::function<void(const std::string&)>& read, const std::string& description) {
  return app.add_option_function<std::string>(names, read, description)->option_text(value_name);
}

void add_grid_flags(CLI::App& app, DistanceOptions& options) {
  CLI::Option* const voxels = add_flag(
      app, "--voxels", "N",
      [&options](const std::string& text) { options.voxels = parse_whole("--voxels", text, kVoxels); },
      "Voxels along the longest axis of the soup's box, 1..4096 (128)");
  CLI::Option* const size = add_flag(
      app, "--voxel-size", "L",
      [&options](const std::string& text) { options.voxel_size = parse_number("--voxel-size", text, kPositive); },
      "Edge of a voxel in the model's unit, instead of --voxels");
  size->excludes(voxels);
  voxels->group(kGridGroup);
  size->group(kGridGroup);
}

void add_join_flag(CLI::App& app, Join& join) {
  add_choice<Join>(app, "--join", join, {{"touching", Join::Touching}, {"near", Join::Near}, {"all", Join::All}},
                   "Which parts are one body: those that touch; those that the voxels\ncannot tell apart; all, glued "
                   "where they share a cell (touching)")
      ->group(kVolumeGroup);
}

void add_volume_flags(CLI::App& app, PseudoVolumeOptions& options) {
  CLI::Option* const k = add_flag(
      app, "--k", "auto|X",
      [&options](const std::string& text) {
        if (text != "auto")
          options.k = parse_number("--k", text, {0, 1, false, true, "auto, or a number above 0, at most 1"});
      },
      "Event threshold in (0, 1]: 1 counts surface crossings, less\nbridges gaps between triangles (auto)");
  CLI::Option* const voxels = add_flag(
      app, "--band-voxels", "X",
      [&options](const std::string& text) {
        options.band_voxels = parse_number("--band-voxels", text, {0, 4096, false, true, "above 0 and at most 4096"});
      },
      "Half width of the event band in voxels, instead of --k;\nabout half the widest gap that should count as closed");
  CLI::Option* const band = add_flag(
      app, "--band", "X",
      [&options](const std::string& text) { options.band = parse_number("--band", text, kPositive); },
      "The same as a length in the model's unit");
  voxels->excludes(k);
  band->excludes(k)->excludes(voxels);
  CLI::Option* const rays = add_flag(
      app, "--rays", "26|13",
      [&options](const std::string& text) {
        if (text != "26" && text != "13") throw InvalidInput("--rays " + text + ": must be 26 or 13");
        options.rays = text == "26" ? 26 : 13;
      },
      "Rays that vote on every voxel (26)");
  CLI::Option* const placement = add_choice<Placement>(
      app, "--placement", options.placement, {{"closest", Placement::Closest}, {"entry", Placement::Entry}},
      "Where a ray crosses the band: at its closest approach to the\nsoup, or on entering, which thickens the result "
      "(closest)");
  CLI::Option* const cavities = add_choice<Cavities>(
      app, "--cavities", options.cavities,
      {{"auto", Cavities::Auto}, {"fill", Cavities::Fill}, {"keep", Cavities::Keep}},
      "Enclosed space: hollow where closed shells turn their outside\nto it, else filled; filled; hollow where rays "
      "call it outside (auto)");
  CLI::Option* const thickness = add_flag(
      app, "--thickness", "T",
      [&options](const std::string& text) { options.thickness = parse_number("--thickness", text, kPositive); },
      "Thickness of sheets, and of nothing else, in the model's unit");
  for (CLI::Option* const option : {k, voxels, band, rays, placement, cavities, thickness}) option->group(kVolumeGroup);
}

namespace {

/// How fine the lattice is: at most one of these.
std::vector<CLI::Option*> add_size_flags(CLI::App& app, LatticeOptions& options, TetCount& count) {
  CLI::Option* const tets = add_flag(
      app, "--tets", "N",
      [&options, &count](const std::string& text) {
        count = text == "auto" ? TetCount::Search : TetCount::Given;
        if (count == TetCount::Given)
          options.tets = static_cast<std::size_t>(parse_whole("--tets", text, kWantedOrAuto));
      },
      "Tets wanted: hit within 5 %, below 200 within 10 % (2000); or\nauto: the fewest of 500 to 32,000 at which the "
      "shape holds");
  CLI::Option* const vertices = add_flag(
      app, "--vertices", "N",
      [&options](const std::string& text) {
        options.vertices = static_cast<std::size_t>(parse_whole("--vertices", text, kWanted));
      },
      "Vertices wanted, instead of --tets");
  CLI::Option* const edge = add_flag(
      app, "--edge", "L",
      [&options](const std::string& text) { options.edge = parse_number("--edge", text, kPositive); },
      "Mean edge of the lattice's tets in the model's unit");
  CLI::Option* const cells = add_flag(
      app, "--cells", "N",
      [&options](const std::string& text) { options.cells = parse_whole("--cells", text, kCells); },
      "Cubic cells along the longest axis, 1..1024");
  CLI::Option* const size = add_flag(
      app, "--cell-size", "L",
      [&options](const std::string& text) { options.cell_size = parse_number("--cell-size", text, kPositive); },
      "Edge of a cell in the model's unit");
  const std::vector<CLI::Option*> sizes{tets, vertices, edge, cells, size};
  for (std::size_t i = 0; i < sizes.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) sizes[i]->excludes(sizes[j]);
  return sizes;
}

}  // namespace

void add_lattice_flags(CLI::App& app, LatticeOptions& options, TetCount& count) {
  for (CLI::Option* const option : add_size_flags(app, options, count)) option->group(kLatticeGroup);
  CLI::Option* const kind = add_flag(
      app, "--lattice", "five|bcc",
      [&options](const std::string& text) {
        if (text != "five" && text != "bcc") throw InvalidInput("--lattice " + text + ": must be five or bcc");
        options.kind = text == "bcc" ? LatticeKind::Bcc : LatticeKind::Five;
      },
      "Cubes of five tets each, or body-centred cubes whose tets are\nall alike (five)");
  CLI::Option* const rho = add_flag(
      app, "--rho-min", "X",
      [&options](const std::string& text) { options.rho_min = parse_number("--rho-min", text, kShare); },
      "A tet stays if at least this share of it is inside, (0, 1];\nless covers more of the space around the model "
      "(0.5)");
  CLI::Option* const translate = add_flag(
      app, "--translate", "X,Y,Z",
      [&options](const std::string& text) { options.translate_cells = parse_triple("--translate", text); },
      "Shift of the lattice in fractions of a cell (0,0,0)");
  CLI::Option* const rotate = add_flag(
      app, "--rotate", "X,Y,Z",
      [&options](const std::string& text) {
        const Vec3d degrees = parse_triple("--rotate", text);
        options.rotate = {to_radians(degrees.x), to_radians(degrees.y), to_radians(degrees.z)};
      },
      "Rotation of the lattice in degrees about x, then y, then z,\naround the centre of the soup's box (0,0,0)");
  CLI::Option* const fit = app.add_flag_callback(
      "--fit", [&options] { options.fit = Fit::Search; },
      "Search for the shift, rotation and edge of the lattice that meet\nthe shape best");
  for (CLI::Option* const option : {kind, rho, translate, rotate, fit}) option->group(kLatticeGroup);
}

void add_smooth_flags(CLI::App& app, SmoothOptions& options) {
  CLI::Option* const passes = add_flag(
      app, "--passes", "N",
      [&options](const std::string& text) { options.passes = parse_whole("--passes", text, kPasses); },
      "Smoothing passes, 0..1000; 0 leaves the lattice as it is (6)");
  CLI::Option* const snap =
      add_choice<Snap>(app, "--snap", options.snap, {{"on", Snap::Surface}, {"off", Snap::Off}},
                       "Draw the boundary to the surface of the inside voxels; off fairs\nit only and keeps the "
                       "lattice's volume (on)");
  CLI::Option* const strength = add_flag(
      app, "--strength", "X",
      [&options](const std::string& text) { options.strength = parse_number("--strength", text, kPositive); },
      "Strength of a pass, above 0; with --snap off (1)");
  CLI::Option* const angle = add_flag(
      app, "--min-angle", "DEG",
      [&options](const std::string& text) {
        options.min_dihedral = to_radians(parse_number("--min-angle", text, kAngle));
      },
      "Dihedral angle that smoothing never goes below, 0..60 (25)");
  CLI::Option* const obtuse = add_flag(
      app, "--max-angle", "DEG",
      [&options](const std::string& text) {
        options.max_dihedral = to_radians(parse_number("--max-angle", text, kObtuse));
      },
      "Dihedral angle that smoothing never goes beyond, 90..180 (155)");
  CLI::Option* const ratio = add_flag(
      app, "--max-edge-ratio", "X",
      [&options](const std::string& text) { options.max_edge_ratio = parse_number("--max-edge-ratio", text, kRatio); },
      "Longest over shortest edge of a tet that smoothing never goes\nbeyond, from 1 (3.5)");
  for (CLI::Option* const option : {passes, snap, strength, angle, obtuse, ratio}) option->group(kSmoothGroup);
}

void add_quiet_flag(CLI::App& app, bool& quiet) {
  app.add_flag("--quiet,-q", quiet, "Print nothing but errors")->group(kRunGroup);
}

void add_threads_flag(CLI::App& app) {
  add_flag(
      app, "--threads", "N",
      [](const std::string& text) { set_thread_count(parse_whole("--threads", text, kThreads)); },
      "Threads to use; the result never depends on it (0: all cores)")
      ->group(kRunGroup);
}

void add_run_flags(CLI::App& app, RunOptions& options) {
  add_threads_flag(app);
  add_flag(
      app, "--memory", "GB",
      [&options](const std::string& text) { options.memory_gb = parse_number("--memory", text, kPositive); },
      "Memory that the voxel grid may take (what is free now)")
      ->group(kRunGroup);
  add_quiet_flag(app, options.quiet);
}

std::optional<std::size_t> memory_limit(const RunOptions& options) {
  if (!options.memory_gb) return usable_memory();
  constexpr double kBytesPerGb = 1e9;
  const double bytes = *options.memory_gb * kBytesPerGb;
  constexpr double kMost = 1e18;  // anything beyond is no limit, and still fits a size_t
  return static_cast<std::size_t>(std::min(bytes, kMost));
}

}  // namespace tetsoup::cli
