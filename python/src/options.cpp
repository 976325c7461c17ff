#include "options.h"

#include <cstddef>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "tetsoup/error.h"
#include "words.h"

namespace tetsoup::python {

namespace {

// --- Values from Python: false where one does not fit
// -----------------------------------------------------------------

template <class T>
requires std::is_arithmetic_v<T>
bool read(nb::handle value, T& number) {
  return !PyBool_Check(value.ptr()) && nb::try_cast(value, number);
}

template <class E>
requires std::is_enum_v<E>
bool read(nb::handle value, E& choice) {
  if (!PyUnicode_Check(value.ptr())) return false;
  const std::string_view given = nb::cast<nb::str>(value).c_str();
  for (const auto& [word, named] : kWords<E>) {
    if (given != word) continue;
    choice = named;
    return true;
  }
  return false;
}

bool read(nb::handle value, Vec3d& v);  // an item of the next, and made of items

template <std::size_t N, class T>
bool read_items(nb::handle value, std::array<T*, N> items) {
  // Anything that iterates, but text: lists, tuples, arrays.
  if (PyUnicode_Check(value.ptr()) || !PySequence_Check(value.ptr())) return false;
  if (nb::len(value) != N) return false;
  for (std::size_t i = 0; i < N; ++i) {
    const nb::object item = value[i];
    if (!read(item, *items[i])) return false;
  }
  return true;
}

bool read(nb::handle value, Vec3d& v) {
  return read_items(value, std::array{&v.x, &v.y, &v.z});
}
bool read(nb::handle value, Box3& box) {
  return read_items(value, std::array{&box.lo, &box.hi});
}

template <class T>
bool read(nb::handle value, std::optional<T>& maybe) {
  maybe.reset();
  return value.is_none() || read(value, maybe.emplace());
}

// --- What would have fitted, for messages
// -----------------------------------------------------------------------------

template <class T>
struct Expected {
  static std::string text() {
    if constexpr (std::is_enum_v<T>) {
      std::string words;
      for (const auto& [word, named] : kWords<T>) words += std::string(words.empty() ? "'" : "', '") + word;
      return "one of " + words + "'";
    } else if constexpr (std::is_floating_point_v<T>) {
      return "a number";
    } else {
      return std::is_signed_v<T> ? "a whole number" : "a whole number of at least 0";
    }
  }
};
template <>
struct Expected<Vec3d> {
  static std::string text() { return "three numbers"; }
};
template <>
struct Expected<Box3> {
  static std::string text() { return "two corners of three numbers each"; }
};
template <class T>
struct Expected<std::optional<T>> {
  static std::string text() { return Expected<T>::text() + ", or None"; }
};

// --- Values to Python
// -------------------------------------------------------------------------------------------------

template <class T>
nb::object show(const T& value) {
  if constexpr (std::is_enum_v<T>)
    return nb::str(word_of(value));
  else
    return nb::cast(value);
}
nb::object show(const Vec3d& v) {
  return nb::make_tuple(v.x, v.y, v.z);
}
nb::object show(const Box3& box) {
  return nb::make_tuple(show(box.lo), show(box.hi));
}
template <class T>
nb::object show(const std::optional<T>& maybe) {
  return maybe ? show(*maybe) : nb::none();
}

// --- The table
// --------------------------------------------------------------------------------------------------------

struct Option {
  std::string_view stage;
  const char* keyword;
  void (*set)(MeshOptions& options, const char* keyword, nb::handle value);
  nb::object (*get)(const MeshOptions& options);
};

/// An option that lies in MeshOptions where the pointers to members lead.
template <auto... Path>
Option option(std::string_view stage, const char* keyword) {
  return {stage, keyword,
          [](MeshOptions& options, const char* name, nb::handle value) {
            auto& member = (options.*....*Path);
            if (!read(value, member))
              throw InvalidInput(std::string(name) + " = " + nb::repr(value).c_str() + ", must be " +
                                 Expected<std::remove_reference_t<decltype(member)>>::text());
          },
          [](const MeshOptions& options) { return show((options.*....*Path)); }};
}

/// One line an option. Its type and what it means stand in python/tetsoup/options.py.
const std::vector<Option>& all_options() {
  constexpr auto kDistance = &MeshOptions::distance;
  constexpr auto kVolume = &MeshOptions::pseudo_volume;
  constexpr auto kLattice = &MeshOptions::lattice;
  constexpr auto kTopology = &LatticeOptions::topology;
  constexpr auto kSmooth = &MeshOptions::smooth;
  static const std::vector<Option> options{
      option<kDistance, &DistanceOptions::voxels>("distance", "voxels"),
      option<kDistance, &DistanceOptions::voxel_size>("distance", "voxel_size"),
      option<kDistance, &DistanceOptions::box>("distance", "box"),
      option<kDistance, &DistanceOptions::band_voxels>("distance", "distance_band_voxels"),
      option<kDistance, &DistanceOptions::mode>("distance", "distance_mode"),
      option<kVolume, &PseudoVolumeOptions::k>("pseudo_volume", "k"),
      option<kVolume, &PseudoVolumeOptions::band_voxels>("pseudo_volume", "band_voxels"),
      option<kVolume, &PseudoVolumeOptions::band>("pseudo_volume", "band"),
      option<kVolume, &PseudoVolumeOptions::rays>("pseudo_volume", "rays"),
      option<kVolume, &PseudoVolumeOptions::placement>("pseudo_volume", "placement"),
      option<kVolume, &PseudoVolumeOptions::cavities>("pseudo_volume", "cavities"),
      option<kLattice, &LatticeOptions::tets>("lattice", "tets"),
      option<kLattice, &LatticeOptions::vertices>("lattice", "mesh_vertices"),
      option<kLattice, &LatticeOptions::edge>("lattice", "edge"),
      option<kLattice, &LatticeOptions::cells>("lattice", "cells"),
      option<kLattice, &LatticeOptions::cell_size>("lattice", "cell_size"),
      option<kLattice, &LatticeOptions::kind>("lattice", "lattice"),
      option<kLattice, &LatticeOptions::translate_cells>("lattice", "translate_cells"),
      option<kLattice, &LatticeOptions::rotate>("lattice", "rotate"),
      option<kLattice, &LatticeOptions::fit>("lattice", "fit"),
      option<kLattice, &LatticeOptions::rho_min>("lattice", "rho_min"),
      option<kLattice, &LatticeOptions::thin>("lattice", "thin"),
      option<kLattice, &LatticeOptions::cover>("lattice", "cover"),
      option<kLattice, &LatticeOptions::separate>("lattice", "separate"),
      option<kLattice, &LatticeOptions::stairs>("lattice", "stairs"),
      option<kLattice, kTopology, &TopologyOptions::touching>("lattice", "touching"),
      option<kLattice, kTopology, &TopologyOptions::min_part>("lattice", "min_part"),
      option<kLattice, kTopology, &TopologyOptions::bubbles>("lattice", "bubbles"),
      option<kLattice, kTopology, &TopologyOptions::boundary_only>("lattice", "boundary_only"),
      option<kSmooth, &SmoothOptions::passes>("smooth", "passes"),
      option<kSmooth, &SmoothOptions::strength>("smooth", "strength"),
      option<kSmooth, &SmoothOptions::min_dihedral>("smooth", "min_dihedral"),
      option<kSmooth, &SmoothOptions::max_dihedral>("smooth", "max_dihedral"),
      option<kSmooth, &SmoothOptions::max_edge_ratio>("smooth", "max_edge_ratio"),
      option<kSmooth, &SmoothOptions::snap>("smooth", "snap"),
      option<&MeshOptions::memory_limit>("run", "memory_limit"),
  };
  return options;
}

bool belongs(const Option& option, std::string_view stage) {
  return stage.empty() || option.stage == stage;
}

}  // namespace

MeshOptions read_options(nb::dict keywords, std::string_view stage) {
  MeshOptions options;
  for (const auto& [key, value] : keywords) {
    const std::string keyword = nb::cast<nb::str>(key).c_str();
    const Option* found = nullptr;
    for (const Option& option : all_options())
      if (keyword == option.keyword && belongs(option, stage)) found = &option;
    if (found == nullptr) throw nb::type_error(("there is no option '" + keyword + "' here").c_str());
    found->set(options, found->keyword, value);
  }
  return options;
}

nb::typed<nb::dict, nb::str, nb::any> describe_options(const MeshOptions& options, std::string_view stage) {
  nb::typed<nb::dict, nb::str, nb::any> values;
  for (const Option& option : all_options())
    if (belongs(option, stage)) values[option.keyword] = option.get(options);
  return values;
}

}  // namespace tetsoup::python
