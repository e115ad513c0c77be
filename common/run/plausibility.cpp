#include "run/plausibility.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "base/names.hpp"
#include "case/openings.hpp"
#include "case/windkessel_units.hpp"
#include "fem/dimensions.hpp"
#include "scene/wave_speed.hpp"

namespace fsi {

namespace {

constexpr double pi = 3.14159265358979323846;

// What is warned of.
constexpr double fastest = 10, largest_reynolds = 2e4, largest_womersley = 100, fastest_of_waves = 0.75;
constexpr double largest_strain = 1, largest_strain_of_fibres = 10;
constexpr double slowest = 2e-6;  // m/s: a capillary's flow is a hundred times as fast
// What a unit is tried for: numbers of vessels.
constexpr double usual_velocity = 3, least_velocity = 1e-3, usual_reynolds = 1e4, usual_womersley = 40;
constexpr double usual_of_waves = 0.5, usual_strain = 0.6;

/// Largest size of a value up to `end`.
double largest_magnitude(const PressureTable& table, double end) {
  double largest = std::abs(table.at(end));
  for (const auto& [time, value] : table.points)
    if (time <= end) largest = std::max(largest, std::abs(value));
  return largest;
}

/// Largest difference of a table's values from one, up to `end`.
double largest_change(const PressureTable& table, double from, double end) {
  PressureTable change = table;
  for (auto& [time, value] : change.points) value -= from;
  return largest_magnitude(change, end);
}

/// Pressures that the case gives to its fluid, kPa: their largest distance from that at rest.
double largest_load(const Case& setup) {
  const double at_rest = setup.prestress ? setup.prestress->pressure : 0, end = setup.time->end;
  double load = 0;
  for (const auto& opening : openings_of(setup))
    if (opening.pressure) load = std::max(load, largest_change(*opening.pressure, at_rest, end));
  if (const auto mean = mean_pressure_of_flow(setup)) load = std::max(load, std::abs(*mean - at_rest));
  return load;
}

/// Whether nothing but given pressures drives the flow through rigid walls.
bool is_driven_by_pressures(const Case& setup) {
  if (setup.structure) return false;
  const auto openings = openings_of(setup);
  return std::all_of(openings.begin(), openings.end(),
                     [](const auto& opening) { return !opening.flow_rate && !opening.law && !opening.joined; });
}

/// Of the part's nodes, the longest extent along an axis, mm.
template <int n>
double extent_of(const Fluid<n>& fluid) {
  double longest = 0;
  for (int k = 0; k < 3; ++k) {
    double low = 0, high = 0;
    bool first = true;
    for (const auto& x : fluid.nodes().nodes) {
      low = first ? x[k] : std::min(low, x[k]);
      high = first ? x[k] : std::max(high, x[k]);
      first = false;
    }
    longest = std::max(longest, high - low);
  }
  return fluid.nodes().processes().largest(longest);
}

/// A slip of units: what a value is multiplied by to be in the right one.
struct Slip {
  const char* text;
  double length = 1, flow = 1, pressure = 1, time = 1, modulus = 1;
};

constexpr Slip slips[] = {
    {"the mesh in cm", 10},
    {"the mesh in m", 1000},
    {"flows in ml/min", 1, 1.0 / 60},
    {"flows in L/min", 1, 1e3 / 60},
    {"flows in mm^3/s", 1, 1e-3},
    {"flows in m^3/s", 1, 1e6},
    {"pressures in mmHg", 1, 1, 0.133322},
    {"pressures in Pa", 1, 1, 1e-3},
    {"pressures in dyn/cm^2", 1, 1, 1e-4},
    {"times in s", 1, 1, 1, 1e3},
    {"moduli in MPa", 1, 1, 1, 1, 1e3},
};

OpeningFlow with_slip(OpeningFlow flow, const Slip& slip) {
  const double given = flow.velocity;
  flow.diameter *= slip.length;
  if (auto& drive = flow.drive) {
    drive->pressure *= slip.pressure;
    drive->length *= slip.length;
    drive->duration *= slip.time;
    flow.velocity = driven_velocity(*drive, flow.diameter);
  } else {
    flow.velocity *= slip.flow / (slip.length * slip.length);
  }
  if (given > 0) flow.reynolds *= flow.velocity / given * slip.length;
  flow.womersley *= slip.length / std::sqrt(slip.time);
  return flow;
}

DerivedNumbers with_slip(DerivedNumbers numbers, const Slip& slip) {
  for (auto& flow : numbers.flows) flow = with_slip(flow, slip);
  numbers.wave_speed *= std::sqrt(slip.modulus);
  numbers.strain *= slip.pressure / slip.modulus;
  return numbers;
}

bool is_usual(const OpeningFlow& flow, double wave_speed) {
  return flow.velocity >= least_velocity && flow.velocity <= usual_velocity && flow.reynolds <= usual_reynolds &&
         flow.womersley <= usual_womersley && (wave_speed == 0 || flow.velocity <= usual_of_waves * wave_speed);
}

/// The slips after which a number is what it usually is, in words; empty: none.
template <class IsUsual>
std::string explanation(const DerivedNumbers& numbers, const IsUsual& is_usual_then) {
  std::vector<std::string> texts;
  for (const Slip& slip : slips)
    if (is_usual_then(with_slip(numbers, slip))) texts.emplace_back(slip.text);
  return texts.empty() ? "" : "; " + one_of(texts) + " would explain it";
}

std::string text_of(const OpeningFlow& flow) {
  std::string text = fmt::format("{} {:.3g} m/s in the mean, Reynolds number {:.3g}",
                                 flow.drive ? "at most about" : "up to", flow.velocity, flow.reynolds);
  if (flow.womersley > 0) text += fmt::format(", Womersley number {:.3g}", flow.womersley);
  return text;
}

/// What is wrong with a flow; empty: nothing.
std::string fault_of(const OpeningFlow& flow, double wave_speed) {
  if (flow.velocity > fastest || flow.reynolds > largest_reynolds || flow.womersley > largest_womersley)
    return text_of(flow);
  if (wave_speed > 0 && flow.velocity > fastest_of_waves * wave_speed)
    return fmt::format("up to {:.3g} m/s in the mean, {:.3g} times as fast as pressure waves", flow.velocity,
                       flow.velocity / wave_speed);
  if (flow.velocity > 0 && flow.velocity < slowest && !flow.drive) return text_of(flow);
  return "";
}

}  // namespace

double driven_velocity(const FlowDrive& drive, double diameter) {
  const double p = drive.pressure;
  return std::min({p * diameter * diameter / (32 * drive.viscosity * drive.length),
                   p * drive.duration / (drive.density * drive.length), std::sqrt(2 * p / drive.density)});
}

template <int n>
DerivedNumbers derived_numbers(const Case& setup, const Scene<n>& scene) {
  DerivedNumbers numbers;
  if (!setup.fluid || !setup.time) return numbers;
  const double rho = setup.fluid->density, mu = setup.fluid->viscosity, end = setup.time->end;
  const auto openings = openings_of(setup);
  const bool driven = is_driven_by_pressures(setup);
  const double length = driven ? extent_of(*scene.fluid) : 0, load = largest_load(setup);
  for (const auto& boundary : scene.fluid->open_boundaries()) {
    const auto opening =
        std::find_if(openings.begin(), openings.end(), [&](const auto& o) { return o.surface == boundary.name(); });
    if (boundary.empty() || opening == openings.end()) continue;
    const PressureTable* table = opening->flow_rate ? &opening->flow_rate->table : nullptr;
    if (!table && !(driven && opening->pressure)) continue;
    const double area = boundary.area();
    OpeningFlow flow;
    flow.surface = boundary.name();
    flow.diameter = setup.geometry == Geometry::plane ? area : 2 * std::sqrt(area / pi);
    if (!table) flow.drive = {load, length, end, rho, mu};
    flow.velocity = table ? largest_magnitude(*table, end) / area : driven_velocity(*flow.drive, flow.diameter);
    flow.reynolds = rho * flow.velocity * flow.diameter / mu;
    const double period = table ? table->period : opening->pressure->period;
    if (period > 0) flow.womersley = flow.diameter / 2 * std::sqrt(2 * pi * rho / (period * mu));
    numbers.flows.push_back(flow);
  }
  if (!scene.coupled()) return numbers;
  numbers.wave_speed = wave_speed(scene);
  numbers.load = load;
  numbers.strain = load / (2 * rho * numbers.wave_speed * numbers.wave_speed);
  for (const auto& layer : scene.wall->layer_data()) numbers.stiffens = numbers.stiffens || has_fibres(layer.material);
  return numbers;
}

void describe_numbers(const DerivedNumbers& numbers, Description& lines) {
  for (const auto& flow : numbers.flows) lines.push_back({"flow through " + flow.surface, text_of(flow)});
  if (numbers.wave_speed == 0) return;
  std::string text = fmt::format("long pressure waves travel at {:.3g} m/s", numbers.wave_speed);
  if (numbers.load > 0)
    text += fmt::format("; {:.3g} kPa at rest would strain it by {:.3g}, by its moduli at small strain{}", numbers.load,
                        numbers.strain, numbers.stiffens ? ", without the stiffening of fibres" : "");
  lines.push_back({"vessel", text});
}

std::string text_of_numbers(const DerivedNumbers& numbers) {
  Description lines;
  describe_numbers(numbers, lines);
  std::vector<std::string> texts;
  for (const auto& line : lines) texts.push_back(line.head + ": " + line.text);
  return fmt::format("{}", fmt::join(texts, "; "));
}

std::vector<std::string> implausible_numbers(const DerivedNumbers& numbers) {
  std::vector<std::string> warnings;
  for (std::size_t k = 0; k < numbers.flows.size(); ++k) {
    const std::string fault = fault_of(numbers.flows[k], numbers.wave_speed);
    if (fault.empty()) continue;
    const auto usual = [k](const DerivedNumbers& then) { return is_usual(then.flows[k], then.wave_speed); };
    warnings.push_back(fmt::format("flow through {}: {}: no vessel has such a flow{}", numbers.flows[k].surface, fault,
                                   explanation(numbers, usual)));
  }
  if (numbers.strain > (numbers.stiffens ? largest_strain_of_fibres : largest_strain))
    warnings.push_back(
        fmt::format("the load of {:.3g} kPa would strain the vessel by {:.3g} at rest, by its moduli at small strain{}",
                    numbers.load, numbers.strain,
                    explanation(numbers, [](const auto& then) { return then.strain <= usual_strain; })));
  return warnings;
}

#define FSI_INSTANTIATE(n) template DerivedNumbers derived_numbers<n>(const Case&, const Scene<n>&);
FSI_FOR_EACH_DIMENSION(FSI_INSTANTIATE)
#undef FSI_INSTANTIATE

}  // namespace fsi
