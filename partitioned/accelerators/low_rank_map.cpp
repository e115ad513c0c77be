#include "partitioned/accelerators/low_rank_map.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cassert>
#include <utility>

#include "algebra/vector_operations.hpp"

namespace fsi {

namespace {

Eigen::MatrixXd matrix_of(const std::vector<std::vector<double>>& columns, std::size_t rows) {
  Eigen::MatrixXd m(rows, columns.size());
  for (std::size_t j = 0; j < columns.size(); ++j)
    m.col(static_cast<Eigen::Index>(j)) =
        Eigen::Map<const Eigen::VectorXd>(columns[j].data(), static_cast<Eigen::Index>(columns[j].size()));
  return m;
}

std::vector<std::vector<double>> columns_of(const Eigen::MatrixXd& m) {
  std::vector<std::vector<double>> columns;
  for (Eigen::Index j = 0; j < m.cols(); ++j) columns.emplace_back(m.col(j).data(), m.col(j).data() + m.rows());
  return columns;
}

/// Q and R of the thin factorisation of vectors that are shared out, by Gram-Schmidt twice; Q has no column for what is
/// a combination of those before.
std::pair<Eigen::MatrixXd, Eigen::MatrixXd> shared_thin_qr(const std::vector<std::vector<double>>& columns,
                                                           const InterfaceSpace& space) {
  constexpr double rounding = 1e-13;
  const auto count = static_cast<Eigen::Index>(columns.size());
  Eigen::MatrixXd r = Eigen::MatrixXd::Zero(count, count);
  std::vector<std::vector<double>> q;
  for (Eigen::Index j = 0; j < count; ++j) {
    std::vector<double> v = columns[static_cast<std::size_t>(j)];
    const double length = space.norm(v);
    for (int sweep = 0; sweep < 2; ++sweep) {
      const std::vector<double> along = space.subtract_projections(q, v);
      for (std::size_t i = 0; i < q.size(); ++i) r(static_cast<Eigen::Index>(i), j) += along[i];
    }
    const double left = space.norm(v);
    if (!(left > rounding * length)) continue;
    r(static_cast<Eigen::Index>(q.size()), j) = left;
    scale(1 / left, v);
    q.push_back(std::move(v));
  }
  Eigen::MatrixXd rows = r.topRows(static_cast<Eigen::Index>(q.size()));
  return {matrix_of(q, columns.front().size()), std::move(rows)};
}

/// Q and R of the thin factorisation.
std::pair<Eigen::MatrixXd, Eigen::MatrixXd> thin_qr(const std::vector<std::vector<double>>& columns,
                                                    const InterfaceSpace& space) {
  if (!space.is_whole()) return shared_thin_qr(columns, space);
  const Eigen::MatrixXd m = matrix_of(columns, columns.front().size());
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(m);
  const Eigen::Index rank = std::min(m.rows(), m.cols());
  Eigen::MatrixXd q = qr.householderQ() * Eigen::MatrixXd::Identity(m.rows(), rank);
  Eigen::MatrixXd r = qr.matrixQR().topRows(rank).triangularView<Eigen::Upper>();
  return {std::move(q), std::move(r)};
}

}  // namespace

void LowRankMap::clear() {
  a_.clear();
  b_.clear();
}

void LowRankMap::add(std::vector<double> a, std::vector<double> b) {
  assert(a.size() == b.size());
  a_.push_back(std::move(a));
  b_.push_back(std::move(b));
}

std::vector<double> LowRankMap::times(const std::vector<double>& x) const {
  std::vector<double> y(x.size(), 0.0);
  const std::vector<double> weights = space_.dots(b_, x);
  for (std::size_t i = 0; i < a_.size(); ++i) axpy(weights[i], a_[i], y);
  return y;
}

void LowRankMap::truncate(std::size_t rank, double tolerance) {
  if (a_.empty()) return;
  const auto [qa, ra] = thin_qr(a_, space_);
  const auto [qb, rb] = thin_qr(b_, space_);
  if (ra.rows() == 0 || rb.rows() == 0) return clear();
  const Eigen::MatrixXd core = ra * rb.transpose();
#if EIGEN_VERSION_AT_LEAST(3, 4, 90)
  const Eigen::BDCSVD<Eigen::MatrixXd, Eigen::ComputeThinU | Eigen::ComputeThinV> svd(core);
#else
  const Eigen::BDCSVD<Eigen::MatrixXd> svd(core, Eigen::ComputeThinU | Eigen::ComputeThinV);
#endif
  const auto& values = svd.singularValues();
  Eigen::Index keep = 0;
  while (keep < values.size() && keep < static_cast<Eigen::Index>(rank) && values[keep] > tolerance * values[0]) ++keep;
  const Eigen::MatrixXd left = qa * svd.matrixU().leftCols(keep) * values.head(keep).asDiagonal();
  const Eigen::MatrixXd right = qb * svd.matrixV().leftCols(keep);
  a_ = columns_of(left);
  b_ = columns_of(right);
}

void LowRankMap::keep(RestartArchive& archive, const std::string& name) {
  if (archive.recalls()) clear();
  if (!archive.wants({name + ".rank", name + ".a", name + ".b"})) return;
  std::vector<double> a, b;
  for (const auto& column : a_) a.insert(a.end(), column.begin(), column.end());
  for (const auto& column : b_) b.insert(b.end(), column.begin(), column.end());
  auto rank = static_cast<double>(a_.size());
  archive.number(name + ".rank", rank, count_range);
  const auto columns = static_cast<std::size_t>(rank);
  archive.array(name + ".a", ArrayKind::interface_columns, a, {{}, columns});
  archive.array(name + ".b", ArrayKind::interface_columns, b, {{}, columns});
  if (!archive.recalls() || columns == 0) return;
  const auto size = static_cast<std::ptrdiff_t>(a.size() / columns);
  for (std::ptrdiff_t i = 0; i < static_cast<std::ptrdiff_t>(columns); ++i)
    add({a.begin() + i * size, a.begin() + (i + 1) * size}, {b.begin() + i * size, b.begin() + (i + 1) * size});
}

}  // namespace fsi
