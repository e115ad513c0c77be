#include "linear/velocity_pressure/factorised_flow.hpp"

#include <cstdint>
#include <utility>

#include "fem/dimensions.hpp"
#include "fem/gather_blocks.hpp"
#include "fem/nodal_layout.hpp"

namespace fsi {

namespace {

constexpr double one = 1;

/// Unknowns under other numbers, without those that have none.
UnknownMap renumbered(UnknownMap map, const std::vector<std::int64_t>& place) {
  for (Unknown& unknown : map)
    if (unknown.index >= 0) unknown.index = place[unknown.index];
  return map;
}

}  // namespace

template <int n>
FactorisedFlow<n>::FactorisedFlow(const JacobianBlocks<n>& blocks, const VelocityPressureLayout<n>& layout,
                                  const DirectSolver::Options& options)
    : blocks_(blocks), layout_(layout), options_(options), solver_(options) {}

template <int n>
void FactorisedFlow<n>::gather() {
  const Numbering& numbering = blocks_.numbering;
  const auto size = static_cast<std::int64_t>(layout_.size());
  // The layout says where it has an unknown when it is asked for numbers that tell them apart.
  std::vector<double> names(numbering.size), named;
  for (std::size_t u = 0; u < names.size(); ++u) names[u] = static_cast<double>(u) + 1;
  layout_.take(names, named);
  std::vector<std::int64_t> place(numbering.size, -1);
  GatheredMatrix::Builder builder(size);
  for (std::int64_t i = 0; i < size; ++i) {
    const auto unknown = static_cast<std::int64_t>(named[i]) - 1;
    if (unknown >= 0)
      place[unknown] = i;
    else
      builder.add(i, i, &one, 1);
  }
  const UnknownMap fluid_rows = renumbered(numbering.fluid_rows, place);
  if (blocks_.wall)
    gather_blocks(builder, *blocks_.wall, renumbered(numbering.wall_rows, place), renumbered(numbering.wall, place));
  if (blocks_.fluid) gather_blocks(builder, *blocks_.fluid, fluid_rows, renumbered(numbering.fluid, place));
  if (blocks_.shape_derivatives) {
    const UnknownMap interface = renumbered(numbering.mesh, place);  // mesh displacements inside have no place
    UnknownMap momentum = fluid_rows;
    for (std::size_t node = 0; node * MixedLayout<n>::entries < momentum.size(); ++node) {
      bool moves = false;
      for (int k = 0; k < n; ++k) moves = moves || interface[node * n + k].index >= 0;
      for (int k = 0; k <= n; ++k)
        if (!moves || k == n) momentum[node * MixedLayout<n>::entries + k].index = -1;
    }
    gather_blocks(builder, *blocks_.shape_derivatives, momentum, interface);
  }
  matrix_ = GatheredMatrix(std::move(builder));
  gathered_ = numbering.version;
  solver_ = DirectSolver(options_);
}

template <int n>
void FactorisedFlow<n>::update() {
  if (matrix_.matrix().size() <= 0 || gathered_ != blocks_.numbering.version) gather();
  matrix_.update();
  solver_.factorise(matrix_.matrix());
  const std::vector<double> ones(layout_.size(), 1.0);
  std::vector<double> system(blocks_.numbering.columns(), 1.0);
  layout_.give(ones, system);
  layout_.take(system, scale_);
  for (double& scale : scale_)
    if (scale == 0) scale = 1;
}

template <int n>
void FactorisedFlow<n>::solve(const std::vector<double>& right, double tolerance, std::vector<double>& solution) {
  solver_.solve(matrix_.matrix(), right, solution, tolerance);
  for (std::size_t i = 0; i < solution.size(); ++i) solution[i] /= scale_[i];
}

template <int n>
double FactorisedFlow<n>::bytes() const {
  return solver_.bytes() + 24.0 * static_cast<double>(matrix_.matrix().nonzeros());
}

#define FSI_INSTANTIATE(n) template class FactorisedFlow<n>;
FSI_FOR_EACH_DIMENSION(FSI_INSTANTIATE)

}  // namespace fsi
