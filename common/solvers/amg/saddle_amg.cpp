#include "solvers/amg/saddle_amg.hpp"

#include "base/error.hpp"

namespace fsi {

SaddleSmootherKind saddle_smoother_kind(const std::string& name) {
  if (name == "braess-sarazin") return SaddleSmootherKind::braess_sarazin;
  if (name == "vanka") return SaddleSmootherKind::vanka;
  throw InputError("", "smoother", "unknown smoother \"" + name + "\"", "use braess-sarazin or vanka");
}

double stabilisation_factor(const NodeTransfer& t, double growth) {
  return std::pow(static_cast<double>(t.fine_nodes()) / t.coarse_nodes, growth);
}

}  // namespace fsi
