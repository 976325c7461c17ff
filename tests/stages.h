// What lattice tests start from: a soup and its pseudo volume.
#pragma once

#include "tetsoup/distance.h"
#include "tetsoup/lattice.h"

namespace tetsoup::test {

struct Stages {
  CleanSoup soup;
  PseudoVolume volume;
};

inline Stages classify(const TriangleSoup& soup, int voxels) {
  Stages s{clean_soup(soup), {}};
  DistanceOptions options;
  options.voxels = voxels;
  options.band_voxels = 10;
  s.volume = classify_volume(unsigned_distance(s.soup, options));
  return s;
}

inline LatticeMesh fill(const Stages& s, const LatticeOptions& options = {}) {
  return fill_lattice(s.volume, s.soup, options);
}

}  // namespace tetsoup::test
