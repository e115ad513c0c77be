#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "network/complete_pivoting.hpp"
#include "network/network_element.hpp"

namespace fsi {

/// Pressures and flows of a network at one time.
struct NetworkState {
  std::vector<double> pressures;  ///< of nodes, kPa
  std::vector<double> flows;      ///< of elements from their first end to their second, mm^3/ms
  bool settled = true;            ///< false: the iteration of a valve did not converge; pressures and flows are void
  std::size_t unsettled = 0;      ///< number of that valve's element
};

/// Lumped elements between nodes (docs/theory.md, section 3.10). The unknowns are the pressures of nodes and the flows
/// of elements; the equations are
///   sum of the flows that leave a node = what enters it from outside (Kirchhoff), and that of each element.
/// Some nodes are openings of a vessel, and what leaves the vessel there enters from outside: the network gives their
/// pressures as a function of all these flows Q, p = F(Q), with its derivatives. Elements keep numbers y that time
/// schemes integrate. Units: kPa, mm^3/ms, ms, mm^3.
class Network {
 public:
  static constexpr int ground = -1;  ///< in place of a node's number

  struct Element {
    std::string name;
    std::shared_ptr<const NetworkElement> law;
    int from, to;  ///< nodes
  };

  /// \param nodes     their names; the first `openings` are openings, in their order
  /// \param elements  join them
  /// \param ground_pressure  kPa
  Network(std::vector<std::string> nodes, std::size_t openings, std::vector<Element> elements, double ground_pressure);

  const std::vector<std::string>& nodes() const { return nodes_; }
  std::size_t openings() const { return openings_; }
  const std::vector<Element>& elements() const { return elements_; }

  /// How many numbers elements keep, in their order.
  std::size_t size() const { return size_; }
  /// These at the start.
  std::vector<double> start() const;
  /// y at a balance, from its solution. \param reference  r, size() numbers
  std::vector<double> kept(const NetworkMoment& at, const double* reference, const NetworkState& state) const;
  /// dy/dt.
  std::vector<double> rates(const NetworkState& state) const;
  /// Stored between nodes and the ground, mm^3. What lies between two nodes takes from one what it gives to the other.
  /// \param kept  y
  double volume(const double* kept) const;

  /// Pressures and flows. \param reference  r, size() numbers; y itself where at.lag = 0
  /// \param inflows  Q into the nodes that are openings, mm^3/ms
  NetworkState solve(const NetworkMoment& at, const double* reference, const std::vector<double>& inflows) const;
  /// At a finished level, from what elements keep. Where that does not determine the pressure at an opening, since only
  /// inertances lie behind, it is the one given. \param pressures  of the fluid at openings, kPa
  NetworkState at_level(double time, const double* kept, const std::vector<double>& inflows,
                        const std::vector<double>& pressures) const;
  /// dF_i/dQ_j of a solution, openings() numbers a row, kPa ms/mm^3.
  std::vector<double> slopes(const NetworkMoment& at, const double* reference, const NetworkState& state) const;

  /// dq/d(dp) of each element that switches, mm^3/(kPa ms); 0 of others.
  std::vector<double> conductances(const NetworkMoment& at, const double* reference, const NetworkState& state) const;

  /// The Jacobian of the equations by pressures, then flows; openings' pressures are last in the order of pivots.
  CompletePivoting jacobian(const NetworkMoment& at, const double* reference, const NetworkState& state) const;
  /// How far the initial values contradict each other without flow at openings; 0: not at all. In units of scaled rows
  /// (CompletePivoting::solve): of a node's row mm^3/ms.
  double contradiction_at_start() const;

  /// Of a node, or the ground, kPa.
  double pressure(int node, const NetworkState& state) const {
    return node == ground ? ground_pressure_ : state.pressures[static_cast<std::size_t>(node)];
  }

  /// Whether only elements that keep a volume lead to the ground: the volume of network and vessel together stays.
  bool is_closed() const;
  /// Independent loops, the ground being a node.
  int loops() const;

 private:
  double drop(const Element& element, const NetworkState& state) const {
    return pressure(element.from, state) - pressure(element.to, state);
  }
  std::vector<NetworkElement::Equation> equations(const NetworkMoment& at, const double* reference,
                                                  const NetworkState& state) const;
  /// The left sides less the right ones: of nodes, then of elements.
  std::vector<double> residual(const std::vector<NetworkElement::Equation>& equations, const NetworkState& state,
                               const std::vector<double>& inflows) const;
  CompletePivoting jacobian(const std::vector<NetworkElement::Equation>& equations) const;
  /// Newton's method from a state.
  NetworkState solve_from(NetworkState state, const NetworkMoment& at, const double* reference,
                          const std::vector<double>& inflows) const;
  /// Sum of squares of the valves' residuals, as pressures, kPa^2.
  /// \param worst    set to the valve of the largest \param rounded  set to whether all of it is rounding
  double lack_of_valves(const std::vector<NetworkElement::Equation>& equations, const NetworkState& state,
                        std::size_t& worst, bool& rounded) const;

  std::vector<std::string> nodes_;
  std::size_t openings_;
  std::vector<Element> elements_;
  std::vector<std::size_t> places_;  ///< of what elements keep
  double ground_pressure_;
  std::size_t size_ = 0;
};

}  // namespace fsi
