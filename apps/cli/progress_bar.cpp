#include "progress_bar.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>

#include "interrupt.h"

namespace tetsoup::cli {

namespace {

constexpr std::chrono::milliseconds kRedrawInterval{50};  // 20 pictures a second look smooth and cost nothing
constexpr std::size_t kBarWidth = 30;                     // columns; the whole line stays below 60

bool can_draw() {
  const char* const term = std::getenv("TERM");
  return isatty(STDERR_FILENO) != 0 && term != nullptr && std::string_view(term) != "dumb";
}

}  // namespace

ProgressBar::ProgressBar(bool quiet) : active_(!quiet && can_draw()) {}

void ProgressBar::show(std::string_view stage) {
  if (!active_) return;
  drawn_ = true;
  fmt::print(stderr, "\r\033[K{} ...", stage);
  std::fflush(stderr);
}

void ProgressBar::clear() {
  if (!drawn_) return;
  std::fputs("\r\033[K", stderr);
  std::fflush(stderr);
  drawn_ = false;
}

Progress ProgressBar::callback() {
  return [this](std::string_view stage, double fraction) {
    draw(stage, fraction);
    return !interrupted();
  };
}

void ProgressBar::draw(std::string_view stage, double fraction) {
  if (!active_) return;
  const auto now = std::chrono::steady_clock::now();
  if (stage == last_stage_ && now - last_drawn_ < kRedrawInterval) return;
  last_stage_ = stage;
  last_drawn_ = now;
  drawn_ = true;
  const double share = std::clamp(fraction, 0.0, 1.0);
  const auto filled = static_cast<std::size_t>(share * static_cast<double>(kBarWidth));
  fmt::print(stderr, "\r\033[K{:<16.16} [{}{}] {:3.0f} %", stage, std::string(filled, '#'),
             std::string(kBarWidth - filled, '-'), share * 100);
  std::fflush(stderr);
}

}  // namespace tetsoup::cli
