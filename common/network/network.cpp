#include "network/network.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

namespace fsi {

namespace {

constexpr int most_iterations = 60, most_halvings = 40;
constexpr double rounding_of_valve = 1e-14;  // of a valve's equation, of the terms in it
constexpr double least_decrease = 1e-4;      // of the residual of valves, by a step

double number_of(const double* numbers, std::size_t place, const NetworkElement& law) {
  return law.keeps() == NetworkElement::Keeps::nothing ? 0 : numbers[place];
}

}  // namespace

Network::Network(std::vector<std::string> nodes, std::size_t openings, std::vector<Element> elements,
                 double ground_pressure)
    : nodes_(std::move(nodes)), openings_(openings), elements_(std::move(elements)), ground_pressure_(ground_pressure) {
  for (const Element& element : elements_) {
    places_.push_back(size_);
    if (element.law->keeps() != NetworkElement::Keeps::nothing) ++size_;
  }
}

std::vector<double> Network::start() const {
  std::vector<double> y;
  for (const Element& element : elements_)
    if (element.law->keeps() != NetworkElement::Keeps::nothing) y.push_back(element.law->start());
  return y;
}

std::vector<double> Network::kept(const NetworkMoment& at, const double* reference, const NetworkState& state) const {
  std::vector<double> y(size_);
  for (std::size_t e = 0; e < elements_.size(); ++e)
    if (const auto& law = *elements_[e].law; law.keeps() != NetworkElement::Keeps::nothing)
      y[places_[e]] = law.kept(at, reference[places_[e]], drop(elements_[e], state), state.flows[e]);
  return y;
}

std::vector<double> Network::rates(const NetworkState& state) const {
  std::vector<double> rates(size_);
  for (std::size_t e = 0; e < elements_.size(); ++e)
    if (const auto& law = *elements_[e].law; law.keeps() != NetworkElement::Keeps::nothing)
      rates[places_[e]] = law.rate(drop(elements_[e], state), state.flows[e]);
  return rates;
}

double Network::volume(const double* kept) const {
  double sum = 0;
  for (std::size_t e = 0; e < elements_.size(); ++e)
    if (elements_[e].law->keeps() == NetworkElement::Keeps::volume && elements_[e].to == ground)
      sum += kept[places_[e]];
  return sum;
}

std::vector<NetworkElement::Equation> Network::equations(const NetworkMoment& at, const double* reference,
                                                         const NetworkState& state) const {
  std::vector<NetworkElement::Equation> all;
  for (std::size_t e = 0; e < elements_.size(); ++e) {
    const NetworkElement& law = *elements_[e].law;
    all.push_back(law.equation(at, number_of(reference, places_[e], law), drop(elements_[e], state), state.flows[e]));
  }
  return all;
}

std::vector<double> Network::residual(const std::vector<NetworkElement::Equation>& equations, const NetworkState& state,
                                      const std::vector<double>& inflows) const {
  const std::size_t count = nodes_.size();
  std::vector<double> residual(count + elements_.size(), 0.0);
  for (std::size_t i = 0; i < openings_; ++i) residual[i] = -inflows[i];
  for (std::size_t e = 0; e < elements_.size(); ++e) {
    const Element& element = elements_[e];
    if (element.from != ground) residual[static_cast<std::size_t>(element.from)] += state.flows[e];
    if (element.to != ground) residual[static_cast<std::size_t>(element.to)] -= state.flows[e];
    residual[count + e] = equations[e].value;
  }
  return residual;
}

CompletePivoting Network::jacobian(const std::vector<NetworkElement::Equation>& equations) const {
  const std::size_t count = nodes_.size(), size = count + elements_.size();
  std::vector<double> matrix(size * size, 0.0);
  std::vector<bool> last(size, false);
  std::fill_n(last.begin(), openings_, true);
  for (std::size_t e = 0; e < elements_.size(); ++e) {
    const std::size_t row = count + e;
    matrix[row * size + row] = equations[e].by_flow;
    const auto join = [&](int node, double sign) {
      if (node == ground) return;
      const auto i = static_cast<std::size_t>(node);
      matrix[i * size + row] += sign;
      matrix[row * size + i] += sign * equations[e].by_drop;
    };
    join(elements_[e].from, 1);
    join(elements_[e].to, -1);
  }
  return {std::move(matrix), size, last};
}

CompletePivoting Network::jacobian(const NetworkMoment& at, const double* reference, const NetworkState& state) const {
  return jacobian(equations(at, reference, state));
}

double Network::lack_of_valves(const std::vector<NetworkElement::Equation>& equations, const NetworkState& state,
                               std::size_t& worst, bool& rounded) const {
  double sum = 0, largest = -1;
  rounded = true;
  for (std::size_t e = 0; e < elements_.size(); ++e) {
    const Element& element = elements_[e];
    if (!element.law->switches()) continue;
    const double resistance = element.law->resistance_of_residual();
    const double imbalance = resistance * std::abs(equations[e].value);
    const double pressures = std::abs(pressure(element.from, state)) + std::abs(pressure(element.to, state));
    const double terms = std::abs(state.flows[e]) + std::abs(equations[e].by_drop) * pressures;
    sum += imbalance * imbalance;
    rounded = rounded && std::abs(equations[e].value) <= rounding_of_valve * terms;
    if (imbalance > largest) {
      largest = imbalance;
      worst = e;
    }
  }
  return sum;
}

NetworkState Network::solve_from(NetworkState state, const NetworkMoment& at, const double* reference,
                                 const std::vector<double>& inflows) const {
  const auto moved = [&](const std::vector<double>& by, double step) {
    NetworkState there = state;
    for (std::size_t i = 0; i < nodes_.size(); ++i) there.pressures[i] -= step * by[i];
    for (std::size_t e = 0; e < elements_.size(); ++e) there.flows[e] -= step * by[nodes_.size() + e];
    return there;
  };
  auto now = equations(at, reference, state);
  std::vector<double> increment;
  bool rounded = true;
  double imbalance = 0;
  for (int k = 0; k < most_iterations; ++k) {
    jacobian(now).solve(residual(now, state, inflows), increment);
    // After the first step all equations but those of valves hold. These alone say then how long a step may be.
    double step = 1;
    NetworkState next = moved(increment, step);
    auto equations_there = equations(at, reference, next);
    std::size_t worst = 0;
    double imbalance_there = lack_of_valves(equations_there, next, worst, rounded);
    for (int halvings = 0; k > 0 && !rounded && !(imbalance_there <= (1 - least_decrease * step) * imbalance);
         ++halvings) {
      if (halvings == most_halvings) {
        state.settled = false;
        state.unsettled = worst;
        return state;
      }
      step *= 0.5;
      next = moved(increment, step);
      equations_there = equations(at, reference, next);
      imbalance_there = lack_of_valves(equations_there, next, worst, rounded);
    }
    state = std::move(next);
    state.unsettled = worst;
    now = std::move(equations_there);
    imbalance = imbalance_there;
    if (rounded && step == 1) return state;
  }
  state.settled = false;
  return state;
}

NetworkState Network::solve(const NetworkMoment& at, const double* reference,
                            const std::vector<double>& inflows) const {
  assert(inflows.size() == openings_);
  NetworkState state;
  state.pressures.assign(nodes_.size(), ground_pressure_);
  state.flows.assign(elements_.size(), 0.0);
  return solve_from(std::move(state), at, reference, inflows);
}

NetworkState Network::at_level(double time, const double* kept, const std::vector<double>& inflows,
                               const std::vector<double>& pressures) const {
  assert(inflows.size() == openings_ && pressures.size() == openings_);
  NetworkState state;
  state.pressures.assign(nodes_.size(), ground_pressure_);
  std::copy(pressures.begin(), pressures.end(), state.pressures.begin());
  state.flows.assign(elements_.size(), 0.0);
  return solve_from(std::move(state), {0, time}, kept, inflows);
}

std::vector<double> Network::slopes(const NetworkMoment& at, const double* reference, const NetworkState& state) const {
  const CompletePivoting factors = jacobian(at, reference, state);
  std::vector<double> slopes(openings_ * openings_), right(nodes_.size() + elements_.size(), 0.0), answer;
  for (std::size_t j = 0; j < openings_; ++j) {
    right[j] = 1;
    factors.solve(right, answer);
    right[j] = 0;
    for (std::size_t i = 0; i < openings_; ++i) slopes[i * openings_ + j] = answer[i];
  }
  return slopes;
}

std::vector<double> Network::conductances(const NetworkMoment& at, const double* reference,
                                          const NetworkState& state) const {
  const auto all = equations(at, reference, state);
  std::vector<double> conductances(all.size(), 0.0);
  for (std::size_t e = 0; e < all.size(); ++e)
    if (elements_[e].law->switches()) conductances[e] = -all[e].by_drop / all[e].by_flow;
  return conductances;
}

double Network::contradiction_at_start() const {
  const std::vector<double> y = start();
  const std::vector<double> zero(openings_, 0.0);
  const NetworkState state = at_level(0, y.data(), zero, zero);
  const NetworkMoment level{0, 0};
  const auto there = equations(level, y.data(), state);
  std::vector<double> unused;
  return jacobian(there).solve(residual(there, state, zero), unused);
}

bool Network::is_closed() const {
  return std::all_of(elements_.begin(), elements_.end(), [](const Element& element) {
    return (element.from != ground && element.to != ground) || element.law->keeps() == NetworkElement::Keeps::volume;
  });
}

int Network::loops() const {
  std::vector<int> part(nodes_.size() + 1);  // the ground is the last
  for (std::size_t i = 0; i < part.size(); ++i) part[i] = static_cast<int>(i);
  const auto place = [&](int node) { return node == ground ? nodes_.size() : static_cast<std::size_t>(node); };
  int loops = 0;
  for (const Element& element : elements_) {
    const int a = part[place(element.from)], b = part[place(element.to)];
    if (a == b) {
      ++loops;
      continue;
    }
    for (int& p : part)
      if (p == b) p = a;
  }
  return loops;
}

}  // namespace fsi
