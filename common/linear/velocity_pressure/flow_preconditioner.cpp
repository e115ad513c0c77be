#include "linear/velocity_pressure/flow_preconditioner.hpp"

#include "base/name_table.hpp"
#include "case/preconditioner_list.hpp"
#include "fem/dimensions.hpp"

namespace fsi {

// NOLINTBEGIN(bugprone-macro-parentheses)
#define FSI_ROW(name, make) \
  template <int n>          \
  std::unique_ptr<FlowPreconditioner<n>> make(const VelocityPressureMatrix<n>& matrix);
FSI_FLOW_PRECONDITIONERS(FSI_ROW)
#undef FSI_ROW

template <int n>
std::unique_ptr<FlowPreconditioner<n>> make_flow_preconditioner(const std::string& name,
                                                                const VelocityPressureMatrix<n>& matrix) {
  using Make = std::unique_ptr<FlowPreconditioner<n>> (*)(const VelocityPressureMatrix<n>&);
#define FSI_ROW(name, make) {name, make<n>},
  static const NameTable<Make> table("linear.preconditioner", {FSI_FLOW_PRECONDITIONERS(FSI_ROW)});
#undef FSI_ROW
  return table.at(name)(matrix);
}

#define FSI_INSTANTIATE(n)                                                                     \
  template std::unique_ptr<FlowPreconditioner<n>> make_flow_preconditioner(const std::string&, \
                                                                           const VelocityPressureMatrix<n>&);
FSI_FOR_EACH_DIMENSION(FSI_INSTANTIATE)
#undef FSI_INSTANTIATE
// NOLINTEND(bugprone-macro-parentheses)

}  // namespace fsi
