// Prints, for a battery of models, how much the automatic choice of k loses; scripts/choice_of_k makes a table of it.
//
//   choice_of_k [--seed N] [--voxels N] MODEL ...      a file, or the name of a sample
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>

#include "choice_of_k.h"
#include "tetsoup/io.h"

namespace tetsoup::test {
namespace {

struct Arguments {
  std::uint64_t seed = 1;
  std::vector<int> voxels{96, 160};
  std::vector<std::string> models;
};

Arguments parse(int argc, char** argv) {
  Arguments arguments;
  for (int i = 1; i < argc; ++i) {
    const std::string argument = argv[i];
    if (argument == "--seed" && i + 1 < argc)
      arguments.seed = std::strtoull(argv[++i], nullptr, 10);
    else if (argument == "--voxels" && i + 1 < argc)
      arguments.voxels = {std::atoi(argv[++i])};
    else
      arguments.models.push_back(argument);
  }
  return arguments;
}

void print_header() {
  std::printf("model,voxels,damage");
  for (const double band : kFixedBands) std::printf(",%g", band);
  std::printf(",best,best_band,auto,auto_band,loss\n");
}

void print_rows(const std::string& model, const Arguments& arguments) {
  const bool is_file = std::filesystem::exists(model);
  TrueSolid truth(is_file ? read_soup(model) : make_sample(model));
  const std::string name = is_file ? std::filesystem::path(model).stem().string() : model;
  for (const Damage& damage : make_damages(truth.intact(), arguments.seed)) {
    for (const int voxels : arguments.voxels) {
      const BandTrial trial = try_bands(damage.soup, truth, voxels);
      std::printf("%s,%d,%s", name.c_str(), voxels, damage.name.c_str());
      for (const double iou : trial.fixed) std::printf(",%.4f", iou);
      std::printf(",%.4f,%g,%.4f,%g,%.4f\n", trial.best(), trial.best_band(), trial.automatic, trial.automatic_band,
                  trial.loss());
      std::fflush(stdout);
    }
  }
}

}  // namespace
}  // namespace tetsoup::test

int main(int argc, char** argv) {
  const auto arguments = tetsoup::test::parse(argc, argv);
  tetsoup::test::print_header();
  for (const std::string& model : arguments.models) tetsoup::test::print_rows(model, arguments);
}
