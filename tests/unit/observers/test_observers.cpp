// The tables of a run: the columns that scripts rely on.

#include "observers/observers.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "fem/elements.hpp"
#include "observers/energy_observer.hpp"
#include "support/scenes.hpp"
#include "support/temporary_folder.hpp"

namespace fsi::test {

namespace {

TEST(EnergyTable, HasTheColumnsOfThePartsOfAScene) {
  EnergyRecord energy;
  double next = 1;
  for (double* term : {&energy.fluid_kinetic, &energy.wall_kinetic, &energy.wall_isochoric, &energy.wall_volumetric,
                       &energy.inlet_work, &energy.load_work, &energy.inlet_kinetic, &energy.outlet_kinetic,
                       &energy.viscous, &energy.remainder, &energy.fluid_inertia, &energy.fluid_mesh_motion,
                       &energy.fluid_divergence, &energy.fluid_stabilisation, &energy.wall_inertia, &energy.wall_stress,
                       &energy.wall_stabilisation, &energy.fluid_quadrature, &energy.backflow})
    *term = next++;
  const auto table = [&](const EnergyParts& parts) {
    const auto columns = energy_columns(parts);
    const ResultTable written = table_of("energy.csv", columns, RowsPer::step);
    return written.header + "\n" + text_of(written, rows_of("energy.csv", {2, 0.25}, columns, {energy}));
  };
  EXPECT_EQ(table({true, true, true}),
            "step,time_ms,fluid_kinetic_energy_uJ,wall_kinetic_energy_uJ,wall_isochoric_energy_uJ,"
            "wall_volumetric_energy_uJ,inlet_work_uJ,inlet_kinetic_inflow_uJ,outlet_kinetic_outflow_uJ,"
            "viscous_dissipation_uJ,numerical_dissipation_uJ,remainder_uJ,fluid_inertia_uJ,fluid_mesh_motion_uJ,"
            "fluid_divergence_uJ,fluid_stabilisation_uJ,wall_inertia_uJ,wall_stress_uJ,wall_stabilisation_uJ\n"
            "2,0.25,1,2,3,4,5,7,8,9,116,10,11,12,13,14,15,16,17\n");
  EXPECT_EQ(table({true, false, true}),
            "step,time_ms,fluid_kinetic_energy_uJ,inlet_work_uJ,inlet_kinetic_inflow_uJ,outlet_kinetic_outflow_uJ,"
            "viscous_dissipation_uJ,numerical_dissipation_uJ,remainder_uJ,fluid_inertia_uJ,fluid_divergence_uJ,"
            "fluid_stabilisation_uJ\n"
            "2,0.25,1,5,7,8,9,116,10,11,13,14\n");
  EXPECT_EQ(table({false, true, false}),
            "step,time_ms,wall_isochoric_energy_uJ,wall_volumetric_energy_uJ,load_work_uJ,numerical_dissipation_uJ,"
            "remainder_uJ,wall_stress_uJ,wall_stabilisation_uJ\n"
            "2,0.25,3,4,6,116,10,16,17\n");
  EXPECT_EQ(table({true, false, true, true}),
            "step,time_ms,fluid_kinetic_energy_uJ,inlet_work_uJ,inlet_kinetic_inflow_uJ,outlet_kinetic_outflow_uJ,"
            "viscous_dissipation_uJ,numerical_dissipation_uJ,remainder_uJ,fluid_inertia_uJ,fluid_divergence_uJ,"
            "fluid_stabilisation_uJ,fluid_quadrature_uJ\n"
            "2,0.25,1,5,7,8,9,116,10,11,13,14,18\n");
  EXPECT_EQ(table({true, false, true, false, true}),
            "step,time_ms,fluid_kinetic_energy_uJ,inlet_work_uJ,inlet_kinetic_inflow_uJ,outlet_kinetic_outflow_uJ,"
            "viscous_dissipation_uJ,numerical_dissipation_uJ,remainder_uJ,fluid_inertia_uJ,fluid_divergence_uJ,"
            "fluid_stabilisation_uJ,backflow_dissipation_uJ\n"
            "2,0.25,1,5,7,8,9,116,10,11,13,14,19\n");
}

/// Of a partitioned method.
class CouplingStepper : public Stepper {
 public:
  StepReport advance(State& /*state*/) override { return {}; }
  bool reports_coupling() const override { return true; }
  void keep(RestartArchive& /*archive*/) override {}
};

class Silent : public Messages {
 public:
  void warn(const std::string& /*said*/) override {}
  void say(const std::string& /*said*/) override {}
  void note(const std::string& /*key*/, const nlohmann::json& /*value*/) override {}
};

class Watchers : public FolderTest {
 protected:
  Watchers() { setup_.output.energy = false; }
  Observers observers() {
    return Observers(RunView<3>{
        setup_, *scene_, loads_, stepper_, state_, 1.0, points_, derived_, grids_, shares_, folder_, {}, messages_});
  }

  Case setup_ = coupled_case("artery");
  std::unique_ptr<Scene<3>> scene_ = build_scene<P1Tetrahedron>(setup_, fluid_and_wall_box(2));
  Loads loads_{setup_};
  CouplingStepper stepper_;
  State state_ = scene_->at_rest();
  ObservationPoints points_;
  DerivedQuantities<3> derived_;
  std::vector<FieldGrid> grids_;
  std::vector<GridShare> shares_;
  Silent messages_;
};

TEST_F(Watchers, WriteTheColumnsThatScriptsRelyOn) {
  const Observers all = observers();
  ResultFolder results(folder_ / "run", all.tables(), table_files());
  StepReport report;
  report.outer_iterations = 8;
  CouplingReport& coupling = report.coupling.emplace();
  coupling.failed_passes = 1;
  coupling.columns = 12;
  coupling.displacement_residual = 5e-7;
  coupling.displacement_gap = 1e-8;
  coupling.force_residual = 2e-6;
  coupling.fluid_newton_iterations = 20;
  coupling.wall_newton_iterations = 24;
  coupling.wall_linear_iterations = 7;
  coupling.mesh_seconds = 0.5;
  coupling.pressure_residual = 3e-6;
  coupling.gap_pressure = 0.25;
  coupling.traction_gap = 0.125;
  coupling.domain_gap = 0.0625;
  all.after_step({{3, 0.375, 8, 44, 7, 0.75, 0.002}, report, state_}, results);
  EXPECT_EQ(contents_of(results.path() / "iterations.csv"),
            "step,time_ms,outer_iterations,newton_iterations,linear_iterations,wall_s,solver_error\n"
            "3,0.375,8,44,7,0.75,0.002\n");
  EXPECT_EQ(contents_of(results.path() / "coupling.csv"),
            "step,time_ms,iterations,failed_passes,relaxation,columns,displacement_residual,displacement_residual_mm,"
            "force_residual,fluid_newton_iterations,wall_newton_iterations,fluid_linear_iterations,"
            "wall_linear_iterations,fluid_s,wall_s,mesh_motion_s,coupling_s,pressure_residual,gap_kPa,traction_gap_kPa,"
            "domain_gap_mm\n"
            "3,0.375,8,1,0,12,5e-07,1e-08,2e-06,20,24,0,7,0,0,0.5,0,3e-06,0.25,0.125,0.0625\n");
  EXPECT_EQ(contents_of(results.path() / "flow.csv"),
            "time_ms,inlet_flow_mm3_per_ms,outlet_flow_mm3_per_ms,inlet_pressure_Pa,outlet_pressure_Pa\n");
}

TEST_F(Watchers, FillNoTableThatIsNotKnown) {
  points_.centre_line.resize(1);
  points_.wall_line.resize(1);
  const auto known = table_files();
  const Observers all = observers();
  for (const ResultTable& table : all.tables())
    EXPECT_NE(std::find(known.begin(), known.end(), table.file), known.end()) << table.file;
}

}  // namespace

}  // namespace fsi::test
