#pragma once

#include <memory>

#include "case/case.hpp"
#include "partitioned/accelerators/accelerator.hpp"
#include "partitioned/interface_space.hpp"

/// Accelerators by the options of a case, each with the relaxation that suits its passes: those of Dirichlet-Neumann
/// overshoot, those of Robin-Neumann (robin..., regularised) do not. `space` is copied.
namespace fsi::accelerators {

using Made = std::unique_ptr<Accelerator>;
Made constant(const PartitionedData& options, const InterfaceSpace& space);
Made aitken(const PartitionedData& options, const InterfaceSpace& space);
Made iqn_ils(const PartitionedData& options, const InterfaceSpace& space);
Made iqn_imvj(const PartitionedData& options, const InterfaceSpace& space);
Made newton_krylov(const PartitionedData& options, const InterfaceSpace& space);
Made robin(const PartitionedData& options, const InterfaceSpace& space);
Made robin_iqn(const PartitionedData& options, const InterfaceSpace& space);
Made regularised(const PartitionedData& options, const InterfaceSpace& space);
Made robin_imvj(const PartitionedData& options, const InterfaceSpace& space);

}  // namespace fsi::accelerators
