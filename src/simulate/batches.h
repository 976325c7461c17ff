// Which tets are solved side by side: those that share no vertex.
#pragma once

#include "simulate/rest.h"

namespace tetsoup::simulate {

/// Sets lanes, batches and colours of a rest: its tets in their order, each in the first batch that has room for it.
///
/// Up to kSharedTets every batch is a colour of its own, as full as its sixteen lanes allow. Larger pieces get few
/// colours without limit, cut into batches that threads can share.
void fill_batches(Rest& rest);

}  // namespace tetsoup::simulate
