// The soups that are measured, and what the stages before a measured one make of them.
#pragma once

#include <filesystem>
#include <string>

#include "tetsoup/tetsoup.h"

namespace tetsoup::bench {

enum class SoupName {
  Input,         ///< What --input names; a subdivided sample where that file is absent.
  OneTriangle,   ///< The least there can be.
  ManyTriangles  ///< The torus of the paper, its 640 triangles cut into about 900,000.
};

/// "input", "one_triangle", "many_triangles": part of a row's name.
std::string text_of(SoupName name);

/// Chooses the file behind SoupName::Input; before anything else here is called.
void set_input(const std::filesystem::path& path);

/// Path of the input, or the sample that stands for it.
std::string input_summary();

const TriangleSoup& raw_soup(SoupName name);
const CleanSoup& clean_soup_of(SoupName name);

/// The input as a .ply and as an .obj file: itself, or a copy of it in a temporary folder.
std::filesystem::path input_file(const std::string& extension);

inline constexpr double kTetCount = 3000;  ///< Size of the meshes that lattice, smoothing and sliders work on.

/// Options that give about kTetCount tets over a pseudo volume.
LatticeOptions lattice_for(const PseudoVolume& volume);

/// A pipeline that has run on this soup and grid with the automatic threshold and about kTetCount tets. Kept until
/// another soup or grid is asked for, since many rows in a row want the same one.
struct Prepared {
  Pipeline pipeline;
  MeshOptions options;
};
Prepared& prepared(SoupName name, int voxels);

}  // namespace tetsoup::bench
