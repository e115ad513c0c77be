#include "observers/field_output.hpp"

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "derived/stress_invariants.hpp"
#include "fem/dimensions.hpp"
#include "fem/nodal_layout.hpp"
#include "time/time_rounding.hpp"

namespace fsi {

namespace {

/// The vectors of a nodal array as vectors of space.
template <class Layout, std::size_t n>
std::vector<double> vectors(const std::vector<double>& from, const std::array<int, n>& axes) {
  const int nodes = static_cast<int>(from.size()) / Layout::entries;
  std::vector<double> to(VectorLayout<3>::size(nodes), 0.0);
  for (int node = 0; node < nodes; ++node)
    for (std::size_t k = 0; k < n; ++k)
      to[VectorLayout<3>::vector(node, axes[k])] = from[Layout::vector(node, static_cast<int>(k))];
  return to;
}

template <class Layout>
std::vector<double> scalars(const std::vector<double>& from) {
  const int nodes = static_cast<int>(from.size()) / Layout::entries;
  std::vector<double> to(static_cast<std::size_t>(nodes));
  for (int node = 0; node < nodes; ++node) to[node] = from[Layout::scalar(node)];
  return to;
}

/// Values at some nodes, `components` each, as a field that is zero at the others.
std::vector<double> spread(const std::vector<int>& nodes, const std::vector<double>& values, std::size_t components,
                           int node_count) {
  std::vector<double> field(static_cast<std::size_t>(node_count) * components, 0.0);
  for (std::size_t i = 0; i < nodes.size(); ++i)
    for (std::size_t k = 0; k < components; ++k)
      field[static_cast<std::size_t>(nodes[i]) * components + k] = values[i * components + k];
  return field;
}

/// A level as fields see it. Quantities that several fields need are computed once, on first use.
template <int n>
class Level {
 public:
  Level(const State& of, const Scene<n>& scene, const DerivedQuantities<n>& derived)
      : state(of), axes(scene.axes), constants(scene.wall_constants), derived_(derived), profile_(scene.profile) {}

  const State& state;
  const std::array<int, n>& axes;
  const std::map<std::string, std::vector<double>>& constants;

  std::vector<double> shear() const {
    const auto phase = profile_.phase("wall shear stress");
    return spread(derived_.shear->nodes(), derived_.shear->at_nodes(state.now), 3, fluid_nodes());
  }
  /// Zero before the first period has ended.
  std::vector<double> statistics(std::vector<double> ShearStatistics::*which) const {
    const auto& nodes = derived_.shear->nodes();
    const auto& last = derived_.statistics->last();
    return spread(nodes, last ? (*last).*which : std::vector<double>(nodes.size(), 0.0), 1, fluid_nodes());
  }
  const std::vector<double>& thickness() const { return derived_.thickness; }
  const WallStresses& stresses() const {
    if (!stresses_) {
      const auto phase = profile_.phase("wall stress");
      stresses_ = derived_.stress->of(state.now.wall);
    }
    return *stresses_;
  }
  /// The error indicator of a medium's cells: at this level, or its mean up to here.
  const CellErrors& errors(bool fluid, bool mean) const {
    auto& found = errors_[fluid ? 0 : 1][mean ? 0 : 1];
    if (found) return *found;
    const auto& medium = fluid ? derived_.fluid_errors : derived_.wall_errors;
    if (mean) return found.emplace(medium.mean->mean(medium.indicator->cells()));
    const auto phase = profile_.phase("error indicator");
    return found.emplace(medium.indicator->of_cells(fluid ? state.now.fluid : state.now.wall));
  }
  /// make(stress of a node) appends its numbers to a field.
  template <class Make>
  std::vector<double> of_stresses(Make make) const {
    std::vector<double> field;
    for (const auto& stress : stresses().cauchy) make(stress, field);
    return field;
  }

 private:
  int fluid_nodes() const { return static_cast<int>(state.now.fluid.size()) / MixedLayout<n>::entries; }

  const DerivedQuantities<n>& derived_;
  Profile& profile_;
  mutable std::optional<WallStresses> stresses_;
  mutable std::array<std::array<std::optional<CellErrors>, 2>, 2> errors_;
};

/// What decides which fields a grid has.
struct GridFacts {
  bool fluid, moves, flows, fibres, thickness, statistics, errors, mean_errors;
  const std::map<std::string, std::vector<double>>& constants;  ///< of the wall that vary
};

/// Where a field has values. Vertices: it is linear between them. Layers: at nodes, with a value per layer at mid-edge
/// nodes between layers with vertices of their own.
enum class Place { nodes, vertices, layers, cells };

/// A field of fields.h5: the name in output.fields that asks for it, which grids have it, and its values.
template <int n>
struct OutputField {
  std::string_view name;
  std::string_view asked_by;  ///< empty: by a key of its own, output.statistics or output.error_indicator
  int components;
  const char* unit;
  Place at;
  bool (*exists)(const GridFacts& grid);
  std::vector<double> (*values)(const Level<n>& level, bool fluid);
};

constexpr bool in_fluid(const GridFacts& grid) {
  return grid.fluid;
}
constexpr bool in_wall(const GridFacts& grid) {
  return !grid.fluid;
}
constexpr bool in_fibres(const GridFacts& grid) {
  return !grid.fluid && grid.fibres;
}
constexpr bool in_statistics(const GridFacts& grid) {
  return grid.fluid && grid.statistics;
}

constexpr bool in_fluid_errors(const GridFacts& grid) {
  return grid.fluid && grid.errors;
}
constexpr bool in_wall_errors(const GridFacts& grid) {
  return !grid.fluid && grid.errors;
}

/// Constants that are fields where they are not the same in the whole wall, and their units.
constexpr std::array<std::pair<std::string_view, const char*>, 17> constants_of_walls{{{"c10", "kPa"},
                                                                                       {"c01", "kPa"},
                                                                                       {"k1", "kPa"},
                                                                                       {"k2", "1"},
                                                                                       {"alpha", "degrees"},
                                                                                       {"fibre_scale", "1"},
                                                                                       {"kappa", "1"},
                                                                                       {"young", "kPa"},
                                                                                       {"poisson", "1"},
                                                                                       {"lame_lambda", "kPa"},
                                                                                       {"lame_mu", "kPa"},
                                                                                       {"bulk_modulus", "kPa"},
                                                                                       {"viscosity", "kPa ms"},
                                                                                       {"c20", "kPa"},
                                                                                       {"c30", "kPa"},
                                                                                       {"k1_second", "kPa"},
                                                                                       {"k2_second", "1"}}};
template <int n, std::size_t k>
constexpr OutputField<n> constant_field() {
  return {constants_of_walls[k].first,
          "constants",
          1,
          constants_of_walls[k].second,
          Place::cells,
          [](const GridFacts& grid) {
            return !grid.fluid && grid.constants.count(std::string(constants_of_walls[k].first)) > 0;
          },
          [](const Level<n>& level, bool) { return level.constants.at(std::string(constants_of_walls[k].first)); }};
}

template <int n>
constexpr std::array<OutputField<n>, 19 + constants_of_walls.size()> output_fields{
    {{"displacement", "displacement", 3, "mm", Place::nodes, [](const GridFacts& grid) { return grid.moves; },
      [](const Level<n>& level, bool fluid) {
        return fluid ? vectors<VectorLayout<n>>(level.state.now.mesh, level.axes)
                     : vectors<MixedLayout<n>>(level.state.now.wall, level.axes);
      }},
     {"velocity", "velocity", 3, "mm/ms", Place::nodes, [](const GridFacts& grid) { return grid.flows; },
      [](const Level<n>& level, bool fluid) {
        return fluid ? vectors<MixedLayout<n>>(level.state.now.fluid, level.axes)
                     : vectors<VectorLayout<n>>(level.state.wall_velocity, level.axes);
      }},
     {"pressure", "pressure", 1, "kPa", Place::vertices, [](const GridFacts&) { return true; },
      [](const Level<n>& level, bool fluid) {
        return scalars<MixedLayout<n>>(fluid ? level.state.now.fluid : level.state.now.wall);
      }},
     {"wall_shear_stress", "wall_shear_stress", 3, "kPa", Place::nodes, in_fluid,
      [](const Level<n>& level, bool) { return level.shear(); }},
     {"cauchy_stress", "cauchy_stress", 6, "kPa", Place::layers, in_wall,
      [](const Level<n>& level, bool) {
        return level.of_stresses([](const Mat3<double>& s, std::vector<double>& field) {
          for (int i = 0; i < 3; ++i)
            for (int j = i; j < 3; ++j) field.push_back(s(i, j));
        });
      }},
     {"principal_stress", "principal_stress", 3, "kPa", Place::layers, in_wall,
      [](const Level<n>& level, bool) {
        return level.of_stresses([](const Mat3<double>& s, std::vector<double>& field) {
          for (const double value : principal_stresses(s)) field.push_back(value);
        });
      }},
     {"von_mises_stress", "von_mises_stress", 1, "kPa", Place::layers, in_wall,
      [](const Level<n>& level, bool) {
        return level.of_stresses(
            [](const Mat3<double>& s, std::vector<double>& field) { field.push_back(von_mises_stress(s)); });
      }},
     {"fibre_stress_1", "fibre_stress", 1, "kPa", Place::layers, in_fibres,
      [](const Level<n>& level, bool) { return level.stresses().of_fibres[0]; }},
     {"fibre_stress_2", "fibre_stress", 1, "kPa", Place::layers, in_fibres,
      [](const Level<n>& level, bool) { return level.stresses().of_fibres[1]; }},
     {"thickness", "thickness", 1, "mm", Place::nodes,
      [](const GridFacts& grid) { return !grid.fluid && grid.thickness; },
      [](const Level<n>& level, bool) { return level.thickness(); }},
     {"tawss", "", 1, "kPa", Place::nodes, in_statistics,
      [](const Level<n>& level, bool) { return level.statistics(&ShearStatistics::mean); }},
     {"osi", "", 1, "1", Place::nodes, in_statistics,
      [](const Level<n>& level, bool) { return level.statistics(&ShearStatistics::oscillation); }},
     {"rrt", "", 1, "1/kPa", Place::nodes, in_statistics,
      [](const Level<n>& level, bool) { return level.statistics(&ShearStatistics::residence); }},
     {"velocity_error", "", 1, "mm/ms", Place::cells, in_fluid_errors,
      [](const Level<n>& level, bool fluid) { return level.errors(fluid, false).vectors; }},
     {"velocity_error_mean", "", 1, "mm/ms", Place::cells,
      [](const GridFacts& grid) { return in_fluid_errors(grid) && grid.mean_errors; },
      [](const Level<n>& level, bool fluid) { return level.errors(fluid, true).vectors; }},
     {"displacement_error", "", 1, "mm", Place::cells, in_wall_errors,
      [](const Level<n>& level, bool fluid) { return level.errors(fluid, false).vectors; }},
     {"displacement_error_mean", "", 1, "mm", Place::cells,
      [](const GridFacts& grid) { return in_wall_errors(grid) && grid.mean_errors; },
      [](const Level<n>& level, bool fluid) { return level.errors(fluid, true).vectors; }},
     {"pressure_error", "", 1, "kPa", Place::cells, [](const GridFacts& grid) { return grid.errors; },
      [](const Level<n>& level, bool fluid) { return level.errors(fluid, false).pressure; }},
     {"pressure_error_mean", "", 1, "kPa", Place::cells,
      [](const GridFacts& grid) { return grid.errors && grid.mean_errors; },
      [](const Level<n>& level, bool fluid) { return level.errors(fluid, true).pressure; }},
     constant_field<n, 0>(),
     constant_field<n, 1>(),
     constant_field<n, 2>(),
     constant_field<n, 3>(),
     constant_field<n, 4>(),
     constant_field<n, 5>(),
     constant_field<n, 6>(),
     constant_field<n, 7>(),
     constant_field<n, 8>(),
     constant_field<n, 9>(),
     constant_field<n, 10>(),
     constant_field<n, 11>(),
     constant_field<n, 12>(),
     constant_field<n, 13>(),
     constant_field<n, 14>(),
     constant_field<n, 15>(),
     constant_field<n, 16>()}};

/// Whether every name of output.fields asks for a field, and every field is asked for by one of these names or none.
template <int n>
constexpr bool all_asked_for() {
  for (const auto name : output_field_list) {
    bool found = false;
    for (const auto& field : output_fields<n>) found = found || field.asked_by == name;
    if (!found) return false;
  }
  for (const auto& field : output_fields<n>) {
    bool found = field.asked_by.empty();
    for (const auto name : output_field_list) found = found || field.asked_by == name;
    if (!found) return false;
  }
  return true;
}
static_assert(all_asked_for<3>(), "case/choices.hpp owns these names");

/// Planned steps that end at these times, ascending.
std::vector<std::int64_t> steps_at(const std::vector<double>& times, const TimeAxis& axis) {
  std::vector<std::int64_t> steps;
  for (const double time : times) {
    const double early = time * (1 - time_rounding);
    const auto step = first_that(
        axis.planned_steps(), [&](std::int64_t i) { return axis.planned_time_of(static_cast<int>(i) + 1) >= early; });
    if (step < axis.planned_steps()) steps.push_back(step + 1);
  }
  return steps;
}

}  // namespace

template <int n>
std::vector<std::vector<FieldDescription>> wanted_fields(const Case& setup, const Scene<n>& scene,
                                                         const DerivedQuantities<n>& derived,
                                                         const std::vector<FieldGrid>& grids) {
  const auto& wanted = setup.output.fields;
  const bool thickness = scene.processes().any(!derived.thickness.empty());
  std::vector<std::vector<FieldDescription>> found;
  for (const FieldGrid& grid : grids) {
    const bool fluid = grid.name == "fluid";
    const GridFacts facts{fluid,
                          !fluid || scene.coupled(),
                          fluid || !scene.is_static(),
                          derived.stress && derived.stress->has_fibres(),
                          thickness,
                          derived.statistics.has_value(),
                          derived.has_errors(),
                          derived.means_errors(),
                          scene.wall_constants};
    auto& of_grid = found.emplace_back();
    for (const auto& field : output_fields<n>)
      if ((field.asked_by.empty() || std::find(wanted.begin(), wanted.end(), field.asked_by) != wanted.end()) &&
          field.exists(facts))
        of_grid.push_back({std::string(field.name), field.components, field.unit, field.at == Place::cells});
  }
  return found;
}

template <int n>
std::vector<std::string> unmet_fields(const Case& setup, const std::vector<std::vector<FieldDescription>>& found) {
  const auto is_there = [&](std::string_view name) {
    return std::any_of(found.begin(), found.end(), [&](const auto& of_grid) {
      return std::any_of(of_grid.begin(), of_grid.end(), [&](const auto& field) { return field.name == name; });
    });
  };
  std::vector<std::string> unmet;
  for (const auto& name : setup.output.fields)
    if (!contains(standard_output_fields(), name) &&
        std::none_of(output_fields<n>.begin(), output_fields<n>.end(),
                     [&](const auto& field) { return field.asked_by == name && is_there(field.name); }))
      unmet.push_back(name);
  return unmet;
}

template <int n>
FieldOutput<n>::FieldOutput(const Case& setup, const Scene<n>& scene, const DerivedQuantities<n>& derived,
                            std::vector<FieldGrid> grids, std::vector<GridShare> shares, const TimeAxis& axis,
                            const std::filesystem::path& folder, const std::filesystem::path& restarted_from,
                            double until)
    : scene_(scene), derived_(derived) {
  if (setup.output.every == 0 || (setup.output.fields.empty() && !derived.statistics && !derived.has_errors())) return;
  assert(shares.empty() || shares.size() == grids.size());
  auto wanted = wanted_fields(setup, scene, derived, grids);
  for (std::size_t g = 0; g < grids.size(); ++g) {
    FieldGrid& grid = grids[g];
    const bool fluid = grid.name == "fluid";
    grid.fields = std::move(wanted[g]);
    if (grid.fields.empty()) continue;
    grids_.push_back(std::move(grid));
    if (shares.empty())
      made_.push_back({nullptr, separate_middles<n>(grids_.back()), {}});
    else
      made_.push_back({(fluid ? scene.fluid->nodes() : scene.wall->nodes()).share.get(), std::move(shares[g].middles),
                       std::move(shares[g].order)});
  }
  if (grids_.empty()) return;
  FieldPlan planned;
  if (auto times = output_times(setup); !times.empty())
    planned = {static_cast<std::int64_t>(times.size()), [times = std::move(times)](std::int64_t entry) {
                 return FieldStep{entry, times.at(static_cast<std::size_t>(entry))};
               }};
  else
    planned = planned_field_steps(
        axis.planned_steps(), setup.output.every,
        [&axis](std::int64_t step) { return axis.planned_time_of(static_cast<int>(step)); },
        steps_at(further_output_times(setup), axis));
  if (restarted_from.empty())
    writer_ = std::make_unique<FieldsWriter>(folder, grids_, planned, scene.processes());
  else
    writer_ = std::make_unique<FieldsWriter>(folder, grids_, planned, restarted_from, until, scene.processes());
}

template <int n>
bool FieldOutput<n>::write(const State& state) {
  if (!writer_) return false;
  const auto entry = writer_->entry_at(state.time);
  if (!entry) return false;
  const Level<n> level(state, scene_, derived_);
  FieldValues values;
  for (std::size_t g = 0; g < grids_.size(); ++g)
    for (const auto& field : grids_[g].fields)
      for (const auto& known : output_fields<n>) {
        if (known.name != field.name) continue;
        const bool fluid = grids_[g].name == "fluid";
        auto numbers = known.values(level, fluid);
        if (field.of_cells) {
          const auto* order = known.asked_by == "constants"
                                  ? (scene_.wall_cell_order ? &*scene_.wall_cell_order : nullptr)
                                  : (fluid ? derived_.fluid_errors : derived_.wall_errors).indicator->order();
          if (order) numbers = order->to_stretches(numbers.data(), 1);
          values[{grids_[g].name, field.name}] = std::move(numbers);
          continue;
        }
        const auto components = static_cast<std::size_t>(field.components);
        const Grid& made = made_[g];
        const bool has_middles = grids_[g].nodes_per_cell > n + 1;  // of the whole grid: all processes agree
        if (made.share && has_middles) made.share->exchange.update(numbers, field.components);
        const std::vector<double> found = numbers;
        numbers.resize((made.order ? made.order->items() : grids_[g].points.size()) * components);
        for (const Middle& middle : made.middles) {
          const int place =
              known.at == Place::layers ? derived_.stress->place_of_middle(middle.node, middle.ends) : middle.node;
          for (std::size_t k = 0; k < components; ++k) {
            const auto at = [&](int point) { return found[static_cast<std::size_t>(point) * components + k]; };
            numbers[static_cast<std::size_t>(middle.point) * components + k] =
                known.at == Place::vertices ? 0.5 * (at(middle.ends[0]) + at(middle.ends[1])) : at(place);
          }
        }
        if (made.order) numbers = made.order->to_stretches(numbers.data(), field.components);
        values[{grids_[g].name, field.name}] = std::move(numbers);
      }
  writer_->write(*entry, values);
  return true;
}

#define FSI_INSTANTIATE(n)                                                                                           \
  template std::vector<std::vector<FieldDescription>> wanted_fields(                                                 \
      const Case&, const Scene<n>&, const DerivedQuantities<n>&, const std::vector<FieldGrid>&);                     \
  template std::vector<std::string> unmet_fields<n>(const Case&, const std::vector<std::vector<FieldDescription>>&); \
  template class FieldOutput<n>;
FSI_FOR_EACH_DIMENSION(FSI_INSTANTIATE)

}  // namespace fsi
