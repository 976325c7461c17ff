// A calibrated model for formats that do not take a modulus for every tet.
#pragma once

#include "tetsoup/io.h"
#include "tetsoup/tet_model.h"

namespace tetsoup {

/// Every region in up to eight, by steps of the logarithm of the tets' stiffness: each with the mean modulus of its
/// tets and their mean density. Nothing is left of the scales but the factor, which tells that there were some.
TetModel in_stiffness_steps(const TetModel& model);

/// Every region with Young's modulus times the one factor, which stays in the model to be told, and with the mean
/// density of its tets.
TetModel with_one_factor(const TetModel& model);

/// What a file of that form is to be made of. A model that was not calibrated stays as it is.
TetModel calibrated_as(CalibrationForm form, const TetModel& model);

}  // namespace tetsoup
