#include "kernel/triangle_distance.h"

namespace tetsoup::kernel {

void lower_row(const TrianglePlan& t, int x0, int y, int z, std::span<float> row) {
  const TrianglePlan plan = t;  // a copy, so that the loop need not fear that `row` overwrites it
  const auto fy = static_cast<float>(y), fz = static_cast<float>(z);
  const int count = static_cast<int>(row.size());
  float* values = row.data();
  for (int i = 0; i < count; ++i) {
    const float square = squared_distance(plan, static_cast<float>(x0 + i), fy, fz);
    values[i] = square < values[i] ? square : values[i];
  }
}

}  // namespace tetsoup::kernel
