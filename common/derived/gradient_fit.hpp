#pragma once

#include <Eigen/Dense>
#include <array>
#include <cstddef>
#include <vector>

#include "mesh/simplex_mesh.hpp"

namespace fsi {

/// Weighted least-squares polynomials over a patch of points, and the gradient at the first of them (docs/theory.md,
/// section 11a.1). It depends on lengths and angles only, not on axes: rotated or mirrored points have rotated or
/// mirrored weights, to rounding.
///
/// Coordinates are those in which the points' second moments about their mean are the identity,
///   xi = C^(-1/2) (x - x_0),   C = 1/N sum (x_i - mean) (x_i - mean)^T:
/// C^(-1/2) being symmetric, xi rotates as x does, and a thin patch is as good as a round one. Monomials have unit
/// length in Bombieri's scalar product [Beauzamy1990], which rotations keep: xi^a times sqrt(|a|!/a!). So a rotation
/// acts on the coefficients of one degree by an orthogonal matrix. Near points weigh more, by their distance in xi.
///
/// All polynomials of the element's degree are fitted. The part of those one degree above that these cannot represent
/// on the patch is split into its principal directions (right singular vectors). The weakest can be left out: of the
/// coefficients above the element's degree that fit as well, those of least length are taken.
class GradientFit {
 public:
  /// \param axes    of space that coordinates lie along
  /// \param degree  of the polynomials that are fitted without condition: the element's
  GradientFit(std::vector<int> axes, int degree);

  /// Coordinates of the polynomials: xi, or x scaled alike in all directions. In the latter, powers across a thin layer
  /// are the weakest, whatever its direction.
  enum class Frame { of_the_patch, of_space };

  /// Sets the patch, its points in mm. \returns whether polynomials of the element's degree are determined
  bool set(const std::vector<Point>& patch, Frame frame = Frame::of_the_patch);
  /// Finds the weights for the patch.
  /// \param left_out  how many directions of the degree above to leave out, the weakest first
  /// \returns whether the patch distinguishes the others from polynomials of the element's degree
  bool solve(int left_out = 0);
  /// Number of directions of the degree above.
  int directions() const { return static_cast<int>(above_.size()); }
  /// Of the last solve(): sum |xi_i| |w_i| with the weights w of the gradient in xi. It bounds the gradient's response
  /// to errors of the values that grow with the distance, relative to their slope: three and more for good patches.
  double amplification() const;
  /// Of the last solve(): sum |x_i - x_0|^(q+1) |w_i| for polynomials of degree q, which bounds the error of the
  /// gradient of a field by its derivatives of degree q + 1, mm^q.
  double remainder() const;
  int left_out() const { return left_out_; }  ///< of the last solve()
  /// Of the last solve(): sum e e^T of the gradient's errors e for the polynomials of the degree above, of unit length.
  /// It is zero unless directions are left out. Up to a factor it is the expected error by direction; in a layer one
  /// element thick nearly all of it is along the normal.
  Eigen::MatrixXd error_directions() const;
  /// Of the last solve(): weights of the values at the points in the gradient at the first one, 1/mm.
  std::vector<std::array<double, 3>> weights() const;

 private:
  struct Monomial {
    std::array<int, 3> exponents;
    double scale;
  };
  /// Monomials at points: a row per point.
  static Eigen::MatrixXd values(const std::vector<Monomial>& monomials, const Eigen::MatrixXd& xi);

  std::vector<int> axes_;
  int degree_, left_out_ = 0;
  std::vector<Monomial> own_, above_;  ///< up to the element's degree, the constant and the coordinates first; above it
  Eigen::MatrixXd from_xi_;            ///< C^(1/2), mm
  Eigen::MatrixXd to_frame_;           ///< of the polynomials, 1/mm
  Eigen::MatrixXd lengths_;            ///< rows: points, seen from the first, over their root mean square
  Eigen::VectorXd distances_;          ///< of the points to the first, mm
  Eigen::VectorXd root_;               ///< of the points' weights, whose mean is one
  Eigen::MatrixXd slopes_;             ///< columns: weights of the own polynomial's gradient
  Eigen::MatrixXd top_;                ///< columns: the degree above at the points
  Eigen::MatrixXd rest_;               ///< without what the own polynomials have of it there
  Eigen::VectorXd squares_;            ///< of singular values of rest_, ascending
  Eigen::MatrixXd directions_;         ///< columns: their right singular vectors
  Eigen::MatrixXd xi_;                 ///< rows: points
  Eigen::MatrixXd weights_;            ///< rows: points; 1/mm
};

}  // namespace fsi
