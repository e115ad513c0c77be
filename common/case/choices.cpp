#include "case/choices.hpp"

#include <iterator>

#include "case/coupled_multigrid_options.hpp"

namespace fsi {

namespace {

template <class List>
std::vector<std::string> strings(const List& list) {
  return {list.begin(), list.end()};
}

}  // namespace

std::vector<std::string> general_solver_names() {
  return strings(general_solver_list);
}

std::vector<std::string> flow_preconditioner_names() {
  return {std::begin(flow_preconditioner_list), std::end(flow_preconditioner_list)};
}

std::vector<std::string> linear_solver_names() {
  auto names = general_solver_names();
  for (const auto name : coupled_solver_list) names.emplace_back(name);
  return names;
}

std::vector<std::string> coupling_scheme_names() {
  return strings(coupling_scheme_list);
}

std::vector<std::string> output_field_names() {
  return strings(output_field_list);
}

std::vector<std::string> standard_output_fields() {
  auto names = output_field_names();
  names.resize(standard_fields);
  return names;
}

const NameTable<ElementPair>& element_pairs() {
  static const NameTable<ElementPair> table{"element", {{"p1", ElementPair::p1}, {"p2p1", ElementPair::p2p1}}};
  return table;
}

const NameTable<StartOfOpenings>& starts_of_openings() {
  static const NameTable<StartOfOpenings> table{
      "time.start", {{"given", StartOfOpenings::given}, {"lumped", StartOfOpenings::lumped}}};
  return table;
}

const NameTable<Geometry>& geometries() {
  static const NameTable<Geometry> table{
      "geometry",
      {{"3d", Geometry::three_dimensional}, {"axisymmetric", Geometry::axisymmetric}, {"plane", Geometry::plane}}};
  return table;
}

const NameTable<InflowProfile>& inflow_profiles() {
  static const NameTable<InflowProfile> table("profile", {{"plug", InflowProfile::plug},
                                                          {"parabolic", InflowProfile::parabolic},
                                                          {"biparabolic", InflowProfile::biparabolic},
                                                          {"womersley", InflowProfile::womersley}});
  return table;
}

const NameTable<ToleranceOf>& tolerance_kinds() {
  static const NameTable<ToleranceOf> table{
      "partitioned.tolerance_of", {{"pressure", ToleranceOf::pressure}, {"displacement", ToleranceOf::displacement}}};
  return table;
}

const NameTable<FibreFrame>& fibre_frames() {
  static const NameTable<FibreFrame> table{"structure.fibre_frame",
                                           {{"cylinder", FibreFrame::cylinder}, {"laplace", FibreFrame::laplace}}};
  return table;
}

const NameTable<MeshMotionMethod>& mesh_motion_methods() {
  static const NameTable<MeshMotionMethod> table{"mesh_motion.method",
                                                 {{"harmonic", MeshMotionMethod::harmonic},
                                                  {"stiffened", MeshMotionMethod::stiffened},
                                                  {"nonlinear-elastic", MeshMotionMethod::nonlinear_elastic}}};
  return table;
}

const NameTable<LayerPressure>& layer_pressures() {
  static const NameTable<LayerPressure> table{
      "structure.layer_pressure", {{"continuous", LayerPressure::continuous}, {"separate", LayerPressure::separate}}};
  return table;
}

const NameTable<Stabilisation>& stabilisation_kinds() {
  static const NameTable<Stabilisation> table{
      "stabilisation", {{"projected", Stabilisation::projected}, {"paper", Stabilisation::paper}}};
  return table;
}

const NameTable<bool>& constant_operator_modes() {
  static const NameTable<bool> table{"economy.constant_operators", {{"kept", true}, {"rebuilt", false}}};
  return table;
}

const NameTable<CoupledCycleKind>& coupled_cycle_kinds() {
  static const NameTable<CoupledCycleKind> table{
      "cycle of the coupled amg", {{"v", CoupledCycleKind::v}, {"w", CoupledCycleKind::w}, {"k", CoupledCycleKind::k}}};
  return table;
}

}  // namespace fsi
