#include "derived/gradient_fit.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace fsi {

namespace {

constexpr double flat = 1e-12;              // of second moments: rounding
constexpr double dependent = 1e-9;          // of the own polynomials' columns, likewise
constexpr double indistinguishable = 1e-8;  // of mean squares on the patch: rounding
constexpr double near = 0.1;                // of weights (|xi|^2/mean + near)^-steepness: docs/theory.md, section 11a.1
constexpr double steepness = 3;

}  // namespace

GradientFit::GradientFit(std::vector<int> axes, int degree) : axes_(std::move(axes)), degree_(degree) {
  static constexpr double factorial[] = {1, 1, 2, 6, 24};
  for (int total = 0; total <= degree + 1; ++total)
    for (int i = total; i >= 0; --i)
      for (int j = total - i; j >= 0; --j) {
        const int k = total - i - j;
        if (axes_.size() < 3 && k > 0) continue;
        const double scale = std::sqrt(factorial[total] / (factorial[i] * factorial[j] * factorial[k]));
        (total <= degree ? own_ : above_).push_back({{i, j, k}, scale});
      }
}

Eigen::MatrixXd GradientFit::values(const std::vector<Monomial>& monomials, const Eigen::MatrixXd& xi) {
  Eigen::MatrixXd columns(xi.rows(), monomials.size());
  for (std::size_t m = 0; m < monomials.size(); ++m)
    for (Eigen::Index i = 0; i < xi.rows(); ++i) {
      double value = monomials[m].scale;
      for (Eigen::Index c = 0; c < xi.cols(); ++c)
        for (int e = 0; e < monomials[m].exponents[c]; ++e) value *= xi(i, c);
      columns(i, m) = value;
    }
  return columns;
}

bool GradientFit::set(const std::vector<Point>& patch, Frame frame) {
  const auto rows = static_cast<Eigen::Index>(patch.size()), dim = static_cast<Eigen::Index>(axes_.size());
  const auto own = static_cast<Eigen::Index>(own_.size());
  if (rows < own) return false;
  Eigen::MatrixXd x(rows, dim);
  for (Eigen::Index i = 0; i < rows; ++i)
    for (Eigen::Index c = 0; c < dim; ++c) x(i, c) = patch[i][axes_[c]] - patch[0][axes_[c]];
  distances_ = x.rowwise().norm();
  lengths_ = x / (distances_.norm() / std::sqrt(static_cast<double>(rows)));
  const Eigen::MatrixXd about_mean = x.rowwise() - x.colwise().mean();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> moments(about_mean.transpose() * about_mean /
                                                               static_cast<double>(rows));
  const auto& spreads = moments.eigenvalues();  // ascending
  if (!(spreads[0] > flat * spreads[dim - 1])) return false;
  const auto& axes = moments.eigenvectors();
  from_xi_ = axes * spreads.cwiseSqrt().asDiagonal() * axes.transpose();
  const Eigen::MatrixXd to_xi = axes * spreads.cwiseSqrt().cwiseInverse().asDiagonal() * axes.transpose();
  xi_ = x * to_xi;
  to_frame_ = frame == Frame::of_the_patch ? to_xi : Eigen::MatrixXd::Identity(dim, dim) / std::sqrt(spreads.sum());
  const Eigen::MatrixXd in_frame = x * to_frame_;
  const Eigen::VectorXd square = xi_.rowwise().squaredNorm();
  const double mean = square.mean();
  root_ = square.unaryExpr([mean](double s) { return std::pow(s / mean + near, -0.5 * steepness); });
  root_ *= std::sqrt(static_cast<double>(rows) / root_.squaredNorm());

  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(root_.asDiagonal() * values(own_, in_frame));
  const auto r = qr.matrixQR().topLeftCorner(own, own).triangularView<Eigen::Upper>();
  const Eigen::VectorXd diagonal = qr.matrixQR().diagonal().head(own).cwiseAbs();
  if (!(diagonal.minCoeff() > dependent * diagonal.maxCoeff())) return false;
  const Eigen::MatrixXd q = qr.householderQ() * Eigen::MatrixXd::Identity(rows, own);
  // Coefficients of the own polynomial are R^-1 Q^T f; those of the coordinates are the gradient.
  slopes_ = q * r.transpose().solve(Eigen::MatrixXd::Identity(own, own).middleCols(1, dim));

  top_ = root_.asDiagonal() * values(above_, in_frame);
  rest_ = top_ - q * (q.transpose() * top_);
  rest_ -= q * (q.transpose() * rest_);
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> principal(rest_.transpose() * rest_ / static_cast<double>(rows));
  squares_ = principal.eigenvalues();
  directions_ = principal.eigenvectors();
  return true;
}

bool GradientFit::solve(int left_out) {
  left_out_ = left_out;
  weights_ = slopes_;
  for (Eigen::Index k = left_out; k < squares_.size(); ++k) {
    if (!(squares_[k] > indistinguishable * top_.squaredNorm() / static_cast<double>(top_.rows()))) return false;
    // The coefficient along direction v is (rest v)^T f / |rest v|^2; its polynomial is taken from what the own one
    // fits.
    const Eigen::VectorXd part = rest_ * directions_.col(k), whole = top_ * directions_.col(k);
    weights_ -= part * (whole.transpose() * slopes_) / part.squaredNorm();
  }
  weights_ = root_.asDiagonal() * weights_ * to_frame_;
  return true;
}

double GradientFit::amplification() const {
  return (xi_.rowwise().norm().array() * (weights_ * from_xi_).rowwise().norm().array()).sum();
}

Eigen::MatrixXd GradientFit::error_directions() const {
  const Eigen::MatrixXd errors = values(above_, lengths_).transpose() * weights_;
  return errors.transpose() * errors;
}

double GradientFit::remainder() const {
  const Eigen::VectorXd lengths = weights_.rowwise().norm();
  double sum = 0;
  for (Eigen::Index i = 0; i < lengths.size(); ++i) sum += std::pow(distances_[i], degree_ + 2) * lengths[i];
  return sum;
}

std::vector<std::array<double, 3>> GradientFit::weights() const {
  std::vector<std::array<double, 3>> result(static_cast<std::size_t>(weights_.rows()), {0, 0, 0});
  for (Eigen::Index i = 0; i < weights_.rows(); ++i)
    for (Eigen::Index c = 0; c < weights_.cols(); ++c)
      result[static_cast<std::size_t>(i)][static_cast<std::size_t>(c)] = weights_(i, c);
  return result;
}

}  // namespace fsi
