#include "linear/distributed/shared_layout.hpp"

#include <limits>
#include <string>

#include "base/error.hpp"
#include "fem/dimensions.hpp"
#include "linear/distributed/petsc_options.hpp"

namespace fsi {

template <int n>
SharedLayout<n>::SharedLayout(const JacobianBlocks<n>& blocks, const VelocityPressureLayout<n>& layout)
    : owns_velocity(layout.velocities),
      owns_pressure(layout.pressures),
      parts_{blocks.fluid_nodes, blocks.wall_nodes},
      layout_(layout) {
  const auto owns = [&](bool wall, int node) { return (wall ? blocks.wall_nodes : blocks.fluid_nodes)->owns(node); };
  for (int v = 0; v < layout.velocities; ++v) {
    layout.for_nodes_of(v, [&](const auto& of) { owns_velocity[v] = owns(of.wall, of.node); });
    if (owns_velocity[v]) own_velocities.push_back(v);
  }
  for (int p = 0; p < layout.pressures; ++p) {
    owns_pressure[p] = owns(layout.wall_pressure[p] != 0, layout.node_of_pressure[p]);
    if (owns_pressure[p]) own_pressures.push_back(p);
  }
  const Communicator& processes = *blocks.numbering.processes;
  const auto velocities = static_cast<std::int64_t>(own_velocities.size());
  const auto pressures = static_cast<std::int64_t>(own_pressures.size());
  double whole[2] = {static_cast<double>(velocities), static_cast<double>(pressures)};
  processes.sum(whole, 2);
  whole_velocities = whole[0];
  whole_pressures = whole[1];
  if (n * whole_velocities + whole_pressures > std::numeric_limits<PetscInt>::max())
    throw InputError(case_of_petsc_options(), "linear_solver", "more unknowns than PETSc counts as it is installed",
                     "take a coarser mesh");
  const std::int64_t v_before = processes.sum_before(velocities), p_before = processes.sum_before(pressures);
  first_velocity = static_cast<PetscInt>(v_before);
  velocity_rows = static_cast<PetscInt>(n * velocities);
  pressure_rows = static_cast<PetscInt>(pressures);

  velocity_number.assign(layout.velocities, -1);
  velocity_place = velocity_number;
  pressure_number.assign(layout.pressures, -1);
  pressure_place = pressure_number;
  const std::int64_t first = n * v_before + p_before;
  for (std::int64_t i = 0; i < velocities; ++i) {
    velocity_number[own_velocities[i]] = static_cast<PetscInt>(v_before + i);
    velocity_place[own_velocities[i]] = static_cast<PetscInt>(first + n * i);
  }
  for (std::int64_t i = 0; i < pressures; ++i) {
    pressure_number[own_pressures[i]] = static_cast<PetscInt>(p_before + i);
    pressure_place[own_pressures[i]] = static_cast<PetscInt>(first + n * velocities + i);
  }
  // Copies get the numbers that their owners gave, node by node of each medium.
  constexpr int entries = 4;
  for (const bool wall : {false, true}) {
    const PartNodes* part = wall ? blocks.wall_nodes : blocks.fluid_nodes;
    if (part == nullptr || !part->share) continue;
    const auto& velocity_of = wall ? layout.velocity_of_wall : layout.velocity_of_fluid;
    const auto& pressure_of = wall ? layout.pressure_of_wall : layout.pressure_of_fluid;
    std::vector<double> numbers(velocity_of.size() * entries, -1.0);
    for (std::size_t a = 0; a < velocity_of.size(); ++a) {
      double* of = numbers.data() + a * entries;
      if (const int v = velocity_of[a]; v >= 0) {
        of[0] = velocity_number[v];
        of[1] = velocity_place[v];
      }
      if (const int p = pressure_of[a]; p >= 0) {
        of[2] = pressure_number[p];
        of[3] = pressure_place[p];
      }
    }
    part->share->exchange.update(numbers, entries);
    for (std::size_t a = 0; a < velocity_of.size(); ++a) {
      const double* of = numbers.data() + a * entries;
      if (const int v = velocity_of[a]; v >= 0 && !owns_velocity[v]) {
        velocity_number[v] = static_cast<PetscInt>(of[0]);
        velocity_place[v] = static_cast<PetscInt>(of[1]);
      }
      if (const int p = pressure_of[a]; p >= 0 && !owns_pressure[p]) {
        pressure_number[p] = static_cast<PetscInt>(of[2]);
        pressure_place[p] = static_cast<PetscInt>(of[3]);
      }
    }
  }
}

template <int n>
void SharedLayout<n>::update_velocities(std::vector<double>& per_velocity) const {
  for (const bool wall : {false, true}) {
    const PartNodes* part = parts_[wall ? 1 : 0];
    if (part == nullptr || !part->share) continue;
    const auto& velocity_of = wall ? layout_.velocity_of_wall : layout_.velocity_of_fluid;
    std::vector<double> of_nodes(velocity_of.size(), 0.0);
    for (std::size_t a = 0; a < of_nodes.size(); ++a)
      if (velocity_of[a] >= 0) of_nodes[a] = per_velocity[velocity_of[a]];
    part->share->exchange.update(of_nodes);
    for (std::size_t a = 0; a < of_nodes.size(); ++a)
      if (const int v = velocity_of[a]; v >= 0 && !owns_velocity[v]) per_velocity[v] = of_nodes[a];
  }
}

#define FSI_INSTANTIATE(n) template class SharedLayout<n>;
FSI_FOR_EACH_DIMENSION(FSI_INSTANTIATE)

}  // namespace fsi
