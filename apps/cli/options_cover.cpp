// The flags for what the lattice keeps beyond density, and for its topology.
#include "arguments.h"
#include "options.h"

namespace tetsoup::cli {

namespace {

constexpr const char* kCoverGroup = "What the mesh covers";
constexpr const char* kTopologyGroup = "Topology";
constexpr Range kPartShare{.low = 0, .high = 1, .high_included = false, .words = "a number of at least 0 and below 1"};

}  // namespace

void add_cover_flags(CLI::App& app, LatticeOptions& options) {
  CLI::Option* const thin = add_choice<Thin>(app, "--thin", options.thin, {{"keep", Thin::Keep}, {"drop", Thin::Drop}},
                                             "Parts too thin for the lattice, such as legs and handles: keep\nthe tets "
                                             "they pass through, or drop them (keep)");
  CLI::Option* const enclose = app.add_flag_callback(
                                      "--enclose", [&options] { options.cover = Cover::Enclose; },
                                      "Every vertex of the model lies inside the mesh, as embedding\nwants it")
                                   ->option_text(" ");
  CLI::Option* const inside =
      app.add_flag_callback(
             "--inside", [&options] { options.cover = Cover::Inside; }, "The mesh stays within the model")
          ->option_text(" ");
  inside->excludes(enclose);
  CLI::Option* const separate =
      add_choice<Separate>(app, "--separate", options.separate, {{"on", Separate::Apart}, {"off", Separate::Together}},
                           "Keep apart what passes through one cell without touching, such\nas fingers or lips (on)");
  CLI::Option* const stairs =
      add_choice<Stairs>(app, "--stairs", options.stairs, {{"even", Stairs::Even}, {"leave", Stairs::Leave}},
                         "Where density hardly tells, drop tets that stick out and fill\nnotches, so that the boundary "
                         "gets smoother, or leave them (even)");
  for (CLI::Option* const option : {thin, enclose, inside, separate, stairs}) option->group(kCoverGroup);
}

void add_topology_flags(CLI::App& app, TopologyOptions& options) {
  CLI::Option* const touching =
      add_choice<Touching>(app, "--touching", options.touching, {{"mend", Touching::Mend}, {"leave", Touching::Leave}},
                           "Tets that meet in a vertex or an edge only: join or part them, so\nthat the boundary is a "
                           "manifold, or leave them "
                           "(mend)");
  CLI::Option* const part = add_flag(
      app, "--min-part", "SHARE",
      [&options](const std::string& text) { options.min_part = parse_number("--min-part", text, kPartShare); },
      "Drop pieces with less than this share of the volume, 0..1 (0.001)");
  CLI::Option* const bubbles =
      add_choice<Bubbles>(app, "--bubbles", options.bubbles, {{"fill", Bubbles::Fill}, {"keep", Bubbles::Keep}},
                          "Voids in the mesh without a way out (fill)");
  CLI::Option* const boundary_only = add_choice<BoundaryOnly>(
      app, "--boundary-only", options.boundary_only,
      {{"leave", BoundaryOnly::Leave}, {"remove", BoundaryOnly::Remove}, {"split", BoundaryOnly::Split}},
      "Tets with all four vertices on the boundary, which make thin parts\nstiff: leave, remove, or split them "
      "together "
      "with interior edges\nbetween boundary vertices (leave)");
  for (CLI::Option* const option : {touching, part, bubbles, boundary_only}) option->group(kTopologyGroup);
}

}  // namespace tetsoup::cli
