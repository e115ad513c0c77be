#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "case/choices.hpp"
#include "case/coupled_multigrid_options.hpp"
#include "case/derived_output.hpp"
#include "case/fast_options.hpp"
#include "case/opening_conditions.hpp"
#include "case/pressure_table.hpp"
#include "case/quasi_newton_options.hpp"
#include "case/sample_requests.hpp"
#include "fields/field_samples.hpp"
#include "fields/region_shape.hpp"
#include "linear/krylov/krylov.hpp"
#include "materials/maxwell_branch.hpp"
#include "materials/parameter.hpp"
#include "mesh/simplex_mesh.hpp"
#include "mesh_motion/mesh_motion_options.hpp"
#include "mesher/artery/recommended_meshes.hpp"
#include "nonlinear/newton.hpp"

namespace fsi {

struct NetworkData;  // case/network_data.hpp

/// [support.SURFACE]: what holds a surface of the wall from outside, and loads it (docs/theory.md, section 4.5).
struct SupportData {
  double spring = 0, normal_spring = 0;   ///< kPa/mm, of the displacement and of its part along the normal at rest
  double damper = 0, normal_damper = 0;   ///< kPa ms/mm, of the velocity likewise
  std::optional<PressureTable> pressure;  ///< kPa, from outside, follows the surface
  std::vector<PressureTable> traction;    ///< kPa per area at rest, a table per direction of the scene; empty: none
  std::optional<std::vector<std::string>> fixed;  ///< components that do not move: "x", "y", "z", "r" or "normal"

  bool holds() const { return spring > 0 || normal_spring > 0 || (fixed && !fixed->empty()); }
};

/// [prestress]: the load that the wall carries in the shape of its mesh (docs/theory.md, section 4.6).
struct PrestressData {
  double pressure = 0;         ///< kPa, on the inner face
  std::filesystem::path file;  ///< of an earlier run, read in place of finding it again; empty: none
};

/// [mesh]: `file`, or an artery mesh made on demand by `level` or `error`.
struct MeshData {
  std::filesystem::path file;  ///< absolute, or relative to the working directory once read
  std::string level;           ///< "coarse", "intermediate", "fine", or empty
  double error = 0;  ///< percent that the artery mesh made on demand may leave in the wave; 0: none is asked for
  Waves waves = Waves::damped;  ///< for which `error` holds; read_case() chooses it where the file does not
};

/// fluid.viscosity_model: a law that the viscosity follows
struct ViscosityData {
  std::string name;        ///< a name of viscosity_laws()
  ParameterValues values;  ///< its parameters
};

/// [fluid]
struct FluidData {
  double density = 0;     ///< mg/mm^3
  double viscosity = 0;   ///< kPa ms; with a model the one that stands for it (docs/theory.md, section 3.9)
  bool outlet = true;     ///< whether a surface `outlet` is open, free of traction unless [[opening]] names it
  bool grad_div = false;  ///< grad-div stabilisation; damps the wave on coarse meshes (docs/theory.md, section 3.3)
  /// Named surfaces that are no openings. Where it is given, even empty, a case may be without openings.
  std::optional<std::vector<std::string>> closed{};
  std::optional<ViscosityData> viscosity_model{};  ///< empty: the viscosity is constant
};

/// A constant of a layer that varies in space, given by a file.
struct ConstantField {
  std::filesystem::path file;
  std::string field;                            ///< its name there
  double within = 0;                            ///< mm, as PointField takes it
  std::shared_ptr<const FieldSamples> samples;  ///< read, checked, in mm and the constant's unit
  std::string hash;                             ///< of the samples
  std::string key{};                            ///< of the case, for messages; empty: that of the layer's constant
};

/// Constants into which those of a layer change over in a region.
struct ConstantBlend {
  std::size_t region;                             ///< of StructureData::regions
  ParameterValues values;                         ///< by the constant's key, `viscosity` among them
  std::map<std::string, ConstantField> fields{};  ///< of those that vary there; `values` then hold stand_in() of them
};

/// [structure.layers.NAME]
struct MaterialData {
  static constexpr const char* viscosity_key = "viscosity";  ///< among the names of constants

  std::string material;                  ///< a name of materials()
  ParameterValues values;                ///< its parameters, for make_material()
  double viscosity = 0;                  ///< eta of a layer that resists the rate of its strain, kPa ms; 0: elastic
  std::vector<MaxwellBranch> maxwell{};  ///< springs and dashpots in series, parallel to the material; may be empty
  /// Constants that vary, by key; `values` and `viscosity` then hold stand_in() of them until the scene is built.
  std::map<std::string, ConstantField> fields{};
  std::vector<ConstantBlend> blends{};  ///< applied in this order
  /// The layer that a region has cut this part out of, and the region's index; empty: a volume of the mesh.
  std::string part_of{};
  std::size_t region = 0;

  bool varies() const { return !fields.empty() || !blends.empty(); }
};

/// [[structure.region]]: a part of the wall that has constants of its own (docs/theory.md, section 4.8).
struct RegionData {
  std::string name;
  std::vector<std::string> layers;  ///< that it is in
  RegionShape shape;
  double transition = 0;  ///< mm, width in which constants change over; 0: whole elements
  std::string hash;       ///< of its file's contents; empty: it has no file
  ParameterValues values;
  std::map<std::string, ConstantField> fields{};  ///< of those that vary there; `values` then hold stand_in() of them
  std::string material;                           ///< in place of the layers'; empty: theirs
};

/// [structure]
struct StructureData {
  double density = 0;                   ///< mg/mm^3
  double bulk_modulus = 0;              ///< kPa, of layers whose material has none of its own
  std::optional<double> stabilisation;  ///< alpha of the wall's tau (docs/theory.md, section 4.2); empty: standard
  LayerPressure layer_pressure = LayerPressure::separate;
  std::optional<FibreFrame> fibre_frame{};  ///< empty: by the wall's shape (scene/fibre_frame.hpp)
  /// det F of nearly incompressible layers that is no solution: below 1/f or above f (docs/theory.md, section 4.9).
  double volume_factor = 3;
  Point gravity{0, 0, 0};                      ///< mm/ms^2, acceleration of all its mass, a load that does not change
  Point axis_origin{0, 0, 0};                  ///< mm; a point on the axis of the fibres' cylindrical frame
  Point axis_direction{0, 0, 1};               ///< need not be normalised
  bool axis_is_named = false;                  ///< whether the case gives one of these two
  std::map<std::string, MaterialData> layers;  ///< with the parts that regions cut out of them, NAME/REGION
  std::vector<RegionData> regions{};           ///< in their order
};

/// [time]; absent in a static case
struct TimeData {
  static constexpr int most_steps = 1'000'000;  ///< each output time and each end of a period ends one

  double step = 0;               ///< ms; 0: adaptive
  double end = 0;                ///< ms
  std::optional<int> predictor;  ///< order of the extrapolated start of each step: 0, 1 or 2; empty: the driver chooses
  /// A name of time_schemes(); empty: from the scene and the step (scene/time_scheme.hpp).
  std::optional<std::string> scheme{};
  std::map<std::string, double> scheme_values{};  ///< the scheme's parameters, as far as they are given
  bool adaptive = false;                          ///< steps by an estimate of their error
  double tolerance = 0.01;                        ///< of adaptive steps, relative to the solution
  std::optional<double> first_step{}, smallest_step{}, largest_step{};  ///< ms, of adaptive ones; empty: from the scene
  /// The run ends when the change from one period to the next, over the range within a period, is at most this; empty:
  /// at `end`.
  std::optional<double> periodic_change{};
  std::optional<double> period{};                  ///< ms, of these and of the lumped start
  StartOfOpenings start = StartOfOpenings::given;  ///< what Windkessels begin with
  int retries = 4;  ///< times that a step which found no solution is halved before the run gives up

  int steps() const;  ///< number of fixed steps, without those that jumps and output times add
};

/// [static]: a wall without inertia, the load raised in equal steps
struct StaticData {
  int load_steps = 10;
  int retries = 6;         ///< times that a load step which found no solution is halved before the run gives up
  bool check_path = true;  ///< long load steps are taken once more in two halves, which must lead to the same state
};

/// [monolithic.multigrid]: multigrid of the sub-problems and, under names with amg and amli, of the coupled system
struct MultigridData {
  CoupledCoarseningOptions coarsening;
  CoupledSmoothingOptions smoothing;
  CoupledCycleOptions cycle;  ///< of the coupled amg; amli has its own kind
  SubProblemCycleOptions sub_problems;
};

/// Defaults of [newton].
struct NewtonStandards {
  /// error_tolerance in runs of fixed steps that give neither it nor tolerance: adds at most a tenth of the
  /// discretisation's error (docs/evidence/evidence.md).
  static constexpr double error_tolerance = 3e-3;
  static constexpr double error_tolerance_of_wall = 3e-4;  ///< the same for a wall without fluid
  /// In all other runs.
  static NewtonOptions options() {
    NewtonOptions options;
    options.tolerance = 1e-3;
    return options;
  }
};

/// [linear]; its tolerance is NewtonOptions::linear_tolerance
struct LinearData {
  FastOptions fast;      ///< of the whole system, or of the sub-problems
  KrylovOptions krylov;  ///< of the coupled solvers; their tolerance comes with each solve
};

/// [monolithic]
struct MonolithicData {
  std::string linear_solver = "fast";  ///< one of linear_solver_names()
  MultigridData multigrid;
};

/// [partitioned]
struct PartitionedData {
  std::optional<std::string> scheme;  ///< one of coupling_scheme_names(); empty: by the scene
  /// ||d~ - d|| <= tolerance ||d~|| on the interface (docs/coupling.md); with robin-neumann-inexact and block-newton
  /// the largest error of a step, in place of what [newton] demands; empty: gap_tolerance(), or what [newton] demands
  std::optional<double> tolerance;
  static constexpr double standard_tolerance = 1e-6;  ///< of the gap ||d~ - d||
  ToleranceOf tolerance_of = ToleranceOf::pressure;   ///< pressure: also for the pressure that would close the gap
  double absolute_tolerance = 0;                      ///< or ||d~ - d|| <= this, mm; 0: not used
  double force_tolerance = 0;  ///< further demand: force residual relative to the interface force; 0: none
  double velocity_gap = 0.5;   ///< `explicit`: largest gap of fluid and wall velocity, relative to the largest velocity
  std::optional<double> robin_coefficient;  ///< of schemes robin-robin..., kPa/(mm/ms); empty: from the scene
  std::optional<double> relaxation;         ///< constant factor, or the first of the scheme; empty: the scheme chooses
  int max_iterations = 200;
  QuasiNewtonOptions quasi_newton;     ///< but for relaxation and mixing, which the scheme chooses
  std::string linear_solver = "fast";  ///< of the sub-problems, one of general_solver_names()
  FastOptions fast;  ///< LinearData::fast, copied by the reader: solvers of a sub-problem see this section alone

  double gap_tolerance() const { return tolerance.value_or(standard_tolerance); }
};

/// [petsc]: the linear solver `petsc`
struct PetscData {
  std::string options;  ///< as on PETSc's command line; all begin with -fsi_
};

/// [output]
struct OutputData {
  std::vector<std::string> fields = standard_output_fields();
  int every = 8;                          ///< steps between entries of fields.h5; 0: no fields
  std::optional<double> interval{};       ///< ms between entries of fields.h5, in place of `every`; steps end there
  std::vector<double> times{};            ///< ms, ascending: further times at which steps end and fields.h5 has entries
  std::optional<int> checkpoint_every{};  ///< steps between checkpoints; 0: none; empty: by time
  std::optional<double>
      checkpoint_seconds{};  ///< s, age of the last checkpoint at which one is written; empty: by cost
  bool energy = true;        ///< energy.csv
  DerivedOutput derived{};
  SampleRequests samples;  ///< [output.points], [output.lines.NAME], [output.planes.NAME]
};

/// [economy]: savings that can be switched off to measure them. Results stay the same.
struct EconomyData {
  bool keep_constant_operators = true;  ///< false: the mesh motion's is assembled and set up at each use
};

/// A whole scene as the case file states it. Sections that a scene does not need are absent.
struct Case {
  std::filesystem::path path;  ///< of the case file
  std::string title;
  ElementPair element = ElementPair::p2p1;  ///< at equal seconds the more accurate one: docs/evidence/evidence.md
  Geometry geometry = Geometry::three_dimensional;
  Stabilisation stabilisation = Stabilisation::projected;
  MeshData mesh;
  std::optional<FluidData> fluid;
  std::optional<StructureData> structure;
  std::optional<PressureTable> inlet;                   ///< [inlet]: pressure on the fluid's inlet
  std::optional<PressureTable> load;                    ///< [load]: pressure on the inner face of a wall without fluid
  std::map<std::string, OpeningConditions> openings{};  ///< [[opening]], by surface
  std::shared_ptr<const NetworkData> network{};         ///< [network] behind openings; null: there is none
  std::map<std::string, SupportData> supports;          ///< [support.SURFACE] by surface group
  std::optional<PrestressData> prestress;
  std::optional<TimeData> time;
  std::optional<StaticData> static_load;
  MeshMotionOptions mesh_motion;                      ///< [mesh_motion], of scenes with fluid and wall
  NewtonOptions newton = NewtonStandards::options();  ///< [newton], of both drivers
  LinearData linear;                                  ///< [linear], likewise
  MonolithicData monolithic;
  PartitionedData partitioned;
  PetscData petsc{};
  OutputData output;
  EconomyData economy;
  std::vector<std::string> warnings;  ///< what the reader found strange but did not refuse, one line each
  std::vector<std::string> remarks;   ///< what else it did, such as conversions of units, for the log
};

/// alpha of the stabilisation of a case's wall: as given, or the standard of its kind (docs/theory.md, section 4.2).
double wall_stabilisation(const Case& setup);

/// Times of entries of fields.h5 besides the regular ones, ms, ascending: output.times, and the ends of periods where one
/// of them ends the run.
std::vector<double> further_output_times(const Case& setup);

/// Times of entries of fields.h5 at which steps end, ms, ascending: multiples of output.interval from 0 on,
/// further_output_times() and the end. With adaptive steps the default interval is a twelfth of the run. Empty where
/// entries are counted in steps, and in statics.
std::vector<double> output_times(const Case& setup);

}  // namespace fsi
