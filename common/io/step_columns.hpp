#pragma once

#include "io/column.hpp"
#include "io/step_record.hpp"
#include "time/stepper.hpp"

namespace fsi {

/// What coupling.csv says of a step.
struct CouplingRecord {
  int passes = 0;
  CouplingReport report;
};

/// Columns of the tables of steps, behind the step and its time.
const Columns<StepRecord>& iteration_columns();
const Columns<CouplingRecord>& coupling_columns();

}  // namespace fsi
