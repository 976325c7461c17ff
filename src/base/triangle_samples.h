// Points spread over a triangle, as weights of its corners.
#pragma once

#include <array>
#include <cstddef>

namespace tetsoup {

inline constexpr std::size_t kSamples = 6;
inline constexpr std::array<std::array<double, 3>, kSamples> kSampleWeights{{{7.0 / 9, 1.0 / 9, 1.0 / 9},
                                                                             {1.0 / 9, 7.0 / 9, 1.0 / 9},
                                                                             {1.0 / 9, 1.0 / 9, 7.0 / 9},
                                                                             {1.0 / 9, 4.0 / 9, 4.0 / 9},
                                                                             {4.0 / 9, 1.0 / 9, 4.0 / 9},
                                                                             {4.0 / 9, 4.0 / 9, 1.0 / 9}}};

}  // namespace tetsoup
