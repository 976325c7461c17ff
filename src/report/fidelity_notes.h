// What became of the model's shape, as sentences.
#pragma once

#include <string>
#include <vector>

#include "tetsoup/report.h"

namespace tetsoup {

void note_fidelity(const Findings& found, std::vector<std::string>& notes);

}  // namespace tetsoup
