// [petsc] options: they reach the solver, and what it does not know is refused by file and key.
#include <gtest/gtest.h>

#include "base/error.hpp"
#include "linear/distributed/petsc_options.hpp"
#include "linear/distributed/petsc_solver.hpp"
#include "support/linear_systems.hpp"

namespace fsi::test {

namespace {

class PetscOptionsOfACase : public ::testing::Test {
 protected:
  ~PetscOptionsOfACase() override { set_petsc_options("", ""); }

  static LinearReport solve(const std::string& options) {
    set_petsc_options(options, "tube.toml");
    PetscSolver<3> solver(linearised_box().blocks());
    solver.update();
    std::vector<double> x;
    return solver.solve(linearised_box().b(), 1e-8, x);
  }
  static std::string refusal(const std::string& options) {
    try {
      solve(options);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }
};

TEST_F(PetscOptionsOfACase, ReachTheSolver) {
  const int standard = solve("").iterations;
  const auto weaker = solve("-fsi_pressure_pc_type jacobi");
  EXPECT_TRUE(weaker.converged) << weaker.failure;
  EXPECT_GT(weaker.iterations, standard);
  const auto stronger = solve("-fsi_velocity_pc_sor_its 6 -fsi_pressure_pc_type lu");
  EXPECT_TRUE(stronger.converged);
  EXPECT_LT(stronger.iterations, standard);
  EXPECT_EQ(solve("").iterations, standard);
}

TEST_F(PetscOptionsOfACase, AnUnknownOneIsRefused) {
  const auto said = refusal("-fsi_pressure_pc_tpye jacobi");
  EXPECT_NE(said.find("tube.toml: petsc.options: \"-fsi_pressure_pc_tpye\""), std::string::npos) << said;
}

TEST_F(PetscOptionsOfACase, AWrongValueIsRefused) {
  const auto said = refusal("-fsi_ksp_type gmress");
  EXPECT_NE(said.find("tube.toml: petsc.options: "), std::string::npos) << said;
  EXPECT_NE(said.find("gmress"), std::string::npos) << said;
  EXPECT_NE(refusal("-fsi_velocity_pc_sor_its two").find("tube.toml: petsc.options: "), std::string::npos);
}

}  // namespace

}  // namespace fsi::test
