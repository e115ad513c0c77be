#include "case/multigrid_kinds.hpp"

namespace fsi {

const NameTable<CoarseningKind>& coarsening_kinds() {
  static const NameTable<CoarseningKind> table{
      "coarsening", {{"colouring", CoarseningKind::colouring}, {"aggregation", CoarseningKind::aggregation}}};
  return table;
}

const NameTable<CycleKind>& cycle_kinds() {
  static const NameTable<CycleKind> table{"cycle", {{"v", CycleKind::v}, {"w", CycleKind::w}, {"k", CycleKind::k}}};
  return table;
}

const NameTable<CycleKind>& linear_cycle_kinds() {
  static const NameTable<CycleKind> table{"cycle", {{"v", CycleKind::v}, {"w", CycleKind::w}}};
  return table;
}

const NameTable<SaddleSmootherKind>& saddle_smoother_kinds() {
  static const NameTable<SaddleSmootherKind> table{
      "smoother", {{"braess-sarazin", SaddleSmootherKind::braess_sarazin}, {"vanka", SaddleSmootherKind::vanka}}};
  return table;
}

}  // namespace fsi
