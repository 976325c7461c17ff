// What was found, assumed and made, in plain words.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "mesh_run.h"
#include "tetsoup/distance.h"
#include "tetsoup/io.h"
#include "tetsoup/pseudo_volume.h"
#include "tetsoup/quality.h"
#include "tetsoup/soup.h"

namespace tetsoup::cli {

/// 1234567 -> "1,234,567"
std::string grouped(std::size_t count);

/// "1 triangle", "2,013 triangles"
std::string counted(std::size_t count, std::string_view noun);

/// One paragraph: what the soup is, what was dropped, what is assumed about it.
std::string describe_soup(const std::string& name, const SoupReport& soup);

/// Grid, event band and what came out inside.
std::string describe_volume(const GridFrame& frame, const PseudoVolumeReport& volume, const SoupReport& soup);

/// The whole text that `tetsoup mesh` prints.
std::string describe_run(const MeshRun& run);

/// A table of the soup's numbers.
std::string tabulate_soup(const std::string& name, const SoupReport& soup, const std::vector<PartName>& parts);

/// The largest connected parts of a soup; nothing if it is of one.
std::string tabulate_connected_parts(const TriangleSoup& soup);

/// A table of a tet mesh's numbers, with a histogram of its dihedral angles.
std::string tabulate_tets(const std::string& name, const Quality& quality);

}  // namespace tetsoup::cli
