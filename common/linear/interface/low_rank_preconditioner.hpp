#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "linear/interface/medium_preconditioner.hpp"

namespace fsi {

/// A pressure by the flows of all terms: by its own alone where there are no slopes by the others.
inline double pressure_by_flows(double slope, const std::vector<double>& slopes, std::size_t own,
                                const std::vector<double>& flows) {
  if (slopes.empty()) return slope * flows[own];
  double pressure = 0;
  for (std::size_t j = 0; j < flows.size(); ++j) pressure += slopes[j] * flows[j];
  return pressure;
}

/// The cycles of A for A + W S V^T, as LowRankLinearSolver solves with it: Y = A^-1 W is known, and what a cycle
/// leaves of z = A^-1 x becomes z - Y (1 + S V^T Y)^-1 S V^T z.
class LowRankPreconditioner : public MediumPreconditioner {
 public:
  /// A term in the unknowns of the system; all must outlive this.
  struct Term {
    double slope;
    const std::vector<double>* slopes;                    ///< by all flows; empty: by its own alone
    const std::vector<double>*rows, *columns, *solution;  ///< w, v, Y
  };

  /// \param inverse  (1 + S V^T Y)^-1, row by row
  LowRankPreconditioner(MediumPreconditioner& medium, const std::vector<Term>& terms, std::vector<double> inverse)
      : medium_(medium),
        terms_(terms),
        inverse_(std::move(inverse)),
        single_(terms.size()),
        flows_(terms.size()),
        pressures_(terms.size()) {
    for (std::size_t i = 0; i < terms_.size(); ++i) {
      const auto gather = [&](const std::vector<double>& of_system, std::vector<float>& x) {
        x.resize(medium_.size());
        medium_.gather(of_system, x);
      };
      gather(*terms_[i].rows, single_[i].rows);
      gather(*terms_[i].columns, single_[i].columns);
      gather(*terms_[i].solution, single_[i].solution);
    }
  }

  std::size_t size() const override { return medium_.size(); }
  int place(int node) const override { return medium_.place(node); }
  void multiply(Input x, Output y) const override {
    medium_.multiply(x, y);
    for (std::size_t i = 0; i < terms_.size(); ++i) flows_[i] = dot(single_[i].columns, x);
    for (std::size_t i = 0; i < terms_.size(); ++i) add(pressure_of(i), single_[i].rows, y);
  }
  void apply(Input x, Output y) override {
    medium_.apply(x, y);
    for (std::size_t i = 0; i < terms_.size(); ++i) flows_[i] = dot(single_[i].columns, y);
    for (std::size_t i = 0; i < terms_.size(); ++i) pressures_[i] = pressure_of(i);
    for (std::size_t i = 0; i < terms_.size(); ++i) {
      double pressure = 0;
      for (std::size_t j = 0; j < terms_.size(); ++j) pressure += inverse_[i * terms_.size() + j] * pressures_[j];
      add(-pressure, single_[i].solution, y);
    }
  }

  using MediumPreconditioner::apply;

  void gather(const std::vector<double>& of_system, Output mine) const override { medium_.gather(of_system, mine); }
  double restrict_residual(const std::vector<double>& residual, double tolerance) override {
    return medium_.restrict_residual(residual, tolerance);
  }
  void write_restricted(double factor, Output right) const override { medium_.write_restricted(factor, right); }
  void expand(Input x, double factor, double tolerance, std::vector<double>& correction) override {
    medium_.expand(x, factor, tolerance, correction);
  }
  void multiply_whole(const std::vector<double>& x, std::vector<double>& y) override {
    medium_.multiply_whole(x, y);
    for (std::size_t i = 0; i < terms_.size(); ++i) {
      const auto& columns = *terms_[i].columns;
      flows_[i] = 0;
      for (std::size_t k = 0; k < columns.size(); ++k) flows_[i] += columns[k] * x[k];
    }
    for (std::size_t i = 0; i < terms_.size(); ++i) {
      const double pressure = pressure_of(i);
      for (std::size_t k = 0; k < y.size(); ++k) y[k] += pressure * (*terms_[i].rows)[k];
    }
  }

 private:
  struct Single {
    std::vector<float> rows, columns, solution;
  };

  double pressure_of(std::size_t i) const { return pressure_by_flows(terms_[i].slope, *terms_[i].slopes, i, flows_); }
  static double dot(Input a, Input b) {
    double sum = 0;
    for (std::size_t k = 0; k < a.size(); ++k) sum += static_cast<double>(a[k]) * b[k];
    return sum;
  }
  static void add(double factor, Input x, Output y) {
    for (std::size_t k = 0; k < x.size(); ++k) y[k] += static_cast<float>(factor * x[k]);
  }

  MediumPreconditioner& medium_;
  std::vector<Term> terms_;
  std::vector<double> inverse_;
  std::vector<Single> single_;
  mutable std::vector<double> flows_;
  std::vector<double> pressures_;
};

}  // namespace fsi
