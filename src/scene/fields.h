// Every key of a scene file, once: reading, writing, checking and the test of the documentation all go through these.
//
// A visitor is called as visitor(key, member, rule) for every member of a struct. Rules say what a value may be.
#pragma once

#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <string_view>

#include "tetsoup/scene.h"

namespace tetsoup::scene {

/// Numbers from `low` to `high`, and how to say so.
struct Range {
  double low = 0, high = 0;
  std::string_view words;
  bool above_low = false;   ///< `low` itself is not in it,
  bool below_high = false;  ///< nor is `high`.

  bool holds(double v) const { return (above_low ? v > low : v >= low) && (below_high ? v < high : v <= high); }
};

/// A value that has a name.
template <class Value>
struct Word {
  std::string_view word;
  Value value;
};
template <class Value, std::size_t size>
struct Words {
  std::array<Word<Value>, size> all;
};
template <class Value, class... More>
Words(Word<Value>, More...) -> Words<Value, 1 + sizeof...(More)>;

/// Any text; the name of a file that is to be read; members of an object, or of each object of an array.
struct Text {};
struct Object {};
struct Objects {};
/// A box given as two corners.
struct Corners {
  Range range;
};

// Ranges are those of the public headers, or narrower where a scene asks for less.
inline constexpr double kFar = 1e5;  // m, from the origin: what the simulation takes
inline constexpr Range kPlaceRange{-kFar, kFar, "within -1e5 and 1e5 m"};
inline constexpr Range kSpeedRange{-1e4, 1e4, "within -1e4 and 1e4 m/s"};
inline constexpr Range kAngleRange{-36000, 36000, "within -36000 and 36000 degrees"};
inline constexpr Range kSpinRange{-500000, 500000, "within -500000 and 500000 degrees/s"};
inline constexpr Range kFrictionRange{0, 100, "0 to 100"};
inline constexpr Range kSizeRange{1e-4, kFar, "0.0001 to 1e5 m"};
inline constexpr Range kPlacedSizeRange{5e-5, 2e5, "0.0001 to 1e5 m"};  // a mesh is not just as long as its source
inline constexpr Range kLengthRange{0, kFar, "above 0 and at most 1e5 m", true};
inline constexpr Range kShareRange{0, 1, "above 0 and at most 1", true};
inline constexpr Range kSeedRange{0, 9007199254740992.0, "a whole number from 0 to 2^53"};
inline constexpr Range kTimeRange{0, 3600, "0 to 3600 s"};

template <class Visitor>
void visit_fields(Visitor& v, DistanceOptions& o) {
  v("voxels", o.voxels, Range{1, 4096, "a whole number from 1 to 4096"});
  v("voxel_size", o.voxel_size, kLengthRange);
}

template <class Visitor>
void visit_fields(Visitor& v, PseudoVolumeOptions& o) {
  v("k", o.k, Range{0, 1, "0 to 1"});
  v("band_voxels", o.band_voxels, Range{0, 4096, "above 0 and at most 4096", true});
  v("band", o.band, kLengthRange);
  v("rays", o.rays, Words{Word<int>{"26", 26}, Word<int>{"13", 13}});
  v("placement", o.placement,
    Words{Word<Placement>{"closest", Placement::Closest}, Word<Placement>{"entry", Placement::Entry}});
  v("thickness", o.thickness, kLengthRange);
  v("cavities", o.cavities,
    Words{Word<Cavities>{"auto", Cavities::Auto}, Word<Cavities>{"fill", Cavities::Fill},
          Word<Cavities>{"keep", Cavities::Keep}});
}

template <class Visitor>
void visit_fields(Visitor& v, TopologyOptions& o) {
  v("touching", o.touching, Words{Word<Touching>{"mend", Touching::Mend}, Word<Touching>{"leave", Touching::Leave}});
  v("min_part", o.min_part, Range{0, 1, "at least 0 and below 1", false, true});
  v("bubbles", o.bubbles, Words{Word<Bubbles>{"fill", Bubbles::Fill}, Word<Bubbles>{"keep", Bubbles::Keep}});
  v("boundary_only", o.boundary_only,
    Words{Word<BoundaryOnly>{"leave", BoundaryOnly::Leave}, Word<BoundaryOnly>{"remove", BoundaryOnly::Remove},
          Word<BoundaryOnly>{"split", BoundaryOnly::Split}});
}

template <class Visitor>
void visit_fields(Visitor& v, LatticeOptions& o) {
  constexpr Range kWanted{1, 134217728, "a whole number from 1 to 134217728"};
  v("tets", o.tets, kWanted);
  v("vertices", o.vertices, kWanted);
  v("edge", o.edge, kLengthRange);
  v("cells", o.cells, Range{1, 1024, "a whole number from 1 to 1024"});
  v("cell_size", o.cell_size, kLengthRange);
  v("lattice", o.kind, Words{Word<LatticeKind>{"five", LatticeKind::Five}, Word<LatticeKind>{"bcc", LatticeKind::Bcc}});
  v("translate_cells", o.translate_cells, Range{-1000, 1000, "within -1000 and 1000 cells"});
  v.angles("rotate", o.rotate, kAngleRange);
  v("fit", o.fit, Words{Word<Fit>{"off", Fit::Off}, Word<Fit>{"search", Fit::Search}});
  v("rho_min", o.rho_min, kShareRange);
  v("stairs", o.stairs, Words{Word<Stairs>{"even", Stairs::Even}, Word<Stairs>{"leave", Stairs::Leave}});
  v("thin", o.thin, Words{Word<Thin>{"keep", Thin::Keep}, Word<Thin>{"drop", Thin::Drop}});
  v("cover", o.cover,
    Words{Word<Cover>{"density", Cover::Density}, Word<Cover>{"enclose", Cover::Enclose},
          Word<Cover>{"inside", Cover::Inside}});
  v("separate", o.separate, Words{Word<Separate>{"on", Separate::Apart}, Word<Separate>{"off", Separate::Together}});
  visit_fields(v, o.topology);
}

template <class Visitor>
void visit_fields(Visitor& v, SmoothOptions& o) {
  v("passes", o.passes, Range{0, 1000, "a whole number from 0 to 1000"});
  v("strength", o.strength, Range{0, 1000, "above 0 and at most 1000", true});
  v.angle("min_angle", o.min_dihedral, Range{0, 60, "0 to below 60 degrees", false, true});
  v.angle("max_angle", o.max_dihedral, Range{90, 180, "90 to 180 degrees"});
  v("max_edge_ratio", o.max_edge_ratio, Range{1, 1e6, "1 to 1e6"});
  v("snap", o.snap, Words{Word<Snap>{"on", Snap::Surface}, Word<Snap>{"off", Snap::Off}});
}

template <class Visitor>
void visit_fields(Visitor& v, MeshOptions& o) {
  visit_fields(v, o.distance);
  visit_fields(v, o.pseudo_volume);
  visit_fields(v, o.lattice);
  visit_fields(v, o.smooth);
  v("join", o.join,
    Words{Word<Join>{"touching", Join::Touching}, Word<Join>{"near", Join::Near}, Word<Join>{"all", Join::All}});
}

template <class Visitor>
void visit_fields(Visitor& v, SimMaterial& m) {
  v("density", m.elastic.density, Range{1e-3, 1e6, "0.001 to 1e6 kg/m^3"});
  v("young", m.elastic.young, Range{1e-3, 1e13, "0.001 to 1e13 Pa"});
  v("poisson", m.elastic.poisson, Range{0, 0.4999, "0 to 0.4999"});
  v("damping_time", m.damping_time, Range{0, 10, "0 to 10 s"});
  v("friction", m.friction, kFrictionRange);
}

template <class Visitor>
void visit_fields(Visitor& v, ScenePlace& p) {
  v("translate", p.translate, kPlaceRange);
  v("rotate", p.rotate, kAngleRange);
  v("scale", p.scale, Range{1e-6, 1e6, "1e-6 to 1e6"});
  v("velocity", p.velocity, kSpeedRange);
  v("spin", p.spin, kSpinRange);
}

template <class Visitor>
void visit_fields(Visitor& v, SceneGrid& g) {
  v("count", g.count, Range{1, 1000, "a whole number from 1 to 1000"});
  v("spacing", g.spacing, kPlaceRange);
  v("jitter", g.jitter, Range{0, 1e4, "0 to 1e4 m"});
  v("jitter_rotate", g.jitter_rotate, Range{0, 180, "0 to 180 degrees"});
  v("seed", g.seed, kSeedRange);
}

template <class Visitor>
void visit_fields(Visitor& v, ScenePin& p) {
  v("box", p.box, Corners{kPlaceRange});
  v("axis", p.axis, Words{Word<int>{"x", 0}, Word<int>{"y", 1}, Word<int>{"z", 2}});
  v("below", p.below, kPlaceRange);
  v("above", p.above, kPlaceRange);
  v("velocity", p.velocity, kSpeedRange);
  v("spin", p.spin, kSpinRange);
  v("about", p.about, kPlaceRange);
  v("until", p.until, kTimeRange);
  v("release", p.release, kTimeRange);
}

template <class Visitor>
void visit_fields(Visitor& v, SceneSpring& s) {
  v("at", s.at, kPlaceRange);
  v("to", s.to, kPlaceRange);
  v("stiffness", s.stiffness, Range{0, 1e12, "above 0 and at most 1e12 N/m", true});
}

template <class Visitor>
void visit_fields(Visitor& v, SceneSource& s) {
  v("sample", s.sample, Text{});
  v("file", s.file, Text{});
  v("box", s.box, kSizeRange);
  v("damage", s.damage, Range{0, 1, "at least 0 and below 1", false, true});
  v("seed", s.seed, kSeedRange);
  v("size", s.size, kSizeRange);
  v("metres_per_unit", s.metres_per_unit, Range{1e-6, 1e6, "1e-6 to 1e6 m"});
  v("origin", s.origin,
    Words{Word<SceneOrigin>{"own", SceneOrigin::Own}, Word<SceneOrigin>{"centre", SceneOrigin::Centre},
          Word<SceneOrigin>{"bottom", SceneOrigin::Bottom}});
}

template <class Visitor>
void visit_fields(Visitor& v, SceneBody& b) {
  v("name", b.name, Text{});
  visit_fields(v, b.source);
  v("tets_file", b.source.tets_file, Text{});
  v("mesh", b.mesh, Object{});
  v("material", b.material, Object{});
  v("place", b.place, Object{});
  v.instances("instances", b);
  v("pins", b.pins, Objects{});
  v("springs", b.springs, Objects{});
  v.surface("surface", b);
}

template <class Visitor>
void visit_fields(Visitor& v, ScenePlane& p) {
  v("normal", p.normal, kPlaceRange);
  v("offset", p.offset, Range{-1e10, 1e10, "at most 1e5 m from the origin"});
}

template <class Visitor>
void visit_fields(Visitor& v, SceneObstacle& o) {
  v("name", o.name, Text{});
  v("plane", o.plane, Object{});
  visit_fields(v, o.source);
  v("place", o.place, Object{});
  v("voxels", o.voxels, Range{4, 512, "a whole number from 4 to 512"});
  v("friction", o.friction, kFrictionRange);
}

template <class Visitor>
void visit_fields(Visitor& v, PotentialOptions& p) {
  constexpr Range kStiffness{0, 1e12, "0 to 1e12 J"};
  v("distance", p.distance, kStiffness);
  v("area", p.area, kStiffness);
  v("volume", p.volume, kStiffness);
}

template <class Visitor>
void visit_fields(Visitor& v, SimulationOptions& o) {
  v("gravity", o.gravity, Range{-1e4, 1e4, "within -1e4 and 1e4 m/s^2"});
  v("solver", o.solver,
    Words{Word<Solver>{"implicit", Solver::Implicit}, Word<Solver>{"potentials", Solver::Potentials}});
  v("substeps", o.substeps, Range{1, 10000, "a whole number from 1 to 10000"});
  v("max_substeps", o.max_substeps, Range{1, 10000, "a whole number from 1 to 10000"});
  v("contact_interval", o.contact_interval, Range{1, 10000, "a whole number from 1 to 10000"});
  v("contacts", o.contacts,
    Words{Word<Contacts>{"all", Contacts::All}, Word<Contacts>{"between", Contacts::Between},
          Word<Contacts>{"none", Contacts::None}});
  v("potentials", o.potentials, Object{});
}

template <class Visitor>
void visit_fields(Visitor& v, Scene& s) {
  v("title", s.title, Text{});
  v("seconds", s.seconds, kTimeRange);
  v("fps", s.fps, Range{1, 1000, "1 to 1000"});
  visit_fields(v, s.simulation);
  v("bodies", s.bodies, Objects{});
  v("obstacles", s.obstacles, Objects{});
}

}  // namespace tetsoup::scene
