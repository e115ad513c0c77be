#pragma once

#include <cstddef>
#include <memory>
#include <string>

#include "algebra/vector_view.hpp"
#include "linear/velocity_pressure/block_preconditioner_choices.hpp"
#include "linear/velocity_pressure/velocity_pressure_matrix.hpp"

namespace fsi {

/// What `fast` iterates with: an approximate inverse P^-1 of the Jacobian F = [A G; B C] of velocities and pressures of both
/// media, mesh motion left out, in single precision. The Krylov method allows for a P^-1 that is not linear. Chosen by
/// linear.preconditioner; the rows are in case/preconditioner_list.hpp.
/// \tparam n  components of a velocity
template <int n>
class FlowPreconditioner {
 public:
  using Matrix = VelocityPressureMatrix<n>;

  explicit FlowPreconditioner(const Matrix& matrix) : matrix_(matrix) {}
  virtual ~FlowPreconditioner() = default;

  /// Takes the present values of the matrix, which must have been filled. What is decided must depend on these and on
  /// `choices` alone, so that a restart decides the same.
  virtual void set_up(const BlockPreconditionerChoices& choices) = 0;
  /// z = P^-1 r, both of the matrix's size; ghosts in r are zero, those in z get the owners' values.
  virtual void apply(VectorView<const float> r, VectorView<float> z) = 0;
  /// Also product = F z, its ghosts left as they are. Overridden where the preconditioner already knows part of that
  /// product.
  virtual void apply(VectorView<const float> r, VectorView<float> z, VectorView<float> product) {
    apply(r, z);
    matrix_.multiply(z, product);
  }

  virtual std::size_t bytes() const = 0;
  /// Levels of its largest hierarchy, and entries of all levels over those of the finest; 0: it has none.
  virtual int levels() const { return 0; }
  virtual double operator_complexity() const { return 0; }

 protected:
  const Matrix& matrix_;
};

/// \param matrix  must outlive it
/// \throws InputError for a name that is not in the list
template <int n>
std::unique_ptr<FlowPreconditioner<n>> make_flow_preconditioner(const std::string& name,
                                                                const VelocityPressureMatrix<n>& matrix);

}  // namespace fsi
