#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "base/error.hpp"
#include "base/names.hpp"
#include "case/case_reader.hpp"
#include "example_cases.hpp"
#include "materials/material.hpp"
#include "time/time_schemes.hpp"

namespace fsi::test {

namespace {

struct BadCase {
  const char* name;
  const std::string& valid;
  const char* from;     ///< this text of the valid case ...
  const char* to;       ///< ... is replaced by that one
  std::string message;  ///< expected, in full
  std::vector<std::string> overrides = {};
};

void PrintTo(const BadCase& bad, std::ostream* stream) {
  *stream << bad.name;
}
std::string name_of(const testing::TestParamInfo<BadCase>& info) {
  return info.param.name;
}

/// What the reader says; empty when it accepts the case.
std::string complaint_about(const BadCase& bad) {
  try {
    parse_case(with(bad.valid, bad.from, bad.to), "case.toml", bad.overrides);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

/// Only the beginning is ours; the rest comes from the TOML library.
const std::vector<BadCase>& syntax_errors() {
  static const std::vector<BadCase> cases = {
      {"UnclosedString", coupled_case, "\"coarse\"", "\"coarse", "case.toml:4: no valid TOML: "},
      {"ValueMissing", coupled_case, "density = 1.0", "density =", "case.toml:6: no valid TOML: "},
      {"KeyTwice", coupled_case, "viscosity = 3.5e-3", "density = 3.5e-3", "case.toml:7: no valid TOML: "},
      {"SectionTwice", coupled_case, "[partitioned]", "[monolithic]", "case.toml:30: no valid TOML: "},
      {"SectionUnclosed", coupled_case, "[fluid]", "[fluid", "case.toml:5: no valid TOML: "},
      {"NotUtf8", coupled_case, "a coupled",
       "a c\xff"
       "oupled",
       "case.toml:1: no valid TOML: "},
  };
  return cases;
}

const std::vector<BadCase>& bad_cases() {
  static const std::vector<BadCase> cases = {
      // Names of keys and sections
      {"UnknownSection", coupled_case, "[fluid]", "[fluids]",
       "case.toml:5: fluids: unknown section; did you mean fluid?"},
      {"UnknownSubsection", coupled_case, "[monolithic]", "[monolithic.solver]",
       "case.toml:27: monolithic.solver: unknown section; there are linear_solver or multigrid"},
      {"UnknownKey", coupled_case, "viscosity", "viscocity",
       "case.toml:7: fluid.viscocity: unknown key; did you mean fluid.viscosity?"},
      {"UnknownKeyAtTop", coupled_case, "element", "elements",
       "case.toml:2: elements: unknown key; did you mean element?"},
      {"UnknownKeyOfLayer", coupled_case, "alpha", "alfa",
       "case.toml:16: structure.layers.media.alfa: unknown key; did you mean structure.layers.media.alpha?"},
      {"MaterialKeyMisspelt", coupled_case, "material = \"artery\"", "meterial = \"artery\"",
       "case.toml:12: structure.layers.media.meterial: unknown key; did you mean structure.layers.media.material?"},
      {"KeyNothingIsLike", coupled_case, "until = 0.125", "end = 0.125",
       "case.toml:23: inlet.end: unknown key; there are pressure or until"},
      {"UnknownKeyOfTwoLetters", coupled_case, "viscosity = 3.5e-3", "mu = 3.5e-3",
       "case.toml:7: fluid.mu: unknown key; there are density, viscosity, viscosity_model, outlet, closed or grad_div"},
      {"FirstOfTwoUnknownKeys", coupled_case, "viscosity = 3.5e-3", "zeta = 1\nalpha = 2",
       "case.toml:7: fluid.zeta: unknown key; there are density, viscosity, viscosity_model, outlet, closed or "
       "grad_div"},
      {"ParameterOfAnotherMaterial", static_case, "c10 = 3", "c10 = 3\nk1 = 2",
       "case.toml:10: structure.layers.wall.k1: is no parameter of neo-hookean but of artery; remove it (neo-hookean "
       "takes c10, young or poisson)"},
      {"BulkModulusMissing", static_case, "bulk_modulus = 1e5\n", "",
       "case.toml:4: structure.bulk_modulus: missing; add it (bulk modulus in kPa)"},
      {"BulkModulusOfNoLayer", static_case, "c10 = 3", "young = 9\npoisson = 0.49",
       "case.toml:6: structure.bulk_modulus: belongs to no layer: each has a bulk modulus of its own by its elastic "
       "constants; remove it"},
      {"ConstantsMissing", static_case, "c10 = 3", "",
       "case.toml:7: structure.layers.wall: has too few constants; give c10, or young and poisson"},
      {"ConstantsHalf", static_case, "\"neo-hookean\"\nc10 = 3", "\"linear-elastic\"\nyoung = 3",
       "case.toml:7: structure.layers.wall: young alone is no set of its constants; give young and poisson, "
       "or "
       "lame_lambda and lame_mu"},
      {"ConstantsOfTwoPairs", static_case, "\"neo-hookean\"\nc10 = 3",
       "\"saint-venant-kirchhoff\"\nyoung = 3\npoisson = 0.3\nlame_mu = 1",
       "case.toml:7: structure.layers.wall: young, poisson and lame_mu together are no set of its constants; "
       "give "
       "young and poisson, or lame_lambda and lame_mu"},
      {"PoissonIncompressible", static_case, "\"neo-hookean\"\nc10 = 3", "\"linear-elastic\"\nyoung = 3\npoisson = 0.5",
       "case.toml:10: structure.layers.wall.poisson: 0.5 is out of range; give a number > -1 and < 0.5 (Poisson's "
       "ratio)"},
      {"PoissonMinusOne", static_case, "\"neo-hookean\"\nc10 = 3", "\"linear-elastic\"\nyoung = 3\npoisson = -1",
       "case.toml:10: structure.layers.wall.poisson: -1 is out of range; give a number > -1 and < 0.5 (Poisson's "
       "ratio)"},
      {"CompressionNotResisted", static_case, "\"neo-hookean\"\nc10 = 3",
       "\"compressible-neo-hookean\"\nlame_lambda = -3\nlame_mu = 3",
       "case.toml:7: structure.layers.wall: lame_lambda + 2/3 lame_mu, the bulk modulus, is not positive; give a "
       "lame_lambda of more than -2/3 lame_mu"},
      {"DispersionTooLarge", coupled_case, "alpha = 29.0", "alpha = 29.0\nkappa = 0.34",
       "case.toml:17: structure.layers.media.kappa: 0.34 is out of range; give a number >= 0 and <= 0.3333333333333333 "
       "(dispersion of the fibres about their directions, at most 1/3, default 0)"},
      {"FibreFrameUnknown", static_case, "bulk_modulus = 1e5", "bulk_modulus = 1e5\nfibre_frame = \"laplac\"",
       "case.toml:7: structure.fibre_frame: \"laplac\" is unknown; did you mean laplace? There are cylinder "
       "or laplace"},
      {"SectionIsNumber", static_case, "title = \"a wall under pressure\"", "output = 3",
       "case.toml:1: output: 3 is a whole number; make it a section [output]"},
      {"SectionIsArray", static_case, "[static]", "[[static]]",
       "case.toml:12: static: [a section] is an array; make it a section [static]"},
      {"LayersIsText", static_case, "[structure.layers.wall]\nmaterial = \"neo-hookean\"\nc10 = 3\n",
       "layers = \"wall\"\n",
       "case.toml:7: structure.layers: \"wall\" is a string; make it a section [structure.layers]"},
      {"LayerIsNumber", static_case, "[structure.layers.wall]\nmaterial = \"neo-hookean\"\nc10 = 3\n",
       "layers.wall = 3\n",
       "case.toml:7: structure.layers.wall: 3 is a whole number; make it a section [structure.layers.wall]"},
      {"NumberIsSection", coupled_case, "step = 0.125", "step.size = 0.125",
       "case.toml:25: time.step: is a section; give a number (time step in ms, or \"adaptive\")"},
      // Types
      {"NumberIsText", coupled_case, "viscosity = 3.5e-3", "viscosity = \"3.5e-3\"",
       "case.toml:7: fluid.viscosity: \"3.5e-3\" is a string; give a number (dynamic viscosity in kPa ms)"},
      {"NumberIsBoolean", coupled_case, "step = 0.125", "step = true",
       "case.toml:25: time.step: true is a boolean; give a number (time step in ms, or \"adaptive\")"},
      {"NumberIsDate", coupled_case, "step = 0.125", "step = 2020-01-01",
       "case.toml:25: time.step: 2020-01-01 is a date or time; give a number (time step in ms, or \"adaptive\")"},
      {"NumberIsArray", coupled_case, "bulk_modulus = 1e5", "bulk_modulus = [1e5, 2e5]",
       "case.toml:10: structure.bulk_modulus: [100000, 200000] is an array; give a number (bulk modulus in kPa of "
       "layers whose "
       "material has none of its own)"},
      {"NumberIsNan", coupled_case, "viscosity = 3.5e-3", "viscosity = nan",
       "case.toml:7: fluid.viscosity: nan is not finite; give a finite number (dynamic viscosity in kPa ms)"},
      {"NumberIsInfinite", coupled_case, "end = 12.0", "end = inf",
       "case.toml:26: time.end: inf is not finite; give a finite number (end of the run in ms; hit exactly, by "
       "shorter last steps where it is no multiple of step)"},
      {"WholeNumberIsDecimal", coupled_case, "every = 8", "every = 8.5",
       "case.toml:35: output.every: 8.5 is a decimal number; give a whole number from 0 to 1000000000 (steps between "
       "entries of fields.h5, "
       "default 8; 0: no fields)"},
      {"WholeNumberTooLarge", coupled_case, "every = 8", "every = 99999999999",
       "case.toml:35: output.every: 99999999999 is out of range; give a whole number from 0 to 1000000000 (steps "
       "between entries of "
       "fields.h5, default 8; 0: no fields)"},
      {"BooleanIsNumber", fluid_case, "density = 1.0", "density = 1.0\ngrad_div = 1",
       "case.toml:6: fluid.grad_div: 1 is a whole number; give true or false (grad-div stabilisation, default false)"},
      {"TextIsNumber", coupled_case, "\"a coupled case\"", "42",
       "case.toml:1: title: 42 is a whole number; give a string in quotes (what the case is, for people)"},
      {"FieldsIsText", coupled_case, "[\"displacement\", \"velocity\", \"pressure\"]", "\"pressure\"",
       "case.toml:34: output.fields: \"pressure\" is a string; give an array (fields in fields.h5: any of "
       "displacement, velocity, pressure, wall_shear_stress, cauchy_stress, principal_stress, von_mises_stress, "
       "fibre_stress, constants, thickness; default displacement, velocity, pressure)"},
      {"FieldIsNumber", coupled_case, "\"velocity\"", "2",
       "case.toml:34: output.fields[1]: 2 is a whole number; give a string in quotes"},
      // Missing
      {"ViscosityMissing", coupled_case, "viscosity = 3.5e-3\n", "",
       "case.toml:5: fluid.viscosity: missing; add it (dynamic viscosity in kPa ms)"},
      {"StepMissing", coupled_case, "step = 0.125\n", "",
       "case.toml:24: time.step: missing; add it (time step in ms, or \"adaptive\")"},
      {"PressureMissing", coupled_case, "pressure = 1.332\n", "",
       "case.toml:21: inlet.pressure: missing; add it (pressure in kPa, or a table of [time in ms, pressure in kPa], "
       "linear in between)"},
      {"MaterialMissing", static_case, "material = \"neo-hookean\"\n", "",
       "case.toml:7: structure.layers.wall.material: missing; add it (its model: " + one_of(materials().names()) + ")"},
      {"FibreParameterMissing", coupled_case, "k2 = 0.8393\n", "",
       "case.toml:11: structure.layers.media.k2: missing; add it (fibre exponent)"},
      {"LayersMissing", static_case, "[structure.layers.wall]\nmaterial = \"neo-hookean\"\nc10 = 3\n", "",
       "case.toml:4: structure.layers: missing; add it (a section [structure.layers.NAME] per volume group of the "
       "wall)"},
      {"LayersEmpty", static_case, "[structure.layers.wall]\nmaterial = \"neo-hookean\"\nc10 = 3\n",
       "[structure.layers]\n",
       "case.toml:7: structure.layers: has no layer; add a section [structure.layers.NAME] per volume group of the "
       "wall"},
      {"MeshMissing", fluid_case, "[mesh]\nfile = \"tube.msh\"\n", "",
       "case.toml: mesh: missing; add it (where the mesh comes from)"},
      {"MeshEmpty", fluid_case, "file = \"tube.msh\"\n", "",
       "case.toml:2: mesh: neither file nor level; give file = \"NAME.msh\", level = \"coarse\" or "
       "error = \"3%\""},
      {"MeshFileEmpty", fluid_case, "\"tube.msh\"", "\"\"",
       "case.toml:3: mesh.file: \"\" is empty; give the path of a gmsh file (gmsh mesh, path relative to the case "
       "file)"},
      {"MeshTwice", coupled_case, "level = \"coarse\"", "level = \"coarse\"\nfile = \"a.msh\"",
       "case.toml:4: mesh.level: both file and level; keep one of them"},
      {"MeshErrorBesideLevel", coupled_case, "level = \"coarse\"", "level = \"coarse\"\nerror = \"3%\"",
       "case.toml:5: mesh.error: both level and error; keep one of them"},
      {"MeshErrorWithoutSign", coupled_case, "level = \"coarse\"", "error = \"3\"",
       "case.toml:4: mesh.error: \"3\" is no percentage; give one, like \"3%\" (artery mesh made on demand: the "
       "smallest one recommended for the element with at most this error, like \"3%\")"},
      {"MeshWavesWithoutError", coupled_case, "level = \"coarse\"", "level = \"coarse\"\nwaves = \"resolved\"",
       "case.toml:5: mesh.waves: belongs to error; give error = \"3%\" as well, or leave waves out"},
      // Unphysical values
      {"DensityNegative", coupled_case, "density = 1.0", "density = -1.0",
       "case.toml:6: fluid.density: -1 is not positive; give a number > 0 (density in mg/mm^3)"},
      {"ViscosityZero", coupled_case, "viscosity = 3.5e-3", "viscosity = 0",
       "case.toml:7: fluid.viscosity: 0 is not positive; give a number > 0 (dynamic viscosity in kPa ms)"},
      {"WallDensityZero", coupled_case, "density = 1.2", "density = 0.0",
       "case.toml:9: structure.density: 0 is not positive; give a number > 0 (density in mg/mm^3)"},
      {"BulkModulusNegative", coupled_case, "bulk_modulus = 1e5", "bulk_modulus = -1e5",
       "case.toml:10: structure.bulk_modulus: -100000 is not positive; give a number > 0 (bulk modulus in kPa of "
       "layers whose material has none of its own)"},
      {"StabilisationZero", coupled_case, "bulk_modulus = 1e5", "bulk_modulus = 1e5\nstabilisation = 0",
       "case.toml:11: structure.stabilisation: 0 is not positive; give a number > 0 (alpha, factor of the wall's; "
       "default 0.05 with \"projected\" and a continuous layer_pressure, else 0.5)"},
      {"C10Zero", static_case, "c10 = 3", "c10 = 0",
       "case.toml:9: structure.layers.wall.c10: 0 is not positive; give a number > 0 (isotropic stiffness in kPa)"},
      {"C01Negative", coupled_case, "c01 = 0.2", "c01 = -0.2",
       "case.toml:20: structure.layers.adventitia.c01: -0.2 is negative; give a number >= 0 (second isotropic "
       "stiffness in kPa)"},
      {"LayerViscosityNegative", coupled_case, "c01 = 0.2", "c01 = 0.2\nviscosity = -1",
       "case.toml:21: structure.layers.adventitia.viscosity: -1 is negative; give a number >= 0 (of any material: eta "
       "in kPa ms of a stress eta dE/dt beside the elastic one, default 0)"},
      {"K1Negative", coupled_case, "k1 = 2.3632", "k1 = -2.3632",
       "case.toml:14: structure.layers.media.k1: -2.3632 is negative; give a number >= 0 (fibre stiffness in kPa)"},
      {"K2Zero", coupled_case, "k2 = 0.8393", "k2 = 0",
       "case.toml:15: structure.layers.media.k2: 0 is not positive; give a number > 0 (fibre exponent)"},
      {"AlphaTooLarge", coupled_case, "alpha = 29.0", "alpha = 119.0",
       "case.toml:16: structure.layers.media.alpha: 119 is out of range; give a number >= 0 and <= 90 (angle between "
       "fibres and circumference in degrees)"},
      {"FibreScaleZero", coupled_case, "alpha = 29.0", "alpha = 29.0\nfibre_scale = 0",
       "case.toml:17: structure.layers.media.fibre_scale: 0 is not positive; give a number > 0 (factor on the fibre "
       "energy, default 1)"},
      {"AxisTooShort", static_case, "bulk_modulus = 1e5", "bulk_modulus = 1e5\naxis_direction = [0, 1]",
       "case.toml:7: structure.axis_direction: [0, 1] is no point; give [x, y, z] (direction of the artery's axis "
       "in 3d, default [0, 0, 1])"},
      {"AxisZero", static_case, "bulk_modulus = 1e5", "bulk_modulus = 1e5\naxis_direction = [0, 0, 0]",
       "case.toml:7: structure.axis_direction: [0, 0, 0] has no direction; give a vector other than 0 (direction of "
       "the artery's axis in 3d, default [0, 0, 1])"},
      {"AxisOfText", static_case, "bulk_modulus = 1e5", "bulk_modulus = 1e5\naxis_origin = [0, \"0\", 0]",
       "case.toml:7: structure.axis_origin[1]: \"0\" is a string; give a number"},
      {"LayerNamedFluid", coupled_case, "[structure.layers.adventitia]", "[structure.layers.fluid]",
       "case.toml:17: structure.layers.fluid: \"fluid\" cannot be a layer; use the name of a volume group of the wall"},
      // Pressure
      {"UntilZero", coupled_case, "until = 0.125", "until = 0",
       "case.toml:23: inlet.until: 0 is not positive; give a time > 0 (time in ms at which a constant pressure falls "
       "to 0; without it the pressure stays)"},
      {"TableEmpty", fluid_case, "[[0, 0], [1, 2.5], [1, 0], [3, 1]]", "[]",
       "case.toml:8: inlet.pressure: [] is empty; give at least one row [time, pressure]"},
      {"TableOfNumbers", fluid_case, "[[0, 0], [1, 2.5], [1, 0], [3, 1]]", "[0, 1]",
       "case.toml:8: inlet.pressure[0]: 0 is no pair; give [time, pressure]"},
      {"TableOfTriples", fluid_case, "[1, 2.5]", "[1, 2.5, 3]",
       "case.toml:8: inlet.pressure[1]: [1, 2.5, 3] is no pair; give [time, pressure]"},
      {"TableOfText", fluid_case, "[1, 2.5]", "[1, \"high\"]",
       "case.toml:8: inlet.pressure[1][1]: \"high\" is a string; give a number"},
      {"TableNotSorted", fluid_case, "[3, 1]", "[0.5, 1]",
       "case.toml:8: inlet.pressure[3]: [0.5, 1] comes before the time 1 of the row above; sort the table by time"},
      {"TableTimeThrice", fluid_case, "[3, 1]", "[1, 1]",
       "case.toml:8: inlet.pressure[3]: [1, 1] is the third row with this time; give two rows for a jump"},
      {"TableWithUntil", fluid_case, "[time]", "until = 2\n[time]",
       "case.toml:9: inlet.until: stands beside a table of pressures; remove it; the table says when the pressure "
       "ends"},
      // Time
      {"StepZero", coupled_case, "step = 0.125", "step = 0",
       "case.toml:25: time.step: 0 is not positive; give a number > 0 (time step in ms, or \"adaptive\")"},
      {"EndNegative", coupled_case, "end = 12.0", "end = -12",
       "case.toml:26: time.end: -12 is not positive; give a number > 0 (end of the run in ms; hit exactly, by shorter "
       "last steps where it is no multiple of step)"},
      {"EndBeforeStep", coupled_case, "end = 12.0", "end = 0.1",
       "case.toml:26: time.end: 0.1 is less than one step of 0.125; give an end >= step"},
      {"StepsTooMany", coupled_case, "step = 0.125", "step = 1e-9",
       "case.toml:25: time.step: 1e-09 would take 1.2e+10 steps to 12; give a step that takes at most 1000000"},
      {"StepMisspelt", coupled_case, "step = 0.125", "step = \"adaptiv\"",
       "case.toml:25: time.step: \"adaptiv\" is unknown; did you mean \"adaptive\"?"},
      {"ToleranceOfEqualSteps", coupled_case, "end = 12.0", "end = 12.0\ntolerance = 0.01",
       "case.toml:27: time.tolerance: belongs to adaptive steps, and this run has equal ones; remove it, or set "
       "time.step = \"adaptive\""},
      {"ToleranceZero", coupled_case, "step = 0.125", "step = \"adaptive\"\ntolerance = 0",
       "case.toml:26: time.tolerance: 0 is out of range; give a number > 0 and < 1 (error that adaptive steps aim at, "
       "relative to the solution, default 0.01)"},
      {"LargestStepBehindTheEnd", coupled_case, "step = 0.125", "step = \"adaptive\"\nlargest_step = 13",
       "case.toml:26: time.largest_step: 13 is more than the end of 12; give at most 12"},
      {"FirstStepAboveTheLargest", coupled_case, "step = 0.125",
       "step = \"adaptive\"\nlargest_step = 0.25\nfirst_step = 0.5",
       "case.toml:27: time.first_step: 0.5 is more than the largest step of 0.25; give at most 0.25"},
      {"SmallestStepAboveTheFirst", coupled_case, "step = 0.125",
       "step = \"adaptive\"\nfirst_step = 0.01\nsmallest_step = 0.1",
       "case.toml:27: time.smallest_step: 0.1 is more than the first step of 0.01; give at most 0.01"},
      {"RetriesNegative", coupled_case, "end = 12.0", "end = 12.0\nretries = -1",
       "case.toml:27: time.retries: -1 is out of range; give a whole number from 0 to 20 (times that a step which "
       "finds "
       "no solution is halved before the run gives up, default 4)"},
      {"IntervalZero", coupled_case, "[output]", "[output]\ninterval = 0",
       "case.toml:34: output.interval: 0 is not positive; give a number > 0 (time in ms between entries of fields.h5, "
       "in "
       "place of every: steps end there; with adaptive steps a twelfth of the run unless given)"},
      {"OutputTimesUnsorted", coupled_case, "[output]", "[output]\ntimes = [1.5, 3, 3]",
       "case.toml:34: output.times[2]: 3 is not later than 3, the time before it; give the times in ascending order"},
      {"OutputTimeBehindTheEnd", coupled_case, "[output]", "[output]\ntimes = [1.5, 12.5]",
       "case.toml:34: output.times: 12.5 ms does not lie in the run; give times > 0 and <= time.end, 12"},
      {"OutputTimeZero", coupled_case, "[output]", "[output]\ntimes = [0, 1.5]",
       "case.toml:34: output.times: 0 ms does not lie in the run; give times > 0 and <= time.end, 12"},
      {"OutputTimesTooClose", coupled_case, "[output]", "[output]\ntimes = [1.5, 1.500001]",
       "case.toml:34: output.times: 1.5 and 1.500001 are 1e-06 ms apart; leave 1.2e-05 ms between times"},
      {"OutputTimesAreNumbers", coupled_case, "[output]", "[output]\ntimes = [1.5, \"end\"]",
       "case.toml:34: output.times[1]: \"end\" is a string; give a number"},
      {"OutputTimesOfAStaticCase", static_case, "[static]", "[output]\ntimes = [0.5]\n[static]",
       "case.toml:13: output.times: belong to a run in time, and this case is static; leave this key out"},
      {"NewmarkBetaZero", coupled_case, "end = 12.0", "end = 12.0\nnewmark_beta = 0",
       "case.toml:27: time.newmark_beta: 0 is out of range; give a number > 0 and <= 1 (Newmark's beta of the wall, "
       "default 1)"},
      {"NewmarkGammaLarge", coupled_case, "end = 12.0", "end = 12.0\nnewmark_gamma = 1.5",
       "case.toml:27: time.newmark_gamma: 1.5 is out of range; give a number > 0 and <= 1 (Newmark's gamma of the "
       "wall, default 1)"},
      {"TimeSchemeUnknown", coupled_case, "end = 12.0", "end = 12.0\nscheme = \"midpiont\"",
       "case.toml:27: time.scheme: \"midpiont\" is unknown; did you mean midpoint? There are " +
           one_of(time_schemes().names())},
      {"NewmarkWithAnotherScheme", coupled_case, "end = 12.0", "end = 12.0\nnewmark_beta = 0.25",
       "case.toml:27: time.newmark_beta: belongs to the scheme \"euler\", and this case names none; remove it, or set "
       "time.scheme = \"euler\""},
      {"DampingWithAnotherScheme", coupled_case, "end = 12.0", "end = 12.0\nscheme = \"bdf2\"\ndamping = 0.4",
       "case.toml:28: time.damping: belongs to the scheme \"midpoint\", and this run has \"bdf2\"; remove it, or set "
       "time.scheme = \"midpoint\""},
      {"SpectralRadiusAboveOne", coupled_case, "end = 12.0",
       "end = 12.0\nscheme = \"generalised-alpha\"\nspectral_radius = 1.5",
       "case.toml:28: time.spectral_radius: 1.5 is out of range; give a number >= 0 and <= 1 (of generalised-alpha at "
       "infinite frequency, default 0.5; more than 0.5 lets pressures ring)"},
      {"PredictorOfOrderThree", coupled_case, "end = 12.0", "end = 12.0\npredictor = 3",
       "case.toml:27: time.predictor: 3 is out of range; give a whole number from 0 to 2 (order of the extrapolated "
       "start of each step, default 2; euler of fsi-monolithic and explicit coupling 1)"},
      // Mesh motion
      {"MeshMotionUnknown", coupled_case, "[output]", "[mesh_motion]\nmethod = \"stifened\"\n[output]",
       "case.toml:34: mesh_motion.method: \"stifened\" is unknown; did you mean stiffened? There are harmonic, "
       "stiffened "
       "or nonlinear-elastic"},
      {"ExponentOfTheHarmonicMotion", coupled_case, "[output]", "[mesh_motion]\nsize_exponent = 1\n[output]",
       "case.toml:34: mesh_motion.size_exponent: belongs to the method \"stiffened\" or \"nonlinear-elastic\", and "
       "this "
       "case has \"harmonic\"; remove it, or set mesh_motion.method = \"stiffened\""},
      {"PoissonOfTheStiffenedMotion", coupled_case, "[output]",
       "[mesh_motion]\nmethod = \"stiffened\"\npoisson = 0.3\n[output]",
       "case.toml:35: mesh_motion.poisson: belongs to the method \"nonlinear-elastic\", and this case has "
       "\"stiffened\"; "
       "remove it, or set mesh_motion.method = \"nonlinear-elastic\""},
      {"PoissonOfAnIncompressibleMesh", coupled_case, "[output]",
       "[mesh_motion]\nmethod = \"nonlinear-elastic\"\npoisson = 0.5\n[output]",
       "case.toml:35: mesh_motion.poisson: 0.5 is out of range; give a number >= 0 and <= 0.49 (Poisson's ratio of "
       "nonlinear-elastic at rest, default 0)"},
      {"MeshMotionWithoutFluid", static_case, "[static]", "[mesh_motion]\nmethod = \"stiffened\"\n[static]",
       "case.toml:12: mesh_motion: is for scenes of fluid and wall, where the fluid's mesh moves; remove it"},
      {"LoadStepsZero", static_case, "load_steps = 5", "load_steps = 0",
       "case.toml:13: static.load_steps: 0 is out of range; give a whole number from 1 to 1000000 (equal steps in "
       "which the load is raised, default 10)"},
      // Names and numbers of solvers and output
      {"LevelUnknown", coupled_case, "\"coarse\"", "\"corase\"",
       "case.toml:4: mesh.level: \"corase\" is unknown; did you mean coarse? There are coarse, intermediate or fine"},
      {"MaterialUnknown", coupled_case, "\"mooney-rivlin\"", "\"money-rivlin\"",
       "case.toml:18: structure.layers.adventitia.material: \"money-rivlin\" is unknown; did you mean mooney-rivlin? "
       "There are " +
           one_of(materials().names())},
      {"LinearSolverUnknown", coupled_case, "\"direct\"", "\"amg_gmers\"",
       "case.toml:28: monolithic.linear_solver: \"amg_gmers\" is unknown; did you mean amg_gmres? There are " +
           one_of(linear_solver_names())},
      {"LinearToleranceOne", coupled_case, "[monolithic]", "[linear]\ntolerance = 1\n[monolithic]",
       "case.toml:28: linear.tolerance: 1 is out of range; give a number >= 0 and < 1 (residual of each "
       "linear solve relative to its right-hand side, default 0: what Newton's convergence needs)"},
      {"LinearIterationsZero", coupled_case, "[monolithic]", "[linear]\nmax_iterations = 0\n[monolithic]",
       "case.toml:28: linear.max_iterations: 0 is out of range; give a whole number from 1 to 1000000 "
       "(of the "
       "paper's coupled solvers: iterations of each linear solve, default 500)"},
      {"RestartZero", coupled_case, "[monolithic]", "[linear]\nrestart = 0\n[monolithic]",
       "case.toml:28: linear.restart: 0 is out of range; give a whole number from 1 to 10000 (of the paper's "
       "coupled solvers: directions that GMRES and FGMRES keep, default 250)"},
      {"MultigridIsNoSection", coupled_case, "multigrid.levels = 10", "multigrid = 3",
       "case.toml:29: monolithic.multigrid: 3 is a whole number; make it a section [monolithic.multigrid]"},
      {"MultigridKeyUnknown", coupled_case, "multigrid.levels = 10", "multigrid.dampening = 0.3",
       "case.toml:29: monolithic.multigrid.dampening: unknown key; did you mean monolithic.multigrid.damping?"},
      {"MultigridCycleUnknown", coupled_case, "multigrid.levels = 10", "multigrid.cycle = \"f\"",
       "case.toml:29: monolithic.multigrid.cycle: \"f\" is unknown; did you mean v? There are v, w or k"},
      {"SubCycleUnknown", coupled_case, "multigrid.levels = 10", "multigrid.sub_cycle = \"k\"",
       "case.toml:29: monolithic.multigrid.sub_cycle: \"k\" is unknown; did you mean v? There are v or w"},
      {"DampingTooLarge", coupled_case, "multigrid.levels = 10", "multigrid.damping = 1.5",
       "case.toml:29: monolithic.multigrid.damping: 1.5 is out of range; give a number >= 0 and <= 1 (damping factor "
       "of the coupled smoother, default 0: estimated on each level)"},
      {"PreSmoothingNegative", coupled_case, "multigrid.levels = 10", "multigrid.pre_smoothing = -1",
       "case.toml:29: monolithic.multigrid.pre_smoothing: -1 is out of range; give a whole number from 0 to 1000 "
       "(steps of the "
       "coupled smoother before the coarse correction, default 5)"},
      {"NoSmoothing", coupled_case, "multigrid.levels = 10",
       "multigrid.pre_smoothing = 0\nmultigrid.post_smoothing = 0",
       "case.toml:29: monolithic.multigrid: neither pre_smoothing nor post_smoothing; give at least one step"},
      {"LevelsZero", coupled_case, "multigrid.levels = 10", "multigrid.levels = 0",
       "case.toml:29: monolithic.multigrid.levels: 0 is out of range; give a whole number from 1 to 100 (levels at "
       "most, "
       "default 10)"},
      {"CoarseningUnknown", coupled_case, "multigrid.levels = 10", "multigrid.coarsening = \"coloring\"",
       "case.toml:29: monolithic.multigrid.coarsening: \"coloring\" is unknown; did you mean colouring? There are "
       "colouring or aggregation"},
      {"FluidSmootherUnknown", coupled_case, "multigrid.levels = 10", "multigrid.fluid_smoother = \"vanca\"",
       "case.toml:29: monolithic.multigrid.fluid_smoother: \"vanca\" is unknown; did you mean vanka? There are "
       "braess-sarazin or vanka"},
      {"ModeUnknown", coupled_case, "linear_solver = \"direct\"", "mode = \"keep\"",
       "case.toml:28: monolithic.mode: \"keep\" is unknown; did you mean kept? There are kept or full"},
      {"ModeGone", coupled_case, "linear_solver = \"direct\"", "mode = \"linearised\"",
       "case.toml:28: monolithic.mode: \"linearised\" is gone: it left up to 10 % of the pressure where it said 0.1 %; "
       "use "
       "\"kept\", with a looser newton.tolerance, 1e-2 say, where fewer solves are worth more than digits"},
      {"FormerNameMisspelt", coupled_case, "linear_solver = \"direct\"", "newton_tolerence = 1e-8",
       "case.toml:28: monolithic.newton_tolerence: unknown key; did you mean monolithic.newton_tolerance?"},
      {"FormerNameOutOfRange", coupled_case, "multigrid.levels = 10", "newton_tolerance = 0",
       "case.toml:29: monolithic.newton_tolerance: 0 is out of range; give a number > 0 and < 1 (last increment "
       "relative to the first of the step, default 0.001)"},
      {"FormerNameBesideThePresentOne", coupled_case, "[monolithic]",
       "[newton]\ntolerance = 1e-8\n[monolithic]\nnewton_tolerance = 1e-6",
       "case.toml:30: monolithic.newton_tolerance: stands beside newton.tolerance, another name of the same; keep "
       "newton.tolerance"},
      {"PreconditionerUnknown", coupled_case, "[monolithic]", "[linear]\npreconditioner = \"simples\"\n[monolithic]",
       "case.toml:28: linear.preconditioner: \"simples\" is unknown; did you mean simple? There are block-factors or "
       "simple"},
      {"TwoFormerNamesOfOneKey", coupled_case, "[partitioned]\nscheme = \"aitken\"",
       "direct_below = 5\n[partitioned]\ndirect_below = 7",
       "case.toml:32: partitioned.direct_below: stands beside monolithic.direct_below, another name of the same; keep "
       "linear.direct_below"},
      {"NewtonIsNoSection", coupled_case, "multigrid.levels = 10", "newton_tolerance = 1e-8\n[petsc]\n[newton2]",
       "case.toml:31: newton2: unknown section; did you mean newton?"},
      {"SchemeUnknown", coupled_case, "\"aitken\"", "\"aitkin\"",
       "case.toml:31: partitioned.scheme: \"aitkin\" is unknown; did you mean aitken? There are " +
           one_of(coupling_scheme_names())},
      {"SchemeMisspelt", coupled_case, "\"aitken\"", "\"iqn_ils\"",
       "case.toml:31: partitioned.scheme: \"iqn_ils\" is unknown; did you mean iqn-ils? There are " +
           one_of(coupling_scheme_names())},
      {"AbsoluteToleranceNegative", coupled_case, "tolerance = 1e-6", "absolute_tolerance = -1e-9",
       "case.toml:32: partitioned.absolute_tolerance: -1e-09 is negative; give a number >= 0 (interface change in mm "
       "(Euclidean norm) that is small enough too, default 0)"},
      {"ForceToleranceOne", coupled_case, "tolerance = 1e-6", "force_tolerance = 1",
       "case.toml:32: partitioned.force_tolerance: 1 is out of range; give a number >= 0 and < 1 (residual of the "
       "interface's momentum balance relative to the force, default 0: not demanded)"},
      {"ColumnsZero", coupled_case, "tolerance = 1e-6", "columns = 0",
       "case.toml:32: partitioned.columns: 0 is out of range; give a whole number from 1 to 10000 (differences that a "
       "quasi-Newton scheme keeps at most, default 200)"},
      {"ReusedStepsNegative", coupled_case, "tolerance = 1e-6", "reused_steps = -1",
       "case.toml:32: partitioned.reused_steps: -1 is out of range; give a whole number from 0 to 10000 (earlier time "
       "steps whose "
       "differences iqn-ils keeps, default 10)"},
      {"FilterOne", coupled_case, "tolerance = 1e-6", "filter = 1",
       "case.toml:32: partitioned.filter: 1 is out of range; give a number >= 0 and < 1 (part of a difference that "
       "must be new for a quasi-Newton scheme to keep it, default 0.01)"},
      {"SubProblemSolverUnknown", coupled_case, "tolerance = 1e-6", "linear_solver = \"slow\"",
       "case.toml:32: partitioned.linear_solver: \"slow\" is unknown; did you mean fast? There are fast, direct or "
       "petsc"},
      {"FieldUnknown", coupled_case, "\"velocity\"", "\"velocities\"",
       "case.toml:34: output.fields[1]: \"velocities\" is unknown; did you mean velocity? There are displacement, "
       "velocity, pressure, wall_shear_stress, cauchy_stress, principal_stress, von_mises_stress, fibre_stress, "
       "constants or thickness"},
      {"FieldOfAWallThatIsNotThere", fluid_case, "[time]", "[output]\nfields = [\"von_mises_stress\"]\n[time]",
       "case.toml:10: output.fields: \"von_mises_stress\" is of a wall, and the scene has none; leave it out"},
      {"FieldOfAFluidThatIsNotThere", static_case, "[static]", "[output]\nfields = [\"wall_shear_stress\"]\n[static]",
       "case.toml:13: output.fields: \"wall_shear_stress\" is of a fluid, and the scene has none; leave it out"},
      {"SurfaceTwice", coupled_case, "every = 8", "surfaces = [\"a\", \"a\"]",
       "case.toml:35: output.surfaces[1]: \"a\" is named twice; name each surface once"},
      {"SurfaceWithAComma", coupled_case, "every = 8", "surfaces = [\"a,b\"]",
       "case.toml:35: output.surfaces[0]: \"a,b\" cannot stand in a table; give up to 100 letters, digits and signs "
       "other than commas and quotes"},
      {"ForceWithoutSurfaces", coupled_case, "every = 8", "[output.forces.body]\nsurfaces = []",
       "case.toml:36: output.forces.body.surfaces: names no surface; give at least one"},
      {"ForceOfASurfacesName", coupled_case, "every = 8",
       "surfaces = [\"body\"]\n[output.forces.body]\nsurfaces = [\"a\"]",
       "case.toml:36: output.forces.body: \"body\" is a name in output.surfaces, too; give it another one"},
      {"StatisticsWithoutPeriod", coupled_case, "every = 8", "statistics = true",
       "case.toml:35: output.statistics: need a period, and no opening is periodic; give output.period in ms"},
      {"StatisticsOfTwoPeriods", coupled_case, "[output]",
       "[[opening]]\nsurface = \"a\"\npressure = [[0, 1], [1, 2]]\nperiod = 2\n[[opening]]\nsurface = \"b\"\n"
       "pressure = [[0, 1], [1, 2]]\nperiod = 3\n[output]\nstatistics = true",
       "case.toml:42: output.statistics: need a period, and the openings have different ones: opening.a.pressure of 2 "
       "ms, opening.b.pressure of 3 ms; give output.period in ms"},
      {"StatisticsWithoutFields", coupled_case, "every = 8", "every = 0\nstatistics = true\nperiod = 1",
       "case.toml:36: output.statistics: are fields, and output.every = 0 writes none; give another every"},
      {"IntervalWithoutFields", coupled_case, "every = 8", "every = 0\ninterval = 1",
       "case.toml:36: output.interval: asks for fields, and output.every = 0 writes none; remove one of the two"},
      {"IntervalWithoutFieldsBySet",
       coupled_case,
       "",
       "",
       "--set: output.interval: asks for fields, and output.every = 0 writes none; remove one of the two",
       {"output.every=0", "output.interval=1"}},
      {"ErrorIndicatorWithoutFields", coupled_case, "every = 8", "every = 0\nerror_indicator = true",
       "case.toml:36: output.error_indicator: asks for fields, and output.every = 0 writes none; give another every"},
      {"StatisticsOfAWall", static_case, "[static]", "[output]\nstatistics = true\nperiod = 1\n[static]",
       "case.toml:13: output.statistics: are of a fluid in time, and the scene has none; leave them out"},
      {"PeriodWithoutStatistics", coupled_case, "every = 8", "period = 1.0",
       "case.toml:35: output.period: belongs to statistics; set output.statistics = true as well, or leave it out"},
      {"FieldTwice", coupled_case, "\"velocity\"", "\"pressure\"",
       "case.toml:34: output.fields[2]: \"pressure\" is named twice; name each field once"},
      {"EveryNegative", coupled_case, "every = 8", "every = -1",
       "case.toml:35: output.every: -1 is out of range; give a whole number from 0 to 1000000000 (steps between "
       "entries of fields.h5, "
       "default 8; 0: no fields)"},
      {"NewtonToleranceZero", coupled_case, "[monolithic]", "[newton]\ntolerance = 0\n[monolithic]",
       "case.toml:28: newton.tolerance: 0 is out of range; give a number > 0 and < 1 (last increment "
       "relative to the first of the step, default 0.001)"},
      {"ToleranceOne", coupled_case, "tolerance = 1e-6", "tolerance = 1",
       "case.toml:32: partitioned.tolerance: 1 is out of range; give a number > 0 and < 1 (gap between fluid "
       "and wall relative to the interface's displacement, default 1e-6; robin-neumann-inexact and block-newton: error "
       "of a step relative to what it changes, without it what [newton] demands)"},
      {"ResidualToleranceNegative", coupled_case, "[monolithic]", "[newton]\nresidual_tolerance = -1\n[monolithic]",
       "case.toml:28: newton.residual_tolerance: -1 is out of range; give a number >= 0 and < 1 (residual relative "
       "to the first of the step, default 0: not demanded)"},
      {"MaxIterationsZero", coupled_case, "tolerance = 1e-6", "max_iterations = 0",
       "case.toml:32: partitioned.max_iterations: 0 is out of range; give a whole number from 1 to 1000000 (coupling "
       "iterations per step, of block-newton passes per linear system, default 200)"},
      {"RelaxationTwo", coupled_case, "tolerance = 1e-6", "relaxation = 2.0",
       "case.toml:32: partitioned.relaxation: 2 is out of range; give a number > 0 and < 2 (constant factor or the "
       "scheme's first; without it the scheme chooses)"},
      // Sections that do not go together
      {"NeitherFluidNorWall", fluid_case, "[fluid]\ndensity = 1.0\nviscosity = 3.5e-3\n", "",
       "case.toml: neither [fluid] nor [structure]; add at least one of them"},
      {"InletMissing", fluid_case, "[inlet]\npressure = [[0, 0], [1, 2.5], [1, 0], [3, 1]]\n", "",
       "case.toml: no [inlet]; add [inlet] with pressure, since there is a fluid, or [[opening]]; for a fluid that "
       "nothing enters or leaves, "
       "closed = [...] in [fluid] with the names of its surfaces, [] where the wall encloses it"},
      {"InletWithoutFluid", static_case, "[load]", "[inlet]",
       "case.toml:10: inlet: stands in a case without fluid; rename it to [load], or add [fluid]"},
      {"LoadMissing", static_case, "[load]\npressure = 2.0\n", "",
       "case.toml: no [load]; add [load] with pressure, since there is no fluid"},
      {"LoadWithFluid", fluid_case, "[time]", "[load]\npressure = 1\n[time]",
       "case.toml:9: load: is for a wall without fluid; rename it to [inlet], or remove it"},
      {"StaticWithTime", static_case, "[static]", "[time]\nstep = 1\nend = 2\n[static]",
       "case.toml:15: static: stands beside [time]; keep one of the two"},
      {"StaticWithFluid", fluid_case, "[time]\nstep = 0.1\nend = 3\n", "[static]\n",
       "case.toml:9: static: is for a wall without fluid; replace it by [time]"},
      {"NeitherTimeNorStatic", static_case, "[static]\nload_steps = 5\n", "",
       "case.toml: neither [time] nor [static]; add [time] with step and end, or [static]"},
      {"FluidWithoutTime", fluid_case, "[time]\nstep = 0.1\nend = 3\n", "",
       "case.toml: no [time]; add [time] with step and end"},
      {"StaticLoadInTime", static_case, "pressure = 2.0", "pressure = [[0, 0], [1, 2]]",
       "case.toml:10: load: changes in time, but the case is static; give one pressure, without until"},
      {"StaticLoadUntil", static_case, "pressure = 2.0", "pressure = 2.0\nuntil = 1",
       "case.toml:10: load: changes in time, but the case is static; give one pressure, without until"},
      // --set
      {"SetUnknownKey",
       coupled_case,
       "",
       "",
       "--set: fluid.viscocity: unknown key; did you mean fluid.viscosity?",
       {"fluid.viscocity=1"}},
      {"SetUnknownSection",
       coupled_case,
       "",
       "",
       "--set: fluids: unknown section; did you mean fluid?",
       {"fluids.density=1"}},
      {"SetNewSection",
       static_case,
       "",
       "",
       "--set: fluid.viscosity: missing; add it (dynamic viscosity in kPa ms)",
       {"fluid.density=1"}},
      {"SetBadValue",
       coupled_case,
       "",
       "",
       "--set: structure.layers.media.c10: -3 is not positive; give a number > 0 (isotropic stiffness in kPa)",
       {"structure.layers.media.c10=-3"}},
      {"SetListElement",
       coupled_case,
       "",
       "",
       "--set: output.times[1]: \"x\" is a string; give a number",
       {"output.times=[0.25, \"x\"]"}},
      {"SetBareWord",
       coupled_case,
       "",
       "",
       "--set: time.step: \"fast\" is a string; give a number (time step in ms, or \"adaptive\")",
       {"time.step=fast"}},
      {"SetBelowNumber",
       coupled_case,
       "",
       "",
       "--set: time.step.size=1: time.step is no section; see --help-keys for valid keys",
       {"time.step.size=1"}},
      {"SetWithoutValue",
       coupled_case,
       "",
       "",
       "--set: time.step: has no '='; write --set key=value, e.g. time.end=6.0",
       {"time.step"}},
      {"SetWithoutKey",
       coupled_case,
       "",
       "",
       "--set: =3: has no key; write --set key=value, e.g. time.end=6.0",
       {"=3"}},
      {"ElementMisspelt", coupled_case, "\"p1\"", "\"p2\"",
       "case.toml:2: element: \"p2\" is unknown; did you mean p1? There are p1 or p2p1"},
      {"GeometryMisspelt",
       coupled_case,
       "",
       "",
       "--set: geometry: \"axisymetric\" is unknown; did you mean axisymmetric? There are 3d, axisymmetric or plane",
       {"geometry=axisymetric"}},
      {"GeometryIsNumber",
       coupled_case,
       "",
       "",
       "--set: geometry: 2 is a whole number; give a string in quotes (space of the scene: 3d (default), axisymmetric "
       "or "
       "plane; axisymmetric meshes are triangles in the plane of r = x and z, plane ones (plane strain) in that of x "
       "and "
       "y)",
       {"geometry=2"}},
      {"OutletIsText",
       coupled_case,
       "",
       "",
       "--set: fluid.outlet: \"none\" is a string; give true or false (whether fluid leaves through a surface outlet, "
       "free of traction, default true)",
       {"fluid.outlet=none"}},
      {"LayerPressureMisspelt",
       coupled_case,
       "",
       "",
       "--set: structure.layer_pressure: \"split\" is unknown; did you mean separate? There are continuous or separate",
       {"structure.layer_pressure=split"}},
      {"AxisOfAxisymmetricScene",
       coupled_case,
       "",
       "",
       "--set: structure.axis_direction: the axis of an axisymmetric scene is the z axis; leave this key out",
       {"geometry=axisymmetric", "structure.axis_direction=[0, 1, 0]"}},
      {"OriginOfAxisymmetricScene",
       coupled_case,
       "",
       "",
       "--set: structure.axis_origin: the axis of an axisymmetric scene is the z axis; leave this key out",
       {"geometry=axisymmetric", "structure.axis_origin=[0.1, 0, 0]"}},
      {"AxisOfPlaneScene",
       coupled_case,
       "[structure]",
       "[structure]\naxis_direction = [1, 0, 0]",
       "case.toml:9: structure.axis_direction: the axis of a plane scene stands upright on its plane: it is along z; "
       "leave this key out",
       {"geometry=plane"}},
      {"SetEmptyPart",
       coupled_case,
       "",
       "",
       "--set: time..step=3: has no key; write --set key=value, e.g. time.end=6.0",
       {"time..step=3"}},
      {"SetNothing",
       coupled_case,
       "",
       "",
       "--set: time.step: \"\" is a string; give a number (time step in ms, or \"adaptive\")",
       {"time.step="}},
      {"SetTwoMeshes",
       coupled_case,
       "",
       "",
       "--set: mesh.level: both file and level; keep one of them",
       {"mesh.level=fine", "mesh.file=a.msh"}},
      {"SetTwoLines",
       coupled_case,
       "",
       "",
       "--set: time.step: \"1 end=2\" is a string; give a number (time step in ms, or \"adaptive\")",
       {"time.step=1\nend=2"}},
      {"SetSectionToNumber",
       coupled_case,
       "",
       "",
       "--set: fluid: 3 is a whole number; make it a section [fluid]",
       {"fluid=3"}},
  };
  return cases;
}

class BadCaseFile : public testing::TestWithParam<BadCase> {};
class BadSyntax : public testing::TestWithParam<BadCase> {};

TEST_P(BadCaseFile, IsRefusedInOneLine) {
  EXPECT_EQ(complaint_about(GetParam()), GetParam().message);
}

TEST_P(BadSyntax, IsRefusedInOneLine) {
  const auto message = complaint_about(GetParam());
  EXPECT_EQ(message.substr(0, GetParam().message.size()), GetParam().message);
  EXPECT_EQ(message.find('\n'), std::string::npos);
}

INSTANTIATE_TEST_SUITE_P(All, BadCaseFile, testing::ValuesIn(bad_cases()), name_of);
INSTANTIATE_TEST_SUITE_P(All, BadSyntax, testing::ValuesIn(syntax_errors()), name_of);

TEST(BadCaseFile, IsMissing) {
  try {
    read_case("no-such-folder/case.toml");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "no-such-folder/case.toml: no such file; give the path of a case file");
  }
}

TEST(BadCaseFile, IsFolder) {
  try {
    read_case("/");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "/: is a folder; give the path of a case file");
  }
}

TEST(BadCaseFile, IsEmpty) {
  try {
    parse_case("", "case.toml");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "case.toml: mesh: missing; add it (where the mesh comes from)");
  }
}

}  // namespace

}  // namespace fsi::test
