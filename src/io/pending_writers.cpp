// Stands in for writers that this tree does not have.
#include "io/tet_writers.h"
#include "tetsoup/error.h"

namespace tetsoup {

std::string usda_text(const TetModel&) {
  throw InvalidInput("format usd: not built in");
}

}  // namespace tetsoup
