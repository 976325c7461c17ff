// Included before any header of Eigen, by every file that includes one.
#pragma once

// One order of operations on every machine. Everywhere or nowhere: it decides how memory is aligned, and what one file
// takes may be given back by a function that the linker took from another.
#define EIGEN_DONT_VECTORIZE
