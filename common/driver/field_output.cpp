#include "driver/field_output.hpp"

#include <algorithm>
#include <string_view>
#include <utility>

#include "fem/dimensions.hpp"
#include "fem/nodal_layout.hpp"
#include "mesh/mid_edge_nodes.hpp"

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

/// A field of output.fields: which grids have it, and its values.
template <int n>
struct OutputField {
  std::string_view name;
  int components;
  const char* unit;
  bool (*exists)(bool moves, bool flows);
  std::vector<double> (*values)(const State& state, bool fluid, const std::array<int, n>& axes);
};

template <int n>
constexpr std::array<OutputField<n>, 3> output_fields{
    {{"displacement", 3, "mm", [](bool moves, bool) { return moves; },
      [](const State& state, bool fluid, const std::array<int, n>& axes) {
        return fluid ? vectors<VectorLayout<n>>(state.now.mesh, axes) : vectors<MixedLayout<n>>(state.now.wall, axes);
      }},
     {"velocity", 3, "mm/ms", [](bool, bool flows) { return flows; },
      [](const State& state, bool fluid, const std::array<int, n>& axes) {
        return fluid ? vectors<MixedLayout<n>>(state.now.fluid, axes)
                     : vectors<VectorLayout<n>>(state.wall_velocity, axes);
      }},
     {"pressure", 1, "kPa", [](bool, bool) { return true; },
      [](const State& state, bool fluid, const std::array<int, n>&) {
        return scalars<MixedLayout<n>>(fluid ? state.now.fluid : state.now.wall);
      }}}};
static_assert(names_match(output_field_list, output_fields<3>), "case/choices.hpp owns these names");

}  // namespace

template <int n>
FieldOutput<n>::FieldOutput(const Case& setup, const Scene<n>& scene, std::vector<FieldGrid> grids,
                            const TimeAxis& axis, const std::filesystem::path& folder,
                            const std::filesystem::path& restarted_from, double until)
    : axes_(scene.axes) {
  if (setup.output.every == 0 || setup.output.fields.empty()) return;
  const auto& wanted = setup.output.fields;
  for (auto& grid : grids) {
    const bool fluid = grid.name == "fluid";
    const bool moves = fluid ? scene.coupled() : true, flows = fluid ? true : !scene.is_static();
    for (const auto& field : output_fields<n>)
      if (std::find(wanted.begin(), wanted.end(), field.name) != wanted.end() && field.exists(moves, flows))
        grid.fields.push_back({std::string(field.name), field.components, field.unit});
    if (!grid.fields.empty()) grids_.push_back(std::move(grid));
  }
  if (grids_.empty()) return;
  for (auto& grid : grids_) middles_.push_back(separate_middles(grid));
  FieldPlan planned;
  if (auto times = output_times(setup); !times.empty())
    planned = {static_cast<std::int64_t>(times.size()), [times = std::move(times)](std::int64_t entry) {
                 return FieldStep{entry, times.at(static_cast<std::size_t>(entry))};
               }};
  else
    planned = planned_field_steps(axis.planned_steps(), setup.output.every,
                                  [&axis](std::int64_t step) { return axis.planned_time_of(static_cast<int>(step)); });
  if (restarted_from.empty())
    writer_ = std::make_unique<FieldsWriter>(folder, grids_, planned);
  else
    writer_ = std::make_unique<FieldsWriter>(folder, grids_, planned, restarted_from, until);
}

template <int n>
bool FieldOutput<n>::write(const State& state) {
  if (!writer_) return false;
  const auto entry = writer_->entry_at(state.time);
  if (!entry) return false;
  FieldValues values;
  for (std::size_t g = 0; g < grids_.size(); ++g)
    for (const auto& field : grids_[g].fields)
      for (const auto& known : output_fields<n>) {
        if (known.name != field.name) continue;
        auto numbers = known.values(state, grids_[g].name == "fluid", axes_);
        const auto components = static_cast<std::size_t>(field.components);
        numbers.resize(grids_[g].points.size() * components);
        for (const Middle& middle : middles_[g])
          if (components == 1)
            numbers[middle.point] = 0.5 * (numbers[middle.ends[0]] + numbers[middle.ends[1]]);
          else
            for (std::size_t k = 0; k < components; ++k)
              numbers[middle.point * components + k] = numbers[middle.node * components + k];
        values[{grids_[g].name, field.name}] = std::move(numbers);
      }
  writer_->write(*entry, values);
  return true;
}

template <int n>
auto FieldOutput<n>::separate_middles(FieldGrid& grid) -> std::vector<Middle> {
  constexpr int dim = n;  // of the cells: triangles have two components, tetrahedra three
  std::vector<Middle> middles;
  if (grid.nodes_per_cell != nodes_of_simplex(dim, 2)) return middles;
  std::vector<std::vector<std::size_t>> at(grid.points.size());  // places in `middles` by node
  for (std::size_t cell = 0; cell < grid.cells.size(); cell += grid.nodes_per_cell)
    for (std::size_t edge = 0; edge < SimplexEdges<dim>::vertices.size(); ++edge) {
      int& point = grid.cells[cell + dim + 1 + edge];
      const auto& [a, b] = SimplexEdges<dim>::vertices[edge];
      const auto [first, second] = std::minmax(grid.cells[cell + a], grid.cells[cell + b]);
      const std::array<int, 2> ends{first, second};
      auto& known = at[point];
      const auto found =
          std::find_if(known.begin(), known.end(), [&](std::size_t k) { return middles[k].ends == ends; });
      if (found != known.end()) {
        point = middles[*found].point;
        continue;
      }
      const int node = point;
      if (!known.empty()) {
        point = static_cast<int>(grid.points.size());
        grid.points.push_back(grid.points[node]);
      }
      known.push_back(middles.size());
      middles.push_back({point, node, ends});
    }
  return middles;
}

#define FSI_INSTANTIATE(n) template class FieldOutput<n>;
FSI_FOR_EACH_DIMENSION(FSI_INSTANTIATE)

}  // namespace fsi
