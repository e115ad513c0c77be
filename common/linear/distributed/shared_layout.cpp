#include "linear/distributed/shared_layout.hpp"

#include <algorithm>
#include <limits>
#include <numeric>

#include "base/error.hpp"
#include "fem/dimensions.hpp"
#include "linear/distributed/petsc_options.hpp"

namespace fsi {

template <int n>
SharedLayout<n>::SharedLayout(const JacobianBlocks<n>& blocks, const VelocityPressureLayout<n>& layout)
    : own_velocities(layout.own_velocities),
      own_pressures(layout.own_pressures),
      owns_velocity(layout.velocities, 0),
      owns_pressure(layout.pressures, 0),
      ghosts_(blocks, layout) {
  std::iota(own_velocities.begin(), own_velocities.end(), 0);
  std::iota(own_pressures.begin(), own_pressures.end(), 0);
  std::fill_n(owns_velocity.begin(), layout.own_velocities, 1);
  std::fill_n(owns_pressure.begin(), layout.own_pressures, 1);
  const ShareOfNumbers &velocities = ghosts_.velocities, &pressures = ghosts_.pressures;
  double whole[2] = {static_cast<double>(velocities.own), static_cast<double>(pressures.own)};
  blocks.numbering.processes->sum(whole, 2);
  whole_velocities = whole[0];
  whole_pressures = whole[1];
  if (n * whole_velocities + whole_pressures > std::numeric_limits<PetscInt>::max())
    throw InputError(case_of_petsc_options(), "linear_solver", "more unknowns than PETSc counts as it is installed",
                     "take a coarser mesh");
  first_velocity = static_cast<PetscInt>(velocities.first);
  velocity_rows = static_cast<PetscInt>(n * velocities.own);
  pressure_rows = static_cast<PetscInt>(pressures.own);
  const std::int64_t first = n * velocities.first + pressures.first;
  const auto numbers_of = [](const ShareOfNumbers& share) {
    std::vector<PetscInt> numbers(share.items());
    for (int item = 0; item < share.items(); ++item) numbers[item] = static_cast<PetscInt>(share.number(item));
    return numbers;
  };
  const auto places_of = [](const ShareOfNumbers& share, std::int64_t begin, int step) {
    std::vector<double> places(share.items());
    for (int item = 0; item < share.own; ++item) places[item] = static_cast<double>(begin + std::int64_t{step} * item);
    share.exchange.update(places);
    return std::vector<PetscInt>(places.begin(), places.end());
  };
  velocity_number = numbers_of(velocities);
  pressure_number = numbers_of(pressures);
  velocity_place = places_of(velocities, first, n);
  pressure_place = places_of(pressures, first + velocity_rows, 1);
}

#define FSI_INSTANTIATE(n) template class SharedLayout<n>;
FSI_FOR_EACH_DIMENSION(FSI_INSTANTIATE)

}  // namespace fsi
