#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "case/case.hpp"
#include "partitioned/accelerators/accelerator.hpp"
#include "partitioned/interface_space.hpp"

namespace fsi {

/// Loosely coupled Robin-Robin schemes.
enum class Loose {
  no,
  in_turn,    ///< the wall, then the fluid
  corrected,  ///< twice so: the second time with data that the first has predicted
  at_once     ///< both from data of the last step
};

/// A coupling scheme: how one pass goes through the sub-problems, and how passes are accelerated.
struct CouplingScheme {
  std::string_view name;     ///< partitioned.scheme, one of coupling_scheme_names()
  bool robin;                ///< Robin-Neumann, else Dirichlet-Neumann
  bool extrapolates_domain;  ///< the fluid's, once a step
  bool one_pass;             ///< a step is one pass, converged or not
  Loose loose;               ///< how, where both media have Robin conditions
  std::unique_ptr<Accelerator> (*make_accelerator)(const PartitionedData& options, const InterfaceSpace& space);
  const char* advice;  ///< what helps when it does not converge
};

/// \throws InputError for a name that is not in the table
const CouplingScheme& coupling_scheme(const std::string& name);

}  // namespace fsi
