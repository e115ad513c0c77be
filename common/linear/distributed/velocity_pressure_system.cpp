#include "linear/distributed/velocity_pressure_system.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

#include "fem/dimensions.hpp"
#include "linear/distributed/matrix_arrays.hpp"

namespace fsi {

template <int n>
VelocityPressureSystem<n>::VelocityPressureSystem(const JacobianBlocks<n>& blocks,
                                                  const VelocityPressureLayout<n>& layout)
    : blocks_(blocks, layout),
      layout_(layout),
      shared_(blocks, layout),
      communicator_(petsc_communicator(*blocks.numbering.processes)),
      processes_(*blocks.numbering.processes),
      pattern_([&] {
        Pattern pattern;
        pattern.offsets = {0};
        std::vector<int> row;
        for (int v = 0; v < layout.velocities; ++v) {
          row.clear();
          if (shared_.owns_velocity[v])
            blocks_.for_blocks_of(v, [&](const double*, int u, int, double) {
              if (u >= 0) row.push_back(u);
            });
          std::sort(row.begin(), row.end());
          row.erase(std::unique(row.begin(), row.end()), row.end());
          pattern.columns.insert(pattern.columns.end(), row.begin(), row.end());
          pattern.offsets.push_back(static_cast<int>(pattern.columns.size()));
        }
        return pattern;
      }()),
      shape_derivatives_(blocks, layout),
      products_(blocks, layout, shared_, communicator_),
      row_scale_(petsc_vector(communicator_, shared_.pressure_rows)) {
  make_lists();
}

template <int n>
bool VelocityPressureSystem<n>::has_few_pressures() const {
  return 2 * shared_.whole_pressures < shared_.whole_velocities;
}

template <int n>
void VelocityPressureSystem<n>::make_momentum() {
  std::vector<PetscInt> offsets{0}, columns;
  std::vector<int> order;  // positions of a row by their columns among all processes'
  block_at_.resize(pattern_.columns.size());
  const PetscInt first = shared_.first_velocity, end = first + static_cast<PetscInt>(shared_.own_velocities.size());
  const auto number = [&](int at) { return shared_.velocity_number[pattern_.columns[at]]; };
  std::size_t own = 0, other = 0;
  for (const int v : shared_.own_velocities) {
    order.resize(pattern_.offsets[v + 1] - pattern_.offsets[v]);
    std::iota(order.begin(), order.end(), pattern_.offsets[v]);
    std::sort(order.begin(), order.end(), [&](int a, int b) { return number(a) < number(b); });
    for (const int at : order) {
      columns.push_back(number(at));
      block_at_[at] = number(at) >= first && number(at) < end ? own++ : other++;
    }
    offsets.push_back(static_cast<PetscInt>(columns.size()));
  }
  petsc_check(MatCreate(communicator_, momentum_.fresh()));
  petsc_check(MatSetSizes(momentum_, shared_.velocity_rows, shared_.velocity_rows, PETSC_DECIDE, PETSC_DECIDE));
  petsc_check(MatSetType(momentum_, MATBAIJ));
  petsc_check(MatSeqBAIJSetPreallocationCSR(momentum_, n, offsets.data(), columns.data(), nullptr));
  petsc_check(MatMPIBAIJSetPreallocationCSR(momentum_, n, offsets.data(), columns.data(), nullptr));
}

template <int n>
void VelocityPressureSystem<n>::make_lists() {
  std::vector<PetscInt> scaled_rows, scaled_columns, rows, columns;
  for (const int v : shared_.own_velocities)
    blocks_.for_blocks_of(v, [&](const double*, int, int p, double) {
      for (int k = 0; k < n && p >= 0; ++k) {
        scaled_rows.push_back(shared_.velocity_place[v] + k);
        scaled_columns.push_back(shared_.pressure_number[p]);
      }
    });
  for (const int p : shared_.own_pressures) {
    scaled_rows.push_back(shared_.pressure_place[p]);
    scaled_columns.push_back(shared_.pressure_number[p]);
    blocks_.for_blocks_of_node(layout_.wall_pressure[p] != 0, layout_.node_of_pressure[p],
                               [&](const double*, int v, int q, double) {
                                 for (int k = 0; k < n && v >= 0; ++k) {
                                   rows.push_back(shared_.pressure_number[p]);
                                   columns.push_back(shared_.velocity_place[v] + k);
                                 }
                                 if (q < 0) return;
                                 rows.push_back(shared_.pressure_number[p]);
                                 columns.push_back(shared_.pressure_place[q]);
                               });
  }
  continuity_ = {communicator_, shared_.pressure_rows, shared_.rows(), std::move(rows), columns};
  scaled_gradient_ = {communicator_, shared_.rows(), shared_.pressure_rows, std::move(scaled_rows), scaled_columns};
}

template <int n>
void VelocityPressureSystem<n>::fill() {
  products_.fill(diagonals_, has_few_pressures(), processes_);
  momentum_filled_ = false;
  fill_scaled_gradient();
  fill_continuity();
}

template <int n>
Mat VelocityPressureSystem<n>::momentum() {
  if (!momentum_) make_momentum();
  if (!std::exchange(momentum_filled_, true)) fill_momentum();
  return momentum_;
}

template <int n>
void VelocityPressureSystem<n>::fill_momentum() {
  petsc_check(MatZeroEntries(momentum_));
  {
    const MatrixArrays arrays(momentum_);
    const auto block_of = [&](int position) {
      return (shared_.owns_velocity[pattern_.columns[position]] ? arrays.own() : arrays.other()) +
             block_at_[position] * n * n;
    };
    for (const int v : shared_.own_velocities) {
      blocks_.for_blocks_of(v, [&](const double* block, int u, int, double factor) {
        if (u < 0) return;
        double* a = block_of(pattern_.position(v, u));
        for (int i = 0; i < n; ++i)
          for (int k = 0; k < n; ++k) a[k * n + i] += factor * block[MixedLayout<n>::in_block(i, k)];
      });
      shape_derivatives_.for_row(
          v, [&](int u, int i, int k, double value) { block_of(pattern_.position(v, u))[k * n + i] += value; });
    }
  }
  petsc_check(MatAssemblyBegin(momentum_, MAT_FINAL_ASSEMBLY));
  petsc_check(MatAssemblyEnd(momentum_, MAT_FINAL_ASSEMBLY));
}

template <int n>
void VelocityPressureSystem<n>::fill_scaled_gradient() {
  const auto& inverse = diagonals_.inverse();
  scaled_gradient_.fill([&](auto add) {
    for (const int v : shared_.own_velocities)
      blocks_.for_blocks_of(v, [&](const double* block, int, int p, double) {
        for (int k = 0; k < n && p >= 0; ++k)
          add(-inverse[VectorLayout<n>::vector(v) + k] * block[MixedLayout<n>::in_block(k, n)]);
      });
    for (std::size_t i = 0; i < shared_.own_pressures.size(); ++i) add(1.0);
  });
}

template <int n>
void VelocityPressureSystem<n>::fill_continuity() {
  double* scale = nullptr;
  petsc_check(VecGetArray(row_scale_, &scale));
  continuity_.fill([&](auto add) {
    for (std::size_t i = 0; i < shared_.own_pressures.size(); ++i) {
      const int pressure = shared_.own_pressures[i];
      scale[i] = layout_.row_scale(pressure);
      blocks_.for_blocks_of_node(layout_.wall_pressure[pressure] != 0, layout_.node_of_pressure[pressure],
                                 [&](const double* block, int v, int q, double factor) {
                                   for (int k = 0; k < n && v >= 0; ++k)
                                     add(factor * block[MixedLayout<n>::in_block(n, k)]);
                                   if (q >= 0) add(block[MixedLayout<n>::in_block(n, n)]);
                                 });
    }
  });
  petsc_check(VecRestoreArray(row_scale_, &scale));
}

template <int n>
void VelocityPressureSystem<n>::make_schur_complement(double wall_diagonal_factor) {
  const bool first = !schur_;
  petsc_check(MatMatMult(continuity_, scaled_gradient_, first ? MAT_INITIAL_MATRIX : MAT_REUSE_MATRIX, PETSC_DEFAULT,
                         schur_.at()));
  petsc_check(MatDiagonalScale(schur_, row_scale_, nullptr));
  if (wall_diagonal_factor == 1) return;
  OwnedVec diagonal = petsc_vector(communicator_, shared_.pressure_rows);
  petsc_check(MatGetDiagonal(schur_, diagonal));
  double* d = nullptr;
  petsc_check(VecGetArray(diagonal, &d));
  for (std::size_t i = 0; i < shared_.own_pressures.size(); ++i)
    if (layout_.wall_pressure[shared_.own_pressures[i]]) d[i] *= wall_diagonal_factor;
  petsc_check(VecRestoreArray(diagonal, &d));
  petsc_check(MatDiagonalSet(schur_, diagonal, INSERT_VALUES));
}

template <int n>
void VelocityPressureSystem<n>::reduce(Vec rows, Vec of_pressures) {
  if (!predicted_) predicted_ = petsc_vector(communicator_, shared_.rows());
  const double* from = nullptr;
  double* to = nullptr;
  petsc_check(VecGetArrayRead(rows, &from));
  petsc_check(VecGetArrayWrite(predicted_, &to));
  const auto& inverse = diagonals_.inverse();
  std::size_t at = 0;
  for (const int v : shared_.own_velocities)
    for (int k = 0; k < n; ++k, ++at) to[at] = inverse[VectorLayout<n>::vector(v, k)] * from[at];
  std::fill_n(to + at, shared_.own_pressures.size(), 0.0);
  petsc_check(VecRestoreArrayWrite(predicted_, &to));
  products_.divergence(predicted_, of_pressures);
  petsc_check(VecGetArray(of_pressures, &to));
  for (std::size_t i = 0; i < shared_.own_pressures.size(); ++i)
    to[i] = layout_.row_scale(shared_.own_pressures[i]) * (from[at + i] - to[i]);
  petsc_check(VecRestoreArray(of_pressures, &to));
  petsc_check(VecRestoreArrayRead(rows, &from));
}

template <int n>
VelocityPressureSystem<n>::Parts::Parts(const VelocityPressureSystem& system, Vec velocities, Vec pressures, Vec x,
                                        bool writes)
    : velocities_(velocities), pressures_(pressures), x_(x), writes_(writes) {
  double* array = nullptr;
  if (writes) {
    petsc_check(VecGetArrayWrite(x, &array));
    array_ = array;
  } else {
    petsc_check(VecGetArrayRead(x, &array_));
  }
  petsc_check(VecPlaceArray(velocities, array_));
  petsc_check(VecPlaceArray(pressures, array_ + system.shared().velocity_rows));
}

template <int n>
VelocityPressureSystem<n>::Parts::~Parts() {
  VecResetArray(velocities_);
  VecResetArray(pressures_);
  double* array = const_cast<double*>(array_);
  if (writes_)
    VecRestoreArrayWrite(x_, &array);
  else
    VecRestoreArrayRead(x_, &array_);
}

template <int n>
std::unique_ptr<typename VelocityPressureSystem<n>::WallMomentum> VelocityPressureSystem<n>::make_wall_momentum()
    const {
  auto wall = std::make_unique<WallMomentum>();
  // Numbers of the wall's velocities among all processes' ones.
  std::vector<double> numbers(layout_.wall_of_velocity.size(), -1.0);
  for (std::size_t i = 0; i < shared_.own_velocities.size(); ++i) {
    const int v = shared_.own_velocities[i];
    if (layout_.wall_of_velocity[v] < 0) continue;
    wall->own.push_back(static_cast<int>(i));
    wall->points.push_back(blocks_.wall_points()[layout_.wall_of_velocity[v]]);
  }
  const auto own = static_cast<std::int64_t>(wall->own.size());
  const std::int64_t first = processes_.sum_before(own);
  for (std::int64_t i = 0; i < own; ++i) numbers[shared_.own_velocities[wall->own[i]]] = static_cast<double>(first + i);
  shared_.update_velocities(numbers);
  const auto for_blocks = [&](auto work) {
    for (const int i : wall->own) {
      const int v = shared_.own_velocities[i];
      for (int at = pattern_.offsets[v]; at < pattern_.offsets[v + 1]; ++at)
        if (layout_.wall_of_velocity[pattern_.columns[at]] >= 0) work(v, at);
    }
  };
  for_blocks([&](int, int at) { wall->from.push_back(at); });
  std::vector<PetscInt> rows, columns;  // the largest lists of all: not a place more than they need
  rows.reserve(wall->from.size() * n * n);
  columns.reserve(wall->from.size() * n * n);
  for_blocks([&](int v, int at) {
    for (int k = 0; k < n; ++k)
      for (int row = 0; row < n; ++row) {
        rows.push_back(static_cast<PetscInt>(numbers[v]) * n + row);
        columns.push_back(static_cast<PetscInt>(numbers[pattern_.columns[at]]) * n + k);
      }
  });
  const auto size = static_cast<PetscInt>(own * n);
  wall->matrix = {communicator_, size, size, std::move(rows), columns, n};
  return wall;
}

template <int n>
void VelocityPressureSystem<n>::fill_wall_momentum(WallMomentum& wall) {
  const MatrixArrays arrays(momentum());
  wall.matrix.fill([&](auto add) {
    for (const int at : wall.from) {
      const double* block =
          (shared_.owns_velocity[pattern_.columns[at]] ? arrays.own() : arrays.other()) + block_at_[at] * n * n;
      for (int entry = 0; entry < n * n; ++entry) add(block[entry]);
    }
  });
}

template <int n>
double VelocityPressureSystem<n>::bytes() const {
  double sum = products_.bytes();
  for (Mat matrix : {Mat(momentum_), Mat(continuity_), Mat(scaled_gradient_), Mat(schur_)}) sum += petsc_bytes(matrix);
  return sum;
}

#define FSI_INSTANTIATE(n) template class VelocityPressureSystem<n>;
FSI_FOR_EACH_DIMENSION(FSI_INSTANTIATE)

}  // namespace fsi
