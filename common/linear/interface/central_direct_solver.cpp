#include "linear/interface/central_direct_solver.hpp"

#include <cstddef>
#include <utility>

#include "fem/dimensions.hpp"
#include "linear/interface/direct_linear_solver.hpp"

namespace fsi {

namespace {

/// Of a system's unknowns in their local numbers.
struct GlobalBuilder {
  const Numbering& numbering;
  GatheredMatrix::Builder terms{numbering.whole_size()};

  void add(std::int64_t row, std::int64_t column, const double* number, double factor) {
    terms.add(numbering.first + row, numbering.global(column), number, factor);
  }
};

}  // namespace

template <int n>
CentralDirectSolver<n>::CentralDirectSolver(const JacobianBlocks<n>& blocks) : blocks_(blocks) {}

template <int n>
void CentralDirectSolver<n>::update() {
  const Numbering& numbering = blocks_.numbering;
  if (gathered_ != numbering.version) {
    GlobalBuilder builder{numbering};
    gather_jacobian_blocks(builder, blocks_);
    factors_ = CentralFactorisation(*numbering.processes, std::move(builder.terms));
    gathered_ = numbering.version;
  }
  factors_.update();
}

template <int n>
LinearReport CentralDirectSolver<n>::solve(const std::vector<double>& b, double, std::vector<double>& x) {
  const Numbering& numbering = blocks_.numbering;
  factors_.solve(b, whole_);
  x.resize(numbering.columns());
  for (std::size_t i = 0; i < x.size(); ++i) x[i] = whole_[numbering.global(static_cast<std::int64_t>(i))];
  return {};
}

template <int n>
LinearStatistics CentralDirectSolver<n>::statistics() const {
  LinearStatistics s;
  s.memory_mib = factors_.memory_mib();
  return s;
}

#define FSI_INSTANTIATE(n) template class CentralDirectSolver<n>;
FSI_FOR_EACH_DIMENSION(FSI_INSTANTIATE)

}  // namespace fsi
