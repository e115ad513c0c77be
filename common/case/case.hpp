#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "mesh/simplex_mesh.hpp"

namespace fsi {

/// Pressure over time. Between table points linear; before the first point its value, after the last point its value.
struct PressureTable {
  std::vector<std::pair<double, double>> points;  ///< (ms, kPa), times not decreasing; equal times make a jump

  /// Mean pressure over [from, to] in kPa: the load of a step, so that the impulse does not depend on the time step.
  double mean(double from, double to) const;
  double at_end() const { return points.empty() ? 0.0 : points.back().second; }
};

/// [mesh]: `file`, or `level` made on demand beside the case file.
struct MeshData {
  std::filesystem::path file;  ///< absolute, or relative to the working directory once read
  std::string level;           ///< "coarse", "intermediate", "fine", or empty
};

/// [fluid]
struct FluidData {
  double density = 0;     ///< mg/mm^3
  double viscosity = 0;   ///< kPa ms
  bool grad_div = false;  ///< grad-div stabilisation; damps the wave on coarse meshes (docs/theory.md, section 3.3)
};

/// [structure.layers.NAME]
struct MaterialData {
  std::string material;    ///< "neo-hookean", "mooney-rivlin" or "artery"
  double c10 = 0;          ///< kPa
  double c01 = 0;          ///< kPa, mooney-rivlin
  double k1 = 0;           ///< kPa, artery
  double k2 = 0;           ///< -, artery
  double alpha = 0;        ///< degrees between fibre and circumference, artery
  double fibre_scale = 1;  ///< 0.5 gives the paper's printed fibre stress (docs/theory.md, section 12)
};

/// [structure]
struct StructureData {
  double density = 0;             ///< mg/mm^3
  double bulk_modulus = 0;        ///< kPa
  double stabilisation = 0.5;     ///< alpha in tau = alpha h^2 / (2 mu)
  Point axis_origin{0, 0, 0};     ///< mm; a point on the axis of the fibres' cylindrical frame
  Point axis_direction{0, 0, 1};  ///< need not be normalised
  std::map<std::string, MaterialData> layers;
};

/// [time]; absent in a static case
struct TimeData {
  double step = 0;  ///< ms
  double end = 0;   ///< ms
  double newmark_beta = 1;
  double newmark_gamma = 1;
  std::optional<int> predictor;  ///< order of the extrapolated start of each step: 0, 1 or 2; empty: the driver chooses

  int steps() const;  ///< number of steps; `end` is hit exactly
};

/// [static]: a wall without inertia, the load raised in equal steps
struct StaticData {
  int load_steps = 10;
};

/// [monolithic.multigrid]: multigrid of the sub-problems and, under names with amg and amli, of the coupled system
struct MultigridData {
  std::string cycle = "w";   ///< coupled amg: "v", "w" or "k"; amli has its own
  int pre_smoothing = 5;     ///< steps of the coupled smoother before the coarse correction,
  int post_smoothing = 5;    ///< and after
  double damping = 0;        ///< of the coupled smoother; 0: from the estimated largest eigenvalue, level by level
  int levels = 10;           ///< at most
  int coarsest_nodes = 400;  ///< fluid and wall nodes; levels of at most so many are solved directly
  std::string coarsening = "colouring";           ///< or "aggregation"
  std::string fluid_smoother = "braess-sarazin";  ///< or "vanka"
  std::string wall_smoother = "braess-sarazin";   ///< or "vanka"
  std::string sub_cycle = "w";                    ///< of the sub-problems: "v" or "w"
  int sub_smoothing = 2;                          ///< smoothing steps of the sub-problems, before and after
};

/// [monolithic]
struct MonolithicData {
  std::string linear_solver = "fast";
  double linear_tolerance = 0;      ///< residual of each linear solve, relative; 0: what Newton's convergence needs
  int max_linear_iterations = 500;  ///< of each linear solve
  int direct_below = 2000;          ///< unknowns below which `fast` factorises
  int krylov_restart = 250;         ///< directions that GMRES and FGMRES keep
  MultigridData multigrid;
  std::string mode = "kept";  ///< "kept": factors serve while the residual keeps falling; "full": one each iteration
  double newton_tolerance = 1e-8;  ///< increment relative to the first one of the step
  double residual_tolerance = 0;   ///< optional further demand: residual relative to the first of the step; 0: none
  int max_iterations = 30;
};

/// [partitioned]
struct PartitionedData {
  std::string scheme = "robin-neumann-iqn";
  double tolerance = 1e-6;            ///< ||d~ - d|| <= tolerance ||d~|| on the interface
  double absolute_tolerance = 1e-13;  ///< or ||d~ - d|| <= this, mm: no motion, nothing to resolve
  double force_tolerance = 0;         ///< further demand: force residual relative to the interface force; 0: none
  double velocity_gap = 0.5;          ///< `explicit`: that fluid and wall may keep, relative to the largest velocity
  double relaxation = 0;              ///< constant factor, or the first of the scheme; 0 lets the scheme choose
  int max_iterations = 200;
  int reused_steps = 10;               ///< earlier time steps whose differences iqn-ils keeps
  int columns = 200;                   ///< differences that a quasi-Newton scheme keeps at most
  double filter = 1e-2;                ///< a difference is dropped when less than this part of it is new
  std::string linear_solver = "fast";  ///< of the sub-problems: "fast" or "direct"
  int direct_below = 2000;             ///< unknowns of a sub-problem below which `fast` factorises
};

/// [output]
struct OutputData {
  std::vector<std::string> fields{"displacement", "velocity", "pressure"};
  int every = 8;             ///< steps between entries of fields.h5; 0: no fields
  int checkpoint_every = 1;  ///< steps between checkpoints; 0: none
  bool energy = true;        ///< energy.csv
};

/// [economy]: savings switched off to see what they are worth. The answers stay the same.
struct EconomyData {
  std::string constant_operators = "kept";  ///< "rebuilt": the mesh motion's is assembled and set up at each use
};

/// Names that monolithic.linear_solver can have.
const std::vector<std::string>& linear_solver_names();
/// Names that partitioned.scheme can have.
const std::vector<std::string>& coupling_scheme_names();

/// A whole scene as the case file states it. Sections that a scene does not need are absent.
struct Case {
  std::filesystem::path path;  ///< of the case file
  std::string title;
  std::string element = "p1";
  MeshData mesh;
  std::optional<FluidData> fluid;
  std::optional<StructureData> structure;
  std::optional<PressureTable> inlet;  ///< [inlet]: pressure on the fluid's inlet
  std::optional<PressureTable> load;   ///< [load]: pressure on the inner face of a wall without fluid
  std::optional<TimeData> time;
  std::optional<StaticData> static_load;
  MonolithicData monolithic;
  PartitionedData partitioned;
  OutputData output;
  EconomyData economy;
};

}  // namespace fsi
