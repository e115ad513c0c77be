#pragma once

#include <memory>
#include <string>
#include <vector>

#include "base/name_table.hpp"
#include "monolithic/coupled_solvers/block/coupled_matrix.hpp"
#include "monolithic/coupled_solvers/block/sub_solver.hpp"

namespace fsi {

/// An approximation of K^-1. Linear, as GMRES needs it, but for CoupledCycle of kinds k and amli.
class CoupledPreconditioner {
 public:
  virtual ~CoupledPreconditioner() = default;
  /// x = P~^-1 b; all parts of b and x have their sizes.
  virtual void apply(const CoupledVector& b, CoupledVector& x) = 0;
};

/// Preconditioners from block factorisations of K ([Langer2018], section 4.1; docs/theory.md, section 9.4), with A~m,
/// A~f, A~s for the sub-problems' matrices.
template <int n>
class BlockPreconditioner : public CoupledPreconditioner {
 public:
  BlockPreconditioner(const CoupledMatrix<n>& k, SubSolvers inverse) : k_(k), inverse_(inverse) {}

 protected:
  const CoupledMatrix<n>& k_;
  SubSolvers inverse_;
  std::vector<double> r_, t_;
};

/// P = diag(Am, Af, As): three sub-problems without coupling.
template <int n>
class DiagonalPreconditioner : public BlockPreconditioner<n> {
 public:
  using BlockPreconditioner<n>::BlockPreconditioner;
  void apply(const CoupledVector& b, CoupledVector& x) override {
    this->inverse_.mesh.solve(b.mesh, x.mesh);
    this->inverse_.fluid.solve(b.fluid, x.fluid);
    this->inverse_.wall.solve(b.wall, x.wall);
  }
};

///     [ Am           ]
/// P = [ Afm  Af      ]   forward substitution
///     [ 0    Asf  As ]
template <int n>
class LowerPreconditioner : public BlockPreconditioner<n> {
 public:
  using BlockPreconditioner<n>::BlockPreconditioner;
  void apply(const CoupledVector& b, CoupledVector& x) override {
    const auto& k = this->k_;
    auto& r = this->r_;
    this->inverse_.mesh.solve(b.mesh, x.mesh);
    r = b.fluid;
    k.subtract_fluid_mesh(x.mesh, r);
    this->inverse_.fluid.solve(r, x.fluid);
    r = b.wall;
    k.subtract_wall_fluid(x.fluid, r);
    this->inverse_.wall.solve(r, x.wall);
  }
};

///     [ Am  0   Ams ]
/// P = [     Af  Afs ]   backward substitution
///     [         As  ]
template <int n>
class UpperPreconditioner : public BlockPreconditioner<n> {
 public:
  using BlockPreconditioner<n>::BlockPreconditioner;
  void apply(const CoupledVector& b, CoupledVector& x) override {
    const auto& k = this->k_;
    auto& r = this->r_;
    this->inverse_.wall.solve(b.wall, x.wall);
    r = b.fluid;
    k.subtract_fluid_wall(x.wall, r);
    this->inverse_.fluid.solve(r, x.fluid);
    r = b.mesh;
    k.subtract_mesh_wall(x.wall, r);
    this->inverse_.mesh.solve(r, x.mesh);
  }
};

///     [ Am           ] [ I  0  Am^-1 Ams ]
/// P = [ Afm  Af      ] [    I  Af^-1 Afs ]   the lower preconditioner, then backward with unit diagonal
///     [ 0    Asf  As ] [       I         ]
template <int n>
class SsorPreconditioner : public LowerPreconditioner<n> {
 public:
  using LowerPreconditioner<n>::LowerPreconditioner;
  void apply(const CoupledVector& b, CoupledVector& x) override {
    LowerPreconditioner<n>::apply(b, x);
    const auto& k = this->k_;
    auto &r = this->r_, &t = this->t_;
    r.assign(b.fluid.size(), 0.0);
    k.subtract_fluid_wall(x.wall, r);
    this->inverse_.fluid.solve(r, t);
    axpy(1.0, t, x.fluid);
    r.assign(b.mesh.size(), 0.0);
    k.subtract_mesh_wall(x.wall, r);
    this->inverse_.mesh.solve(r, t);
    axpy(1.0, t, x.mesh);
  }
};

///     [ I                      ] [ Am  0   Ams                 ]
/// P = [ Afm Am^-1  I           ] [     Af  Afs - Afm Am^-1 Ams ]
///     [ 0          Asf Af^-1 I ] [         As                  ]
/// with the upper factor's inverse as corrected (docs/theory.md, section 12, item 7).
template <int n>
class IluPreconditioner : public BlockPreconditioner<n> {
 public:
  using BlockPreconditioner<n>::BlockPreconditioner;
  void apply(const CoupledVector& b, CoupledVector& x) override {
    const auto& k = this->k_;
    auto &r = this->r_, &t = this->t_;
    // Forward: y_m = b_m, y_f = b_f - Afm Am^-1 y_m, y_s = b_s - Asf Af^-1 y_f.
    this->inverse_.mesh.solve(b.mesh, x.mesh);
    y_fluid_ = b.fluid;
    k.subtract_fluid_mesh(x.mesh, y_fluid_);
    this->inverse_.fluid.solve(y_fluid_, x.fluid);
    r = b.wall;
    k.subtract_wall_fluid(x.fluid, r);
    // Backward: x_s = As^-1 y_s; with z = Am^-1 Ams x_s, x_m = Am^-1 y_m - z and
    // x_f = Af^-1 (y_f - Afs x_s + Afm z), where Am^-1 y_m and Af^-1 y_f are known from above.
    this->inverse_.wall.solve(r, x.wall);
    r.assign(b.mesh.size(), 0.0);
    k.subtract_mesh_wall(x.wall, r);
    this->inverse_.mesh.solve(r, t);  // t = -z
    axpy(1.0, t, x.mesh);
    r.assign(b.fluid.size(), 0.0);
    k.subtract_fluid_wall(x.wall, r);
    k.subtract_fluid_mesh(t, r);
    this->inverse_.fluid.solve(r, t);
    axpy(1.0, t, x.fluid);
  }

 private:
  std::vector<double> y_fluid_;
};

namespace detail {

template <template <int> class Preconditioner, int n>
std::unique_ptr<CoupledPreconditioner> make_block(const CoupledMatrix<n>& k, SubSolvers inverse) {
  return std::make_unique<Preconditioner<n>>(k, inverse);
}

}  // namespace detail

template <int n>
using MakeBlockPreconditioner = std::unique_ptr<CoupledPreconditioner> (*)(const CoupledMatrix<n>& k,
                                                                           SubSolvers inverse);

/// The preconditioners by name.
template <int n>
const NameTable<MakeBlockPreconditioner<n>>& block_preconditioners() {
  static const NameTable<MakeBlockPreconditioner<n>> table{"block preconditioner",
                                                           {{"diagonal", detail::make_block<DiagonalPreconditioner, n>},
                                                            {"lower", detail::make_block<LowerPreconditioner, n>},
                                                            {"upper", detail::make_block<UpperPreconditioner, n>},
                                                            {"ssor", detail::make_block<SsorPreconditioner, n>},
                                                            {"ilu", detail::make_block<IluPreconditioner, n>}}};
  return table;
}

/// \throws InputError for a name that is not in the table
template <int n>
std::unique_ptr<CoupledPreconditioner> make_block_preconditioner(const std::string& name, const CoupledMatrix<n>& k,
                                                                 SubSolvers inverse) {
  return block_preconditioners<n>().at(name)(k, inverse);
}

}  // namespace fsi
