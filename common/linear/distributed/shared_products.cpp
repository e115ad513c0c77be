#include "linear/distributed/shared_products.hpp"

#include <cmath>

#include "fem/dimensions.hpp"
#include "host/parallel_for.hpp"

namespace fsi {

template <int n>
SharedProducts<n>::SharedProducts(const JacobianBlocks<n>& blocks, const VelocityPressureLayout<n>& layout,
                                  const SharedLayout<n>& shared, MPI_Comm communicator)
    : layout_(layout),
      shared_(shared),
      matrix_(blocks, layout),
      sweep_(matrix_.momentum(), layout.own_velocities, matrix_.processes().size()),
      local_(matrix_.size()),
      product_(matrix_.size()),
      residual_(matrix_.velocity_size()),
      velocity_(matrix_.velocity_size()),
      again_(matrix_.velocity_size()) {
  std::vector<PetscInt> from, pressures_from;
  std::vector<std::size_t> to, pressures_to;
  for (int v = 0; v < layout.velocities; ++v)
    for (int k = 0; k < n && !shared.owns_velocity[v]; ++k) {
      from.push_back(shared.velocity_place[v] + k);
      to.push_back(std::size_t{lanes} * v + k);
    }
  for (int p = 0; p < layout.pressures; ++p) {
    if (shared.owns_pressure[p]) continue;
    from.push_back(shared.pressure_place[p]);
    pressures_from.push_back(shared.pressure_number[p]);
    to.push_back(matrix_.velocity_size() + p);
    pressures_to.push_back(to.back());
  }
  of_both_ = make_ghosts(petsc_vector(communicator, shared.rows()), from, to);
  of_pressures_ = make_ghosts(petsc_vector(communicator, shared.pressure_rows), pressures_from, pressures_to);
}

template <int n>
typename SharedProducts<n>::Ghosts SharedProducts<n>::make_ghosts(Vec pattern, const std::vector<PetscInt>& from,
                                                                  const std::vector<std::size_t>& places) const {
  Ghosts ghosts;
  ghosts.places = places;
  const auto count = static_cast<PetscInt>(from.size());
  petsc_check(VecCreateSeq(PETSC_COMM_SELF, count, ghosts.received.fresh()));
  IS numbers = nullptr;
  petsc_check(ISCreateGeneral(PETSC_COMM_SELF, count, from.data(), PETSC_COPY_VALUES, &numbers));
  const auto made = VecScatterCreate(pattern, numbers, ghosts.received, nullptr, ghosts.scatter.fresh());
  petsc_check(ISDestroy(&numbers));
  petsc_check(made);
  return ghosts;
}

template <int n>
void SharedProducts<n>::fill(MomentumDiagonals<n>& diagonals, bool few_pressures, const Communicator& processes) {
  matrix_.fill();
  diagonals.fill(
      matrix_, few_pressures, [&](int v, const auto& diagonal) { sweep_.set_diagonal(v, diagonal); }, processes);
}

template <int n>
void SharedProducts<n>::set_up(const BlockPreconditionerChoices& choices, double stiffness) {
  sweeps_ = choices.momentum_sweeps;
  sweep_.set_relaxation(choices.relaxation(stiffness));
}

template <int n>
void SharedProducts<n>::take_velocities(Vec x, std::vector<float>& to) const {
  const double* array = nullptr;
  petsc_check(VecGetArrayRead(x, &array));
  const double* from = array;
  for (const int v : shared_.own_velocities)
    for (int k = 0; k < n; ++k) to[std::size_t{lanes} * v + k] = static_cast<float>(*from++);
  petsc_check(VecRestoreArrayRead(x, &array));
}

template <int n>
void SharedProducts<n>::give_velocities(const std::vector<float>& from, double* to) const {
  for (const int v : shared_.own_velocities)
    for (int k = 0; k < n; ++k) *to++ = from[std::size_t{lanes} * v + k];
}

template <int n>
void SharedProducts<n>::receive(Vec x, Ghosts& ghosts) {
  petsc_check(VecScatterBegin(ghosts.scatter, x, ghosts.received, INSERT_VALUES, SCATTER_FORWARD));
  petsc_check(VecScatterEnd(ghosts.scatter, x, ghosts.received, INSERT_VALUES, SCATTER_FORWARD));
  const double* from = nullptr;
  petsc_check(VecGetArrayRead(ghosts.received, &from));
  for (std::size_t i = 0; i < ghosts.places.size(); ++i) local_[ghosts.places[i]] = static_cast<float>(from[i]);
  petsc_check(VecRestoreArrayRead(ghosts.received, &from));
}

template <int n>
void SharedProducts<n>::multiply(Vec x, Vec y) {
  receive(x, of_both_);
  take_velocities(x, local_);
  const double* from = nullptr;
  petsc_check(VecGetArrayRead(x, &from));
  for (std::size_t i = 0; i < shared_.own_pressures.size(); ++i)
    local_[matrix_.velocity_size() + shared_.own_pressures[i]] = static_cast<float>(from[shared_.velocity_rows + i]);
  petsc_check(VecRestoreArrayRead(x, &from));
  matrix_.multiply(local_, product_);
  double* to = nullptr;
  petsc_check(VecGetArrayWrite(y, &to));
  give_velocities(product_, to);
  for (std::size_t i = 0; i < shared_.own_pressures.size(); ++i)
    to[shared_.velocity_rows + i] = product_[matrix_.velocity_size() + shared_.own_pressures[i]];
  petsc_check(VecRestoreArrayWrite(y, &to));
}

template <int n>
double SharedProducts<n>::rounding(Vec x) {
  take_velocities(x, local_);
  return matrix_.rounding(local_);
}

template <int n>
void SharedProducts<n>::divergence(Vec x, Vec pressures) {
  receive(x, of_both_);
  take_velocities(x, local_);
  double* to = nullptr;
  petsc_check(VecGetArrayWrite(pressures, &to));
  const auto& own = shared_.own_pressures;
  parallel_for(own.size(), own.size() > 500,
               [&](std::size_t i) { to[i] = matrix_.divergence_product(own[i], local_.data()); });
  petsc_check(VecRestoreArrayWrite(pressures, &to));
}

template <int n>
void SharedProducts<n>::subtract_gradient(Vec pressures, Vec velocities) {
  receive(pressures, of_pressures_);
  float* const local = local_.data() + matrix_.velocity_size();
  const double* from = nullptr;
  petsc_check(VecGetArrayRead(pressures, &from));
  for (std::size_t i = 0; i < shared_.own_pressures.size(); ++i)
    local[shared_.own_pressures[i]] = static_cast<float>(from[i]);
  petsc_check(VecRestoreArrayRead(pressures, &from));
  double* to = nullptr;
  petsc_check(VecGetArray(velocities, &to));
  const auto& own = shared_.own_velocities;
  parallel_for(own.size(), own.size() > 2000, [&](std::size_t i) {
    const auto gradient = matrix_.gradient_product(own[i], local);
    for (int k = 0; k < n; ++k) to[n * i + k] -= gradient[k];
  });
  petsc_check(VecRestoreArray(velocities, &to));
}

template <int n>
void SharedProducts<n>::sweep(Vec residual, Vec velocities) {
  take_velocities(residual, residual_);
  sweep_.apply(residual_, velocity_);
  for (int sweep = 1; sweep < sweeps_; ++sweep) {
    const float* const last = (sweep == 1 ? velocity_ : again_).data();
    for (const int v : shared_.own_velocities) {
      float* left = residual_.data() + std::size_t{lanes} * v;
      store<n>(load<n>(left) - sweep_.product(v, last), left);
    }
    sweep_.apply(residual_, again_);
    for (std::size_t i = 0; i < velocity_.size(); ++i) velocity_[i] += again_[i];
  }
  double* to = nullptr;
  petsc_check(VecGetArrayWrite(velocities, &to));
  give_velocities(velocity_, to);
  petsc_check(VecRestoreArrayWrite(velocities, &to));
}

#define FSI_INSTANTIATE(n) template class SharedProducts<n>;
FSI_FOR_EACH_DIMENSION(FSI_INSTANTIATE)

}  // namespace fsi
