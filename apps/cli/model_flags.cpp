// The flags for render surface, regions and pins.
#include <fmt/format.h>

#include <algorithm>

#include "arguments.h"
#include "mesh_model.h"
#include "options.h"

namespace tetsoup::cli {

namespace {

constexpr const char* kGroup = "Render surface, regions and pins";
constexpr Range kPoisson{
    .low = 0, .high = 0.5, .high_included = false, .words = "a number of at least 0 and below 0.5"};

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts(1);
  for (const char c : text) {
    if (c == separator) {
      parts.emplace_back();
    } else {
      parts.back() += c;
    }
  }
  return parts;
}

/// "NAME=DENSITY,YOUNG,POISSON"; what is left empty or out stays as it is for the whole. Names may hold any sign.
RegionWish parse_region(const std::string& text) {
  const auto fail = [&] {
    throw InvalidInput("--region " + text + ": must be NAME=DENSITY,YOUNG,POISSON, such as rubber=1100,2e5,0.45");
  };
  const std::size_t equals = text.rfind('=');
  if (equals == std::string::npos || equals == 0) fail();
  const std::vector<std::string> numbers = split(text.substr(equals + 1), ',');
  if (numbers.size() > 3) fail();
  RegionWish wish{text.substr(0, equals), {}, {}, {}};
  const auto take = [&](std::size_t i, std::optional<double>& number, const Range& range) {
    if (i < numbers.size() && !numbers[i].empty()) number = parse_number("--region", numbers[i], range);
  };
  take(0, wish.density, kPositive);
  take(1, wish.young, kPositive);
  take(2, wish.poisson, kPoisson);
  if (!wish.density && !wish.young && !wish.poisson) fail();
  return wish;
}

/// "X0,Y0,Z0,X1,Y1,Z1": two opposite corners.
Box3 parse_box(const std::string& text) {
  const std::vector<std::string> parts = split(text, ',');
  if (parts.size() != 6) throw InvalidInput("--pin-box " + text + ": must be two corners, X0,Y0,Z0,X1,Y1,Z1");
  std::array<double, 6> n{};
  for (std::size_t i = 0; i < 6; ++i) n[i] = parse_number("--pin-box", parts[i], kFinite);
  return {{std::min(n[0], n[3]), std::min(n[1], n[4]), std::min(n[2], n[5])},
          {std::max(n[0], n[3]), std::max(n[1], n[4]), std::max(n[2], n[5])}};
}

/// A half space dot(normal, x) <= offset.
struct HalfSpace {
  Vec3d normal;
  double offset = 0;
};

/// "z:0.1" (z up to 0.1), "-z:-0.1" (z from 0.1), or "X,Y,Z:OFFSET".
HalfSpace parse_half_space(const std::string& text) {
  const auto fail = [&] {
    throw InvalidInput("--pin-below " + text + ": must be AXIS:OFFSET such as z:0.1, -x:2 or 0,1,1:0.5");
  };
  const std::size_t colon = text.find(':');
  if (colon == std::string::npos) fail();
  const std::string axis = text.substr(0, colon);
  const double offset = parse_number("--pin-below", text.substr(colon + 1), kFinite);
  const bool turned = axis.starts_with('-');
  const std::string letter = axis.substr(turned ? 1 : 0);
  const double one = turned ? -1 : 1;
  if (letter == "x") return {{one, 0, 0}, offset};
  if (letter == "y") return {{0, one, 0}, offset};
  if (letter == "z") return {{0, 0, one}, offset};
  if (axis.find(',') == std::string::npos) fail();
  const Vec3d normal = parse_triple("--pin-below", axis);
  if (normal == Vec3d{}) throw InvalidInput("--pin-below " + text + ": the plane's normal must not be zero");
  return {normal, offset};
}

/// A set's name that no other set has: "box", "box_2".
std::string free_name(const std::vector<PinWish>& pins, const std::string& wanted) {
  const auto is_taken = [&](const std::string& name) {
    return std::any_of(pins.begin(), pins.end(), [&](const PinWish& pin) { return pin.name == name; });
  };
  std::string name = wanted;
  for (int i = 2; is_taken(name); ++i) name = fmt::format("{}_{}", wanted, i);
  return name;
}

/// A flag that may be given several times.
void add_list(CLI::App& app, const std::string& name, const std::string& value,
              const std::function<void(const std::string&)>& take, const std::string& description) {
  app.add_option_function<std::vector<std::string>>(
         name, [take](const std::vector<std::string>& texts) { std::for_each(texts.begin(), texts.end(), take); },
         description)
      ->allow_extra_args(false)
      ->option_text(value)
      ->group(kGroup);
}

void add_pin_flags(CLI::App& app, ModelOptions& options) {
  add_list(
      app, "--pin-box", "X0,Y0,Z0,X1,Y1,Z1",
      [&options](const std::string& text) {
        const Box3 box = parse_box(text);
        options.pins.push_back(
            {free_name(options.pins, "box"), [box](const TetMesh& mesh) { return vertices_in_box(mesh, box); }});
      },
      "Hold the vertices in a box, given by two corners");
  add_list(
      app, "--pin-below", "AXIS:OFFSET",
      [&options](const std::string& text) {
        const HalfSpace half = parse_half_space(text);
        options.pins.push_back({free_name(options.pins, "below"), [half](const TetMesh& mesh) {
                                  return vertices_below(mesh, half.normal, half.offset);
                                }});
      },
      "Hold the vertices up to a plane: z:0.1 those with z <= 0.1,\n-z:-0.1 those with z >= 0.1, 0,1,1:0.5 across any "
      "direction");
  add_list(
      app, "--pin-part", "NAME",
      [&options](const std::string& text) {
        options.pins.push_back({text, {}});
      },
      "Hold the vertices nearest to an object, group, material or\nconnected part of the model; `tetsoup inspect` "
      "lists them");
}

}  // namespace

void add_model_flags(CLI::App& app, ModelOptions& options) {
  add_choice<Order>(
      app, "--order", options.order, {{"1", Order::Linear}, {"2", Order::Quadratic}},
      "Nodes of a tet: four, or ten, those of boundary edges on the model's\nsurface: for FEM, as .msh .vtk .vtu "
      ".inp (1)")
      ->group(kGroup);
  add_flag(
      app, "--embed", "FILE", [&options](const std::string& text) { options.embed = text; },
      "Where each vertex of the model lies in the tets, as .npz or\n.embedding, to move the model along")
      ->group(kGroup);
  add_flag(
      app, "--regions", "object|group|material|part",
      [&options](const std::string& text) {
        for (const RegionsBy by : {RegionsBy::Object, RegionsBy::Group, RegionsBy::Material, RegionsBy::Part})
          if (text == word_of(by)) options.regions_by = by;
        if (!options.regions_by) throw InvalidInput("--regions " + text + ": must be object, group, material or part");
      },
      "Mark each tet with the part of the model that contains most of it,\nof open parts the nearest: by its names, or "
      "its connected parts,\npart_1 the largest")
      ->group(kGroup);
  app.add_flag_callback(
         "--regions-fit", [&options] { options.fit_regions = true; },
         "Faces of tets follow the borders between closed regions, as the\nboundary follows the surface: the default")
      ->group(kGroup);
  app.add_flag_callback(
         "--no-regions-fit", [&options] { options.fit_regions = false; },
         "Faces of tets lie where they lie without regions")
      ->group(kGroup);
  add_list(
      app, "--region", "NAME=DENSITY,YOUNG,POISSON",
      [&options](const std::string& text) { options.materials.push_back(parse_region(text)); },
      "Material of a region; what is left out is that of the whole");
  add_pin_flags(app, options);
  app.add_flag(
         "--recentre", options.recentre,
         "Leave out how far a model lies from zero, as in map coordinates,\nwhere floats are too coarse for its size; "
         "the report has the offset")
      ->group(kGroup);
  add_flag(
      app, "--up", "x|y|z",
      [&options](const std::string& text) {
        if (text != "x" && text != "y" && text != "z") throw InvalidInput("--up " + text + ": must be x, y or z");
        options.up = text == "x" ? UpAxis::X : text == "y" ? UpAxis::Y : UpAxis::Z;
      },
      "Axis of the model that points up in scenes (y for .obj .gltf .glb,\nelse z) and in the preview (as the shape "
      "stands)")
      ->group(kGroup);
}

}  // namespace tetsoup::cli
