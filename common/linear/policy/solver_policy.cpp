#include "linear/policy/solver_policy.hpp"

#include <fmt/format.h>
#include <array>
#include <limits>
#include <string_view>
#include <utility>

namespace fsi {

namespace {

constexpr auto all = std::numeric_limits<std::int64_t>::max();

struct Row {
  SolvedSystem system;
  std::int64_t plane, space;  ///< sizes below which it is factorised, in two and in three dimensions
  std::string_view counted;   ///< what a size counts
  int strengthenings;         ///< of an iteration that fails
};

/// By measurement (docs/guide/solvers.md, docs/archive.md). Factors of a plane graph hardly fill in. In space
/// there is always a limit, since the memory of factors grows faster than the mesh.
/// - Harmonic motion: to three digits both take the same time at 18,000 inner nodes of an even mesh; on a graded one of 12,000
///   the factor is three times as quick. Larger meshes were not measured.
/// - Tangent: the size at which a factorisation and the sixty solves that a driver does with it take about as long as
///   the iteration, which takes a tenth of the memory. In space factors of 6700 nodes take 0.6 s, a solve by them
///   0.02 s, by iteration 0.014 s to 1e-3 and 0.05 s to 1e-12; on the artery's 1900 nodes the drivers lose a tenth to a
///   quarter by iterating.
/// - Schur complement: in the plane a solve takes half of a cycle's time; where -S is not positive definite a cycle serves.
///   On several processes, and by `petsc`, factors halve the iterations of PETSc's cycle, and take no longer.
constexpr std::array<Row, 6> rows{{
    {SolvedSystem::jacobian, 200000, 2000, "unknowns", 1},
    {SolvedSystem::harmonic_mesh_motion, 200000, 30000, "inner nodes", 0},
    {SolvedSystem::tangent_mesh_motion, 50000, 6000, "inner nodes", 0},
    {SolvedSystem::shared_mesh_motion, 200000, 2000, "unknowns", 0},
    {SolvedSystem::schur_complement, all, 0, "pressures", 0},
    {SolvedSystem::shared_schur_complement, 20000, 2000, "pressures", 0},
}};

constexpr const Row& row_of(SolvedSystem system) {
  return rows[static_cast<std::size_t>(system)];
}

constexpr bool rows_stand_in_order() {
  for (std::size_t i = 0; i < rows.size(); ++i)
    if (rows[i].system != static_cast<SolvedSystem>(i)) return false;
  return true;
}
static_assert(rows_stand_in_order());

}  // namespace

SolverPolicy::SolverPolicy(SolvedSystem system, int dimension) : SolverPolicy(system, dimension, Demands()) {}

SolverPolicy::SolverPolicy(SolvedSystem system, int dimension, Demands demands)
    : system_(system), dimension_(dimension), demands_(demands) {}

std::int64_t SolverPolicy::standard_limit(SolvedSystem system, int dimension) {
  return dimension == 2 ? row_of(system).plane : row_of(system).space;
}

std::int64_t SolverPolicy::factorises_below() const {
  return demands_.options_of_iteration ? 0 : demands_.factorise_below.value_or(standard_limit(system_, dimension_));
}

SolverDecision SolverPolicy::decide(std::int64_t size) const {
  if (demands_.options_of_iteration) return {true, "iterated: the case has options of the iteration"};
  const std::int64_t limit = factorises_below();
  const bool iterates = size >= limit;
  return {iterates,
          fmt::format("{}{}: {} {}, the limit is {}{}", iterates ? "iterated" : "factorised",
                      !iterates && demands_.processes > 1 ? " at the first process" : "", size, row_of(system_).counted,
                      limit, demands_.factorise_below ? " as the case demands" : "")};
}

bool SolverPolicy::wall_decides(std::int64_t size) const {
  return system_ == SolvedSystem::jacobian && dimension_ == 2 && !demands_.factorise_below &&
         size >= wall_decides_from && size < factorises_below();
}

SolverDecision SolverPolicy::decide_by_wall(double stiffness_over_inertia) const {
  const bool iterates = stiffness_over_inertia < wall_iterates_below;
  return {iterates, fmt::format("{}: the wall's stiffness is {:.2g} times its inertia, the limit is {:g}",
                                iterates ? "iterated" : "factorised", stiffness_over_inertia, wall_iterates_below)};
}

std::string SolverPolicy::rule_of_wall() {
  return fmt::format(
      "each Jacobian is iterated on where its wall's stiffness is below {:g} times its inertia, else factorised",
      wall_iterates_below);
}

int SolverPolicy::strengthenings() const {
  return row_of(system_).strengthenings;
}

}  // namespace fsi
