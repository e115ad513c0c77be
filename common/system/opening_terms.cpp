#include "system/opening_terms.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "fem/dimensions.hpp"

namespace fsi {

template <int n>
std::unique_ptr<LinearSolver> OpeningTerms<n>::join(const JacobianBlocks<n>& blocks,
                                                    std::unique_ptr<LinearSolver> solver) {
  for (const auto& opening : scene_.openings.answering()) terms_.push_back({&opening.surface->normals()});
  for (const auto& opening : scene_.openings.joined().openings()) terms_.push_back({&opening.surface->normals()});
  given_flows_ = GivenFlows<n>(scene_);
  for (std::size_t i = 0; i < given_flows_.count(); ++i)
    terms_.push_back({&given_flows_.open(i).normals(), 0, nullptr, true, 0});
  if (terms_.empty()) return solver;
  moving_.resize(terms_.size());
  slopes_.assign(scene_.openings.joined().openings().size(), std::vector<double>(terms_.size(), 0.0));
  for (std::size_t i = 0; i < slopes_.size(); ++i) terms_[scene_.openings.answering().size() + i].slopes = &slopes_[i];
  auto with_terms = std::make_unique<LowRankLinearSolver<n>>(blocks, std::move(solver), terms_);
  solver_ = with_terms.get();
  return with_terms;
}

template <int n>
bool OpeningTerms<n>::move() const {
  const auto& open = scene_.fluid->open_boundaries();
  return std::any_of(open.begin(), open.end(), [](const auto& boundary) { return boundary.moving() != nullptr; });
}

template <int n>
std::vector<double> OpeningTerms<n>::gaps() const {
  std::vector<double> gaps;
  for (std::size_t i = 0; i < given_flows_.count(); ++i) gaps.push_back(given_flows_.gap(i));
  return gaps;
}

template <int n>
void OpeningTerms<n>::linearise(const Solution& now, const StepRates& rates, bool of_mesh) {
  const FluidInput in = scene_.fluid_input(now, rates);
  const auto linearise_flow = [&](const MovingSurface<n>& surface, std::size_t place) {
    OpeningTerm& term = terms_[place];
    Moving& moving = moving_[place];
    moving.normals = surface.normals(in.mesh);
    term.normals = &moving.normals;
    if (!of_mesh) return;
    moving.by_mesh = surface.relative_outflow_slope(in);
    term.by_mesh = &moving.by_mesh;
  };
  std::size_t place = 0;
  for (const auto& opening : scene_.openings.answering()) {
    terms_[place].slope = opening.law->slope(in.fluid_factor);
    if (opening.surface->moving()) linearise_flow(*opening.surface->moving(), place);
    ++place;
  }
  linearise_network(in, rates);
  for (const auto& opening : scene_.openings.joined().openings()) {
    if (opening.surface->moving()) linearise_flow(*opening.surface->moving(), place);
    ++place;
  }
  for (std::size_t i = 0; i < given_flows_.count(); ++i) linearise_flow(*given_flows_.open(i).moving(), term_of(i));
}

template <int n>
void OpeningTerms<n>::linearise_network(const FluidInput& in, const StepRates& rates) {
  const auto& joined = scene_.openings.joined();
  if (joined.empty()) return;
  const std::size_t count = joined.openings().size(), first = scene_.openings.answering().size();
  const std::vector<double> slopes = joined.slopes(in, rates.time, rates.openings_reference);
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t j = 0; j < count; ++j) slopes_[i][first + j] = slopes[i * count + j];
}

template <int n>
void OpeningTerms<n>::set_gaps() {
  for (std::size_t i = 0; i < given_flows_.count(); ++i) terms_[term_of(i)].gap = given_flows_.gap(i);
}

template <int n>
void OpeningTerms<n>::close_gaps() {
  for (std::size_t i = 0; i < given_flows_.count(); ++i) terms_[term_of(i)].gap = 0;
}

template <int n>
void OpeningTerms<n>::take_increments() {
  increments_.clear();
  for (std::size_t i = 0; i < given_flows_.count(); ++i) increments_.push_back(-solver_->pressures()[term_of(i)]);
}

template <int n>
void OpeningTerms<n>::add_answers() {
  for (std::size_t i = 0; i < given_flows_.count(); ++i) increments_[i] -= solver_->pressures()[term_of(i)];
}

template <int n>
void OpeningTerms<n>::add_increments(double step, Solution& now) const {
  for (std::size_t i = 0; i < given_flows_.count(); ++i) given_flows_.pressure(i, now) += step * increments_[i];
}

template <int n>
double OpeningTerms<n>::add_absolute_products(const Numbering& numbering, const std::vector<double>& x,
                                              const Solution& now, double fluid_factor,
                                              std::vector<double>& terms) const {
  std::vector<double> flows;
  for (const OpeningTerm& term : terms_) {
    const auto &normals = term.normals, &by_mesh = term.by_mesh;
    double flow = 0;
    for (std::size_t i = 0; by_mesh && i < by_mesh->size(); ++i)
      if (const Unknown& column = numbering.mesh[i]; column.index >= 0)
        flow += std::abs((*by_mesh)[i] * column.factor) * x[column.index];
    for (std::size_t i = 0; i < normals->size(); ++i)
      if (const Unknown& column = numbering.fluid[i]; column.index >= 0)
        flow += std::abs((*normals)[i] * column.factor) * x[column.index];
    flows.push_back(numbering.processes->sum(flow));
  }
  std::size_t given = 0;
  double forces = 0;
  for (std::size_t place = 0; place < terms_.size(); ++place) {
    const OpeningTerm& term = terms_[place];
    double pressure = term.slope * flows[place];
    for (std::size_t j = 0; term.slopes && j < flows.size(); ++j) pressure += std::abs((*term.slopes)[j]) * flows[j];
    if (term.given) {
      pressure = std::abs(given_flows_.pressure(given, now));
      forces += std::pow(given_flows_.force_of_gap(given, fluid_factor) * flows[place], 2);
      ++given;
    }
    const auto& normals = *term.normals;
    for (std::size_t i = 0; i < normals.size(); ++i)
      if (const Unknown& row = numbering.fluid_rows[i]; row.index >= 0)
        terms[row.index] += std::abs(normals[i] * row.factor) * pressure;
  }
  return forces;
}

#define FSI_INSTANTIATE(n) template class OpeningTerms<n>;
FSI_FOR_EACH_DIMENSION(FSI_INSTANTIATE)
#undef FSI_INSTANTIATE

}  // namespace fsi
