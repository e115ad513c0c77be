#include "linear/distributed/petsc_extension.hpp"

#include <algorithm>
#include <cassert>
#include <utility>

#include "algebra/block_products.hpp"
#include "base/error.hpp"
#include "fem/dimensions.hpp"
#include "fem/gather_blocks.hpp"
#include "fem/nodal_layout.hpp"
#include "linear/direct/direct_solver.hpp"
#include "linear/distributed/petsc_factorisation.hpp"
#include "linear/distributed/petsc_options.hpp"

namespace fsi {

template <int n>
PetscExtension<n>::PetscExtension(const BlockMatrix<1, n>& laplacian, std::vector<char> inner,
                                  const NodalFrames<n>* frames, const PartNodes& part, std::int64_t central_below)
    : laplacian_(&laplacian),
      frames_(frames && !frames->empty() ? frames : nullptr),
      part_(part),
      communicator_(petsc_communicator(part.processes())),
      inner_(std::move(inner)) {
  find_followers();
  number_entries(central_below);
  components_apart_ = !part.processes().any(frames_ != nullptr);
  PetscExtension<n>::update();
}

template <int n>
PetscExtension<n>::PetscExtension(const MeshMotionTangent<n>& tangent, std::vector<char> inner, const PartNodes& part,
                                  std::int64_t central_below)
    : tangent_(&tangent), part_(part), communicator_(petsc_communicator(part.processes())), inner_(std::move(inner)) {
  number_entries(central_below);
}

template <int n>
template <class Visit>
void PetscExtension<n>::for_sought_neighbours(std::size_t entry, Visit visit) const {
  const NodeGraph& graph = *laplacian_->graph;
  const int node = static_cast<int>(entry / n), component = static_cast<int>(entry % n);
  for (int at = graph.offsets[node]; at < graph.offsets[node + 1]; ++at) {
    const int other = graph.columns[at];
    const std::size_t beside = VectorLayout<n>::vector(other, component);
    const double number = laplacian_->block(at)[component];
    if (other != node && number != 0 && sought_[beside] != 0) visit(other, beside, number);
  }
}

template <int n>
double PetscExtension<n>::diagonal(std::size_t entry) const {
  const int node = static_cast<int>(entry / n);
  return laplacian_->block(laplacian_->graph->find(node, node))[entry % n];
}

/// Decided by the couplings alone, and alike by all processes: entries that couple with two others at most, and with no
/// other such entry.
template <int n>
void PetscExtension<n>::find_followers() {
  constexpr double most_leaders = 2, many = 100;
  const auto update = [&](std::vector<double>& field) {
    if (part_.share) part_.share->template update<VectorLayout<n>>(field);
  };
  sought_.assign(inner_.size(), 0.0);
  for (std::size_t i = 0; i < inner_.size(); ++i) sought_[i] = part_.owns(static_cast<int>(i / n)) && inner_[i] ? 1 : 0;
  update(sought_);
  const NodeGraph& graph = *laplacian_->graph;
  std::vector<double> leaders(inner_.size(), many);
  const auto framed = [&](int node) { return frames_ && frames_->at(node); };
  for (std::size_t i = 0; i < inner_.size(); ++i) {
    const int node = static_cast<int>(i / n);
    if (sought_[i] == 0 || !part_.owns(node) || framed(node)) continue;
    std::vector<int> beside;
    bool eliminable = true;
    for_sought_neighbours(i, [&](int other, std::size_t, double) {
      eliminable = eliminable && !framed(other);
      beside.push_back(other);
    });
    if (beside.size() == 2) eliminable = eliminable && graph.find(beside[0], beside[1]) >= 0;
    if (eliminable) leaders[i] = static_cast<double>(beside.size());
  }
  update(leaders);
  follows_.assign(inner_.size(), 0.0);
  for (std::size_t i = 0; i < inner_.size(); ++i) {
    if (leaders[i] > most_leaders || !part_.owns(static_cast<int>(i / n))) continue;
    follows_[i] = 1;
    for_sought_neighbours(i, [&](int, std::size_t other, double) {
      if (leaders[other] <= most_leaders) follows_[i] = 0;
    });
  }
  update(follows_);
  reduced_ = *laplacian_;
}

/// Rows of copies are whole where they couple with an own node, and the others are not read.
template <int n>
void PetscExtension<n>::eliminate_followers() {
  reduced_.values = laplacian_->values;
  const NodeGraph& graph = *laplacian_->graph;
  for (std::size_t i = 0; i < inner_.size(); ++i) {
    if (follows_[i] == 0) continue;
    std::vector<std::pair<int, double>> leaders;
    for_sought_neighbours(i, [&](int other, std::size_t, double number) { leaders.emplace_back(other, number); });
    const double own = diagonal(i);
    for (const auto& [row, of_row] : leaders)
      for (const auto& [column, of_column] : leaders)
        if (const int at = graph.find(row, column); at >= 0 && own != 0)
          reduced_.block(at)[i % n] -= of_row * of_column / own;
  }
}

template <int n>
void PetscExtension<n>::reduce_right() {
  if (part_.share) part_.share->template update<VectorLayout<n>>(right_rows_);
  for (std::size_t row = 0; row < entry_.size(); ++row) {
    double sum = right_rows_[entry_[row]];
    if (!follows_.empty())
      for_sought_neighbours(entry_[row], [&](int, std::size_t other, double number) {
        if (follows_[other] != 0) sum -= number / diagonal(other) * right_rows_[other];
      });
    right_[row] = sum;
  }
}

template <int n>
void PetscExtension<n>::complete_followers(std::vector<double>& field) const {
  for (std::size_t i = 0; i < inner_.size(); ++i) {
    if (inner_[i] != 3) continue;
    double sum = right_rows_[i];
    for_sought_neighbours(i, [&](int, std::size_t other, double number) { sum -= number * field[other]; });
    field[i] = sum / diagonal(i);
  }
  if (part_.share) part_.share->template update<VectorLayout<n>>(field);
}

template <int n>
void PetscExtension<n>::number_entries(std::int64_t central_below) {
  assert(inner_.size() == VectorLayout<n>::size(part_.node_count()));
  for (std::size_t i = 0; i < inner_.size(); ++i) {
    if (!part_.owns(static_cast<int>(i / n))) inner_[i] = 0;
    if (inner_[i] && !follows_.empty() && follows_[i] != 0)
      inner_[i] = 3;
    else if (inner_[i])
      entry_.push_back(i);
  }
  const auto own = static_cast<std::int64_t>(entry_.size());
  first_ = part_.processes().sum_before(own);
  whole_ = part_.processes().sum(own);
  central_ = whole_ < central_below;
  std::vector<double> numbers(inner_.size(), -1.0);
  for (std::size_t row = 0; row < entry_.size(); ++row)
    numbers[entry_[row]] = static_cast<double>(first_ + static_cast<std::int64_t>(row));
  if (part_.share) part_.share->template update<VectorLayout<n>>(numbers);
  rows_.resize(inner_.size());
  columns_.resize(inner_.size());
  for (std::size_t i = 0; i < inner_.size(); ++i) {
    columns_[i].index = static_cast<std::int64_t>(numbers[i]);
    if (inner_[i] == 1)
      rows_[i] = columns_[i];
    else if (columns_[i].index >= 0 || (!follows_.empty() && follows_[i] != 0 && inner_[i] == 0))
      inner_[i] = 2;  // sought, by another process
  }
  given_.resize(inner_.size());
  given_rows_.resize(inner_.size());
  b_ = petsc_vector(communicator_, static_cast<PetscInt>(entry_.size()));
  x_ = petsc_vector(communicator_, static_cast<PetscInt>(entry_.size()));
}

template <int n>
template <class Builder>
void PetscExtension<n>::gather(Builder& builder, const UnknownMap& rows, const UnknownMap& columns) const {
  if (tangent_)
    gather_blocks(builder, *tangent_, rows, columns);
  else
    gather_diagonal_blocks(builder, reduced_, rows, columns, frames_);
}

template <int n>
CentralFactorisation PetscExtension<n>::gather_at_first() const {
  GatheredMatrix::Builder builder(whole_);
  gather(builder, rows_, columns_);
  return {part_.processes(), std::move(builder)};
}

template <int n>
PetscGatheredMatrix PetscExtension<n>::gather(bool whole) const {
  PetscGatheredMatrix::Builder builder;
  if (whole) {
    gather(builder, rows_, columns_);
  } else {
    for (int k = 0; k < n; ++k) {
      UnknownMap rows(rows_.size()), columns(columns_.size());
      for (std::size_t i = k; i < rows.size(); i += n) {
        rows[i] = rows_[i];
        columns[i] = columns_[i];
      }
      gather(builder, rows, columns);
    }
  }
  return {communicator_, static_cast<PetscInt>(entry_.size()), std::move(builder)};
}

template <int n>
void PetscExtension<n>::update() {
  const OneDenseThread same_bits_for_any_number;
  if (!follows_.empty()) eliminate_followers();
  if (central_) {
    if (!at_first_.factorised()) at_first_ = gather_at_first();
    at_first_.update();
    return;
  }
  if (matrix_.matrix() == nullptr) {
    matrix_ = gather(true);
    if (!components_apart_) of_components_ = gather(false);
  }
  matrix_.update();
  if (!components_apart_) of_components_.update();
  factorised_ = false;  // the last values' iteration may have failed
  factors_.reset();
  set_up_iteration();
}

template <int n>
void PetscExtension<n>::set_up_iteration() {
  const bool first = !iteration_;
  if (first) {
    take_petsc_options();
    petsc_check(KSPCreate(communicator_, iteration_.fresh()));
    petsc_check(KSPSetOptionsPrefix(iteration_, prefix_of(PetscPart::mesh)));
    petsc_check(KSPSetType(iteration_, KSPCG));
    petsc_check(KSPSetNormType(iteration_, KSP_NORM_UNPRECONDITIONED));
    petsc_check(KSPSetInitialGuessNonzero(iteration_, PETSC_TRUE));
    PC pc = nullptr;
    petsc_check(KSPGetPC(iteration_, &pc));
    petsc_check(PCSetType(pc, PCGAMG));                         // by measurement: a third of the seconds of BoomerAMG
    petsc_check(PCGAMGSetReuseInterpolation(pc, PETSC_FALSE));  // a restart could not
  }
  petsc_check(
      KSPSetOperators(iteration_, matrix_.matrix(), components_apart_ ? matrix_.matrix() : of_components_.matrix()));
  try {
    if (first) petsc_check(KSPSetFromOptions(iteration_));
    petsc_check(KSPSetUp(iteration_));
  } catch (const PetscFailure& failure) {
    blame_petsc_options(failure.what());
  }
  if (first) refuse_unread_petsc_options(PetscPart::mesh);
}

template <int n>
void PetscExtension<n>::factorise() {
  factors_ = petsc_factorisation(communicator_, matrix_.matrix());
  factorised_ = true;
}

/// The rows of A times the values that are given.
template <int n>
void PetscExtension<n>::multiply_given() {
  if (tangent_) {
    multiply(*tangent_, given_, given_rows_);
    return;
  }
  if (frames_) frames_->template to_space<VectorLayout<n>>(given_);
  multiply_components<n>(*laplacian_, given_, given_rows_);
  if (frames_) frames_->template to_frames<VectorLayout<n>>(given_rows_);
}

template <int n>
void PetscExtension<n>::solve(const std::vector<double>& right, std::vector<double>& field, double tolerance) {
  assert(right.size() == inner_.size() && field.size() == inner_.size());
  const OneDenseThread same_bits_for_any_number;
  for (std::size_t i = 0; i < inner_.size(); ++i) given_[i] = inner_[i] ? 0 : field[i];
  multiply_given();
  right_.resize(entry_.size());
  solution_.resize(entry_.size());
  right_rows_.resize(right.size());
  for (std::size_t i = 0; i < right.size(); ++i) right_rows_[i] = right[i] - given_rows_[i];
  reduce_right();
  for (std::size_t row = 0; row < entry_.size(); ++row) solution_[row] = field[entry_[row]];
  if (central_) {
    at_first_.solve(right_, of_all_);
    std::copy_n(of_all_.begin() + first_, entry_.size(), solution_.begin());
  } else {
    solve_by_petsc(tolerance);
  }
  for (std::size_t row = 0; row < entry_.size(); ++row) field[entry_[row]] = solution_[row];
  if (part_.share) part_.share->template update<VectorLayout<n>>(field);
  if (!follows_.empty()) complete_followers(field);
}

/// solution_ is the first guess.
template <int n>
void PetscExtension<n>::solve_by_petsc(double tolerance) {
  double *b = nullptr, *x = nullptr;
  petsc_check(VecGetArray(b_, &b));
  petsc_check(VecGetArray(x_, &x));
  std::copy(right_.begin(), right_.end(), b);
  std::copy(solution_.begin(), solution_.end(), x);
  iterations_ = 0;
  petsc_check(VecRestoreArray(b_, &b));
  petsc_check(VecRestoreArray(x_, &x));
  if (factorised_ || !iterate(tolerance)) {
    if (!factorised_) factorise();
    petsc_check(KSPSolve(factors_, b_, x_));
  }
  const double* found = nullptr;
  petsc_check(VecGetArrayRead(x_, &found));
  std::copy_n(found, solution_.size(), solution_.begin());
  petsc_check(VecRestoreArrayRead(x_, &found));
}

template <int n>
bool PetscExtension<n>::iterate(double tolerance) {
  PetscInt count = 0;
  KSPConvergedReason reason = KSP_CONVERGED_ITERATING;
  petsc_check(KSPSetTolerances(iteration_, tolerance, 1e-300, PETSC_DEFAULT, most_iterations));
  petsc_check(KSPSolve(iteration_, b_, x_));
  petsc_check(KSPGetIterationNumber(iteration_, &count));
  petsc_check(KSPGetConvergedReason(iteration_, &reason));
  iterations_ = static_cast<int>(count);
  return reason > 0;
}

template <int n>
double PetscExtension<n>::memory_mib() const {
  if (central_) return at_first_.memory_mib();
  return (petsc_bytes(matrix_.matrix()) + petsc_bytes(of_components_.matrix()) +
          8.0 * static_cast<double>(reduced_.values.size())) /
         (1 << 20);
}

#define FSI_INSTANTIATE(n) template class PetscExtension<n>;
FSI_FOR_EACH_DIMENSION(FSI_INSTANTIATE)

}  // namespace fsi
