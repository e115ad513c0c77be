#include "fluid/opening_profile.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <utility>

#include "fem/elements.hpp"
#include "fluid/facet_shapes.hpp"
#include "linear/direct/direct_solver.hpp"

namespace fsi {

namespace {

/// A matrix from its entries, by column and row.
SparseMatrix by_columns(const std::map<std::pair<int, int>, double>& entries, int size) {
  SparseMatrix a;
  a.offsets.assign(static_cast<std::size_t>(size) + 1, 0);
  for (const auto& [place, value] : entries) {
    ++a.offsets[static_cast<std::size_t>(place.first) + 1];
    a.rows.push_back(place.second);
    a.values.push_back(value);
  }
  for (int i = 0; i < size; ++i) a.offsets[static_cast<std::size_t>(i) + 1] += a.offsets[static_cast<std::size_t>(i)];
  return a;
}

}  // namespace

template <class Element>
std::vector<std::complex<double>> developed_flow(const InflowOpening<Element>& opening, const std::vector<int>& nodes,
                                                 std::complex<double> lambda) {
  using Shapes = FacetShapes<Element>;
  const bool complex = lambda.imag() != 0;
  const int parts = complex ? 2 : 1;  // unknowns of a node: real part, imaginary part
  std::vector<int> unknown(nodes.size(), -1);
  int size = 0;
  for (std::size_t i = 0; i < nodes.size(); ++i)
    if (!opening.sticking[nodes[i]]) {
      unknown[i] = size;
      size += parts;
    }
  const auto unknown_of = [&](int node) {
    return unknown[static_cast<std::size_t>(std::lower_bound(nodes.begin(), nodes.end(), node) - nodes.begin())];
  };

  std::map<std::pair<int, int>, double> entries;
  std::vector<double> right(static_cast<std::size_t>(size), 0.0), solution;
  for (const auto& facet : opening.facets) {
    typename Shapes::Positions x;
    std::array<int, Shapes::nodes> at;
    for (int a = 0; a < Shapes::nodes; ++a) {
      x[a] = opening.nodes[facet[a]];
      at[a] = unknown_of(facet[a]);
    }
    for (int q = 0; q < Shapes::points; ++q) {
      const auto gradient = Shapes::gradients(x, q);
      const double area = norm(Shapes::weighted_normal(x, q));
      for (int a = 0; a < Shapes::nodes; ++a) {
        if (at[a] < 0) continue;
        right[static_cast<std::size_t>(at[a])] += area * Shapes::shape(q, a);
        for (int b = 0; b < Shapes::nodes; ++b) {
          if (at[b] < 0) continue;
          const double mass = area * Shapes::shape(q, a) * Shapes::shape(q, b);
          const double real = area * dot(gradient[a], gradient[b]) + lambda.real() * mass;
          for (int part = 0; part < parts; ++part) entries[{at[b] + part, at[a] + part}] += real;
          if (complex) {
            entries[{at[b] + 1, at[a]}] -= lambda.imag() * mass;
            entries[{at[b], at[a] + 1}] += lambda.imag() * mass;
          }
        }
      }
    }
  }
  const OneDenseThread one_thread;  // the bits of the profile must not depend on the number of threads
  const SparseMatrix matrix = by_columns(entries, size);
  DirectSolver solver;
  solver.factorise(matrix);
  solver.solve(matrix, right, solution);

  std::vector<std::complex<double>> w(nodes.size());
  for (std::size_t i = 0; i < nodes.size(); ++i)
    if (const int at = unknown[i]; at >= 0)
      w[i] = {solution[static_cast<std::size_t>(at)], complex ? solution[static_cast<std::size_t>(at) + 1] : 0.0};
  return w;
}

#define FSI_INSTANTIATE(Element)                                                                    \
  template std::vector<std::complex<double>> developed_flow<Element>(const InflowOpening<Element>&, \
                                                                     const std::vector<int>&, std::complex<double>);
FSI_FOR_EACH_ELEMENT(FSI_INSTANTIATE)
#undef FSI_INSTANTIATE

}  // namespace fsi
