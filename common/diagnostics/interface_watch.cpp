#include "diagnostics/interface_watch.hpp"

#include <algorithm>
#include <cmath>

#include "fem/dimensions.hpp"

namespace fsi {

template <int n>
void InterfaceWatch<n>::begin(const State& level) {
  if (!start_.empty()) return;  // recalled
  for (const InterfaceNode& node : scene_.interface)
    for (int k = 0; k < n; ++k) start_.push_back(level.before[0].wall[Mixed::vector(node.wall, k)]);
}

template <int n>
void InterfaceWatch<n>::follow(const State& level, const std::vector<Balance>& balances) {
  for (const Balance& balance : balances) {
    const StepRates& rates = balance.data.rates;
    const double duration = (rates.weight + rates.previous_weight) * rates.step;
    for (std::size_t i = 0; i < slip_.size(); ++i) {
      const InterfaceNode& node = scene_.interface[i / n];
      const std::size_t w = Mixed::vector(node.wall, static_cast<int>(i % n));
      const double v = rates.interface.velocity(balance.at.wall[w], rates.wall_reference[w]);
      slip_[i] += duration * (balance.at.fluid[Mixed::vector(node.fluid, static_cast<int>(i % n))] - v);
    }
  }
  std::vector<double> gap(slip_.size()), moved(slip_.size());
  for (std::size_t i = 0; i < gap.size(); ++i) {
    const InterfaceNode& node = scene_.interface[i / n];
    const double d = level.before[0].wall[Mixed::vector(node.wall, static_cast<int>(i % n))];
    gap[i] = level.before[0].mesh[Vector::vector(node.fluid, static_cast<int>(i % n))] - d;
    moved[i] = start_.empty() ? 0 : d - start_[i];
  }
  separation_ = std::max(separation_, largest(gap));
  motion_ = std::max(motion_, largest(moved));
}

template <int n>
void InterfaceWatch<n>::weigh(const Balance& balance) {
  scene_.assemble_fluid(balance.at, balance.data, fluid_rows_);
  scene_.wall->assemble(scene_.wall_input(balance.at, balance.data), balance.data.wall_pressure, balance.at.wall,
                        wall_rows_);
  // Copies of a wall's node share its vector and have a part of its force each.
  const PartNodes& wall = scene_.wall->nodes();
  for (int a = 0; a < wall.node_count(); ++a)
    if (const int original = wall.original_of(a); original != a)
      for (int k = 0; k < n; ++k) wall_rows_[Mixed::vector(original, k)] += wall_rows_[Mixed::vector(a, k)];
  std::vector<double> of_fluid(slip_.size()), unbalanced(slip_.size());
  for (std::size_t i = 0; i < unbalanced.size(); ++i) {
    const InterfaceNode& node = scene_.interface[i / n];
    of_fluid[i] = fluid_rows_[Mixed::vector(node.fluid, static_cast<int>(i % n))];
    unbalanced[i] = of_fluid[i] + wall_rows_[Mixed::vector(node.wall, static_cast<int>(i % n))];
  }
  leave_free(of_fluid);
  leave_free(unbalanced);
  const double duration = balance.data.rates.step;
  for (std::size_t i = 0; i < unbalanced.size(); ++i) unbalanced_[i] += duration * unbalanced[i];
  weighed_ += 1;
  weighed_time_ += duration;
  largest_traction_ = std::max(largest_traction_, root_mean_traction(unbalanced));
  traction_ = std::max(traction_, root_mean_traction(of_fluid));
}

template <int n>
InterfaceAgreement InterfaceWatch<n>::so_far() const {
  InterfaceAgreement found;
  found.slip = root_mean_square(slip_);
  found.largest_slip = largest(slip_);
  found.largest_separation = separation_;
  found.motion = motion_;
  found.lasting_traction = weighed_time_ > 0 ? root_mean_traction(unbalanced_) / weighed_time_ : 0;
  found.largest_traction = largest_traction_;
  found.traction = traction_;
  found.weighed_steps = static_cast<int>(weighed_);
  return found;
}

template <int n>
void InterfaceWatch<n>::keep(RestartArchive& archive) {
  if (!archive.wants({"slip", "start", "unbalanced", "weighed", "weighed_time", "separation", "motion",
                      "largest_traction", "traction"}))
    return;
  archive.array("slip", ArrayKind::interface, slip_);
  archive.array("start", ArrayKind::interface, start_);
  archive.array("unbalanced", ArrayKind::interface, unbalanced_);
  archive.number("weighed", weighed_, count_range);
  for (auto [name, value] :
       {std::pair("weighed_time", &weighed_time_), std::pair("separation", &separation_), std::pair("motion", &motion_),
        std::pair("largest_traction", &largest_traction_), std::pair("traction", &traction_)})
    archive.number(name, *value, {0});
}

template <int n>
double InterfaceWatch<n>::root_mean_square(const std::vector<double>& vectors) const {
  return root_mean(vectors, [](double area) { return area; });
}

template <int n>
double InterfaceWatch<n>::root_mean_traction(const std::vector<double>& forces) const {
  return root_mean(forces, [](double area) { return 1 / area; });
}

template <int n>
template <class Weight>
double InterfaceWatch<n>::root_mean(const std::vector<double>& vectors, Weight weight) const {
  std::vector<double> sums(2, 0.0);
  for (std::size_t i = 0; i < scene_.owned_interface(); ++i) {
    const double area = scene_.interface_areas[i];
    if (!(area > 0)) continue;
    double square = 0;
    for (int k = 0; k < n; ++k) square += vectors[i * n + k] * vectors[i * n + k];
    sums[0] += square * weight(area);
    sums[1] += area;
  }
  scene_.processes().sum(sums);
  return sums[1] > 0 ? std::sqrt(sums[0] / sums[1]) : 0;
}

template <int n>
double InterfaceWatch<n>::largest(const std::vector<double>& vectors) const {
  double square = 0;
  for (std::size_t i = 0; i < scene_.owned_interface(); ++i) {
    double sum = 0;
    for (int k = 0; k < n; ++k) sum += vectors[i * n + k] * vectors[i * n + k];
    square = std::max(square, sum);
  }
  return std::sqrt(scene_.processes().largest(square));
}

template <int n>
void InterfaceWatch<n>::leave_free(std::vector<double>& forces) const {
  for (std::size_t i = 0; i < scene_.interface.size(); ++i) {
    const InterfaceNode& node = scene_.interface[i];
    double* force = forces.data() + i * n;
    const auto* axes = scene_.wall_frames.at(node.wall);
    if (axes) NodalFrames<n>::to_frame(*axes, force);
    for (int k = 0; k < n; ++k)
      if (scene_.wall_conditions.fixes(node.wall, k)) force[k] = 0;
    if (axes) NodalFrames<n>::to_space(*axes, force);
  }
}

#define FSI_INSTANTIATE(n) template class InterfaceWatch<n>;
FSI_FOR_EACH_DIMENSION(FSI_INSTANTIATE)
#undef FSI_INSTANTIATE

}  // namespace fsi
