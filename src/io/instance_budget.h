// What a small file may grow to by showing the same things again and again.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "io/soup_readers.h"

namespace tetsoup::readers {

class InstanceBudget {
 public:
  /// @param file_bytes  What the file itself can hold, unpacked.
  InstanceBudget(std::string_view name, std::size_t file_bytes) : name_(name), most_(kFree + file_bytes) {}

  /// Before one thing more is shown. @throws IoError
  void take(std::size_t vertices, std::size_t triangles) {
    ++shown_;
    if (shown_ <= most_ && vertices <= most_ - vertices_ && triangles <= most_ - triangles_) {
      vertices_ += vertices;
      triangles_ += triangles;
      return;
    }
    fail(name_, "its instances add up to more than " + std::to_string(most_) + " vertices, triangles or instances");
  }

 private:
  static constexpr std::size_t kFree = 8'000'000;  // 8 million vertices take 0.2 GB

  std::string_view name_;
  std::size_t most_, shown_ = 0, vertices_ = 0, triangles_ = 0;
};

/// Things within things within things; more are a circle, or were made to harm.
inline constexpr std::size_t kDeepestNesting = 64;

}  // namespace tetsoup::readers
