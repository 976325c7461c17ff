// One line on the terminal that says which stage runs and how far it is.
#pragma once

#include <chrono>
#include <string>
#include <string_view>

#include "tetsoup/progress.h"

namespace tetsoup::cli {

class ProgressBar {
 public:
  /// Draws only if standard error is a terminal that can overwrite a line, and not if `quiet`.
  explicit ProgressBar(bool quiet);
  ~ProgressBar() { clear(); }
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  /// Shows a step that does not report fractions.
  void show(std::string_view stage);
  void clear();

  /// For the stages; answers false once the user has pressed Ctrl-C. The bar must outlive it.
  Progress callback();

 private:
  void draw(std::string_view stage, double fraction);

  bool active_ = false;
  bool drawn_ = false;
  std::string last_stage_;
  std::chrono::steady_clock::time_point last_drawn_{};
};

}  // namespace tetsoup::cli
