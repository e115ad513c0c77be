#pragma once

#include <vector>

#include "fem/function_space.hpp"
#include "mesh/submesh.hpp"
#include "parallel/communicator.hpp"
#include "time/state.hpp"
#include "time/step_data.hpp"
#include "wall/wall.hpp"

namespace fsi {

/// A difference of two solutions in one medium.
struct FieldDifference {
  const std::vector<double>& volumes;     ///< that belong to the nodes, mm^3; zero where another process counts them
  const std::vector<double>& difference;  ///< a vector and a scalar per node; empty: there is no such medium
};

/// A difference of solutions relative to what the step in progress changes: the largest over velocity, the wall's
/// displacement and the pressures of both, in L2 norms (docs/theory.md, section 9.3). One norm of all fields would hide
/// errors of displacements to which the pressures of the next step are sensitive.
/// \param state  its `now` less the solution before is the change
template <int n>
double relative_to_step(const State& state, const StepData& data, const FieldDifference& fluid,
                        const FieldDifference& wall, const Communicator& processes);

/// Distance of two displacements of the wall relative to that of the second from `before`, in L2 norms over all
/// processes. Arrays (d, .) in the mixed layout; 0 where both are the same.
template <int n>
double relative_distance(const Wall<n>& wall, const std::vector<double>& before, const std::vector<double>& one,
                         const std::vector<double>& other);

/// Whether the wall stays but for rounding: the root mean square of its motion is at most 1e-9 of its size, the cube
/// root of its volume. Over all processes.
template <int n>
bool stays(const Wall<n>& wall, const std::vector<double>& before, const std::vector<double>& after);

/// The volumes that belong to the nodes of a part, mm^3; zero at nodes of other processes, which count them.
template <int n>
std::vector<double> owned_volumes(const FunctionSpace<n>& space, const PartNodes& part);

}  // namespace fsi
