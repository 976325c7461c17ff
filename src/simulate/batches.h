// Which tets are solved side by side: those that share no vertex.
#pragma once

#include "simulate/rest.h"

namespace tetsoup::simulate {

/// Sets lanes, batches and rounds of a rest: of each run the tets in their order, each in the first batch that has room
/// for it.
void fill_batches(Rest& rest);

}  // namespace tetsoup::simulate
