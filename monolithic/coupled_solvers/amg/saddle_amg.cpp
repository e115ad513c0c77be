#include "monolithic/coupled_solvers/amg/saddle_amg.hpp"

namespace fsi {

double stabilisation_factor(const NodeTransfer& t, double growth) {
  return std::pow(static_cast<double>(t.fine_nodes()) / t.coarse_nodes, growth);
}

}  // namespace fsi
