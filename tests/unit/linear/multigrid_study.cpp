// Prints convergence factors of the stand-alone sub-problem multigrids on the artery:
//   multigrid_study [MESH_LEVEL [MATERIAL]]
#include <cstdio>
#include <string>

#include "host/threads.hpp"
#include "monolithic/coupled_solvers/amg/sub_problem_options.hpp"
#include "monolithic/study/sub_problem_study.hpp"
#include "unit/linear/artery_matrices.hpp"

namespace {

void print(const char* problem, const std::vector<fsi::MultigridStudyRow>& rows) {
  for (const auto& row : rows)
    std::printf("%-6s %-12s %-15s %s(%d,%d) %d levels  factor %.3f  iterations %2d%s  complexity %.2f  %.2f ms/cycle\n",
                problem, row.coarsening.c_str(), row.smoother.c_str(), row.cycle.c_str(), row.pre_smoothing,
                row.post_smoothing, row.result.levels, row.result.convergence_factor, row.result.iterations,
                row.result.converged ? "" : " (not converged)", row.result.operator_complexity,
                1e3 * row.result.seconds_per_cycle);
}

}  // namespace

int main(int count, char** words) {
  using namespace fsi;
  set_threads(1);
  const test::ArteryMatrices artery(artery_level(count > 1 ? words[1] : "coarse"),
                                    count > 2 ? words[2] : "neo-hookean");
  print("mesh", study_elliptic_multigrid<3>(artery.mesh, artery.mesh_marks, mesh_amg_options()));
  print("fluid", study_saddle_multigrid(artery.fluid, artery.fluid_marks, fluid_amg_options()));
  for (const char* smoother : {"braess-sarazin", "vanka"}) {
    MultigridStudyRange range;
    range.smoothers = {smoother};
    print("wall", study_saddle_multigrid(artery.wall, artery.wall_marks,
                                         wall_amg_options(saddle_smoother_kinds().at(smoother)), range));
  }
}
