#pragma once

#include <algorithm>
#include <array>
#include <memory>
#include <vector>

#include "linear/distributed/listed_matrix.hpp"
#include "linear/distributed/shared_layout.hpp"
#include "linear/distributed/shared_products.hpp"
#include "linear/velocity_pressure/interface_shape_derivatives.hpp"
#include "linear/velocity_pressure/momentum_diagonals.hpp"
#include "linear/velocity_pressure/velocity_pressure_blocks.hpp"

namespace fsi {

/// The Jacobian of velocities and pressures F = [A G; B C], by rows of all processes: products with it in single precision
/// (SharedProducts), and as matrices of PETSc its Schur complement S = C - B D^-1 G and, for callers that ask, A. Of the mesh
/// motion A has what InterfaceShapeDerivatives gives. All numbers go to places that are worked out once: A, in blocks of n x n,
/// straight into PETSc's arrays, those of the others as ListedMatrix does.
template <int n>
class VelocityPressureSystem {
 public:
  VelocityPressureSystem(const JacobianBlocks<n>& blocks, const VelocityPressureLayout<n>& layout);

  /// Takes the present values of the block matrices.
  void fill();

  const SharedLayout<n>& shared() const { return shared_; }
  const MomentumDiagonals<n>& diagonals() const { return diagonals_; }
  /// Most velocity nodes carry no pressure, those of all processes counted.
  bool has_few_pressures() const;
  MPI_Comm communicator() const { return communicator_; }
  /// A in double precision: made when it is first asked for, and filled when that is after a fill(). By all processes together.
  Mat momentum();
  SharedProducts<n>& products() { return products_; }
  /// S, with the wall's rows scaled and, where that is asked for, a larger diagonal.
  /// \param wall_diagonal_factor  of the diagonal in the wall
  void make_schur_complement(double wall_diagonal_factor);
  Mat schur() const { return schur_; }
  /// of_pressures = r_p - B D^-1 r_v of the rows (r_v, r_p), scaled as S.
  void reduce(Vec rows, Vec of_pressures);

  /// Of the wall: its velocities among this process's own, their places at rest, and A's rows and columns of these.
  struct WallMomentum {
    std::vector<int> own;                       ///< places among own_velocities
    std::vector<std::array<double, 3>> points;  ///< mm
    ListedMatrix matrix;
    std::vector<int> from;  ///< A's blocks that it has, in the order of its entries
  };
  std::unique_ptr<WallMomentum> make_wall_momentum() const;
  void fill_wall_momentum(WallMomentum& wall);

  /// Puts the array of x under the views `velocities` and `pressures` (velocity_view(), pressure_view()) for as long as
  /// this lives. \param writes  the views are written to, and what x held before is not read
  class Parts {
   public:
    Parts(const VelocityPressureSystem& system, Vec velocities, Vec pressures, Vec x, bool writes);
    ~Parts();
    Parts(const Parts&) = delete;
    Parts& operator=(const Parts&) = delete;

   private:
    Vec velocities_, pressures_, x_;
    const double* array_ = nullptr;
    bool writes_;
  };
  OwnedVec velocity_view() const { return petsc_view(communicator_, shared_.velocity_rows); }
  OwnedVec pressure_view() const { return petsc_view(communicator_, shared_.pressure_rows); }

  double bytes() const;

 private:
  /// A's blocks in this process's rows, by velocities of the layout; columns ascend in a row.
  struct Pattern {
    std::vector<int> offsets, columns;  ///< ascending in each row
    int position(int row, int column) const {
      const auto found = std::lower_bound(columns.begin() + offsets[row], columns.begin() + offsets[row + 1], column);
      return static_cast<int>(found - columns.begin());
    }
  };

  void make_momentum();
  void make_lists();
  void fill_momentum();
  void fill_scaled_gradient();
  void fill_continuity();

  VelocityPressureBlocks<n> blocks_;
  const VelocityPressureLayout<n>& layout_;
  SharedLayout<n> shared_;
  MPI_Comm communicator_;
  const Communicator& processes_;
  Pattern pattern_;
  InterfaceShapeDerivatives<n> shape_derivatives_;
  MomentumDiagonals<n> diagonals_;
  SharedProducts<n> products_;
  OwnedMat momentum_, schur_;
  bool momentum_filled_ = false;
  ListedMatrix continuity_;       ///< [B C], columns in the rows of both
  ListedMatrix scaled_gradient_;  ///< [-D^-1 G; 1]: S = [B C] times this
  OwnedVec row_scale_, predicted_;
  std::vector<std::size_t> block_at_;  ///< of A's blocks in the arrays of the part with own columns, then of the other
};

}  // namespace fsi
