// The samples themselves, each by formula; samples.cpp lists them.
#pragma once

#include <cstdint>

#include "tetsoup/types.h"

namespace tetsoup::samples {

TriangleSoup make_torus();
TriangleSoup make_heart();
TriangleSoup make_sphere();
TriangleSoup make_robot();
TriangleSoup make_tree(std::uint64_t seed);
TriangleSoup make_palm(std::uint64_t seed);
TriangleSoup make_cup(double wall);
TriangleSoup make_pipe(double wall);
TriangleSoup make_tray(double wall);
TriangleSoup make_comb(double wall);
TriangleSoup make_chain(double wall);

}  // namespace tetsoup::samples
