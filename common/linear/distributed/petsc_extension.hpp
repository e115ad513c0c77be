#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "algebra/block_matrix.hpp"
#include "fem/nodal_frames.hpp"
#include "fem/unknowns.hpp"
#include "linear/direct/central_factorisation.hpp"
#include "linear/distributed/petsc_gathered_matrix.hpp"
#include "mesh/submesh.hpp"
#include "mesh_motion/mesh_extension.hpp"
#include "mesh_motion/nonlinear_mesh_motion.hpp"

namespace fsi {

/// The equations of a mesh motion whose nodes are shared out among processes, or not: conjugate gradients preconditioned
/// by smoothed aggregation (GAMG) for each component alone, by Korn's inequality as good as for a Laplacian but for a constant
/// [Blaheta1994]. What defeats them, as a tangent that is not positive, is factorised, and so are small systems. Options
/// by the prefix -fsi_mesh_.
/// \tparam n  components of a node
template <int n>
class PetscExtension : public MeshExtension<n> {
 public:
  /// As make_harmonic_extension() has them.
  /// \param central_below  unknowns of all processes, without followers, below which the first process factorises the
  ///                       system
  PetscExtension(const BlockMatrix<1, n>& laplacian, std::vector<char> inner, const NodalFrames<n>* frames,
                 const PartNodes& part, std::int64_t central_below = 0);
  /// As make_tangent_extension() has them.
  PetscExtension(const MeshMotionTangent<n>& tangent, std::vector<char> inner, const PartNodes& part,
                 std::int64_t central_below = 0);

  void update() override;
  void solve(const std::vector<double>& right, std::vector<double>& field, double tolerance) override;
  bool iterates() const override { return !central_ && !factorised_; }
  double memory_mib() const override;
  int iterations() const override { return iterations_; }

 private:
  static constexpr int most_iterations = 200;  ///< of conjugate gradients; a solve that needs more is factorised

  /// Entries that follow two others at most, each without a frame, are eliminated: FollowerElimination of several processes.
  void find_followers();
  void eliminate_followers();
  /// Calls visit(node, entry, number) for the sought entries that an entry's row couples with, itself left out.
  template <class Visit>
  void for_sought_neighbours(std::size_t entry, Visit visit) const;
  double diagonal(std::size_t entry) const;
  /// right_rows_, of all local entries, to right_.
  void reduce_right();
  void complete_followers(std::vector<double>& field) const;
  void number_entries(std::int64_t central_below);
  template <class Builder>
  void gather(Builder& builder, const UnknownMap& rows, const UnknownMap& columns) const;
  /// \param whole  all entries; else only those that couple a component with itself
  PetscGatheredMatrix gather(bool whole) const;
  CentralFactorisation gather_at_first() const;
  void set_up_iteration();
  void factorise();
  void multiply_given();
  void solve_by_petsc(double tolerance);
  bool iterate(double tolerance);

  const BlockMatrix<1, n>* laplacian_ = nullptr;
  const MeshMotionTangent<n>* tangent_ = nullptr;
  const NodalFrames<n>* frames_ = nullptr;
  const PartNodes& part_;
  MPI_Comm communicator_;
  std::vector<char> inner_;      ///< per entry: 1 own and sought, 2 sought by another process, 3 own follower, else 0
  std::vector<double> follows_;  ///< per entry, also of copies: 1 of followers; empty where nothing is eliminated
  std::vector<double> sought_;   ///< per entry, also of copies: 1 where it is
  BlockMatrix<1, n> reduced_;    ///< the Laplacian without followers
  std::vector<double> right_rows_;
  UnknownMap rows_, columns_;       ///< by numbers among all processes' ones; rows of own nodes
  std::vector<std::size_t> entry_;  ///< per own unknown
  PetscGatheredMatrix matrix_, of_components_;
  bool components_apart_ = false;  ///< the matrix couples no two components
  bool central_ = false;           ///< the first process factorises
  std::int64_t first_ = 0;         ///< number among all processes' of the first own unknown
  std::int64_t whole_ = 0;         ///< unknowns of all processes
  CentralFactorisation at_first_;
  OwnedKsp iteration_, factors_;
  OwnedVec b_, x_;
  bool factorised_ = false;
  int iterations_ = 0;
  std::vector<double> given_, given_rows_, right_, solution_, of_all_;
};

}  // namespace fsi
