// What libFuzzer calls. Text is mutated by numbers, words and lines too, which plain flips of bytes seldom leave whole;
// archives get their checksums back.
#include <array>
#include <random>

#include "fuzz.h"
#include "repair.h"

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t most);

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  tetsoup::fuzz::fuzz_one({data, size});
  return 0;
}

namespace {

using Random = std::minstd_rand;

/// Numbers that readers have to think about.
constexpr std::array<std::string_view, 20> kNumbers{
    "0",          "-1",      "1",           "2",     "3",
    "255",        "256",     "65536",       "1e38",  "-1e39",
    "nan",        "inf",     "1e-310",      "1e400", "18446744073709551616",
    "4294967295", "9999999", "-2147483649", ".5",    "0x10"};

bool is_word(std::uint8_t c) {
  return c > ' ' && c != ',' && c != ':' && c != '"' && c != '{' && c != '}' && c != '[' && c != ']';
}

/// A word, or a line with its end: from `at` to both sides.
std::pair<std::size_t, std::size_t> piece_at(const std::string& text, std::size_t at, bool line) {
  const auto belongs = [&](std::size_t i) {
    return line ? text[i] != '\n' : is_word(static_cast<std::uint8_t>(text[i]));
  };
  std::size_t first = at, last = at;
  while (first > 0 && belongs(first - 1)) --first;
  while (last < text.size() && belongs(last)) ++last;
  if (line && last < text.size()) ++last;
  return {first, last - first};
}

void mutate_text(std::string& text, Random& random) {
  const bool line = random() % 3 == 0;
  const auto [first, count] = piece_at(text, random() % text.size(), line);
  const auto [other, other_count] = piece_at(text, random() % text.size(), line);
  const std::string copy = text.substr(other, other_count);
  switch (random() % 4) {
    case 0:
      text.erase(first, count);
      break;
    case 1:
      text.insert(first, line ? copy : copy + ' ');
      break;
    case 2:
      text.replace(first, count, copy);
      break;
    default:
      text.replace(first, count, kNumbers[random() % kNumbers.size()]);
      break;
  }
}

}  // namespace

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t most, unsigned seed) {
  Random random(seed + 1);
  if (size > 8 && random() % 2 == 0) {
    std::string text(reinterpret_cast<const char*>(data), size);
    for (auto times = 1 + random() % 3; times > 0 && !text.empty(); --times) mutate_text(text, random);
    size = std::min(text.size(), most);
    std::memcpy(data, text.data(), size);
  } else {
    size = LLVMFuzzerMutate(data, size, most);
  }
  if (random() % 8 != 0) tetsoup::fuzz::repair_checksums({data, size});
  return size;
}
