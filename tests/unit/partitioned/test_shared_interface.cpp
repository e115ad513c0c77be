/// Interface vectors shared out among processes, against the same vectors whole. All processes run this together.
#include <gtest/gtest.h>

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "model_maps.hpp"
#include "partitioned/accelerators/filtered_qr.hpp"
#include "partitioned/accelerators/iqn_ils.hpp"
#include "partitioned/accelerators/iqn_imvj.hpp"
#include "partitioned/accelerators/low_rank_map.hpp"
#include "partitioned/accelerators/newton_krylov.hpp"
#include "partitioned/accelerators/relaxation.hpp"

namespace fsi::test {

namespace {

using Vector = std::vector<double>;

const Communicator& world() {
  return Communicator::world();
}

/// Numbers of a whole vector at this process: its own, then copies of two others' numbers. Of three processes
/// the second has none of its own, and the third no copies.
class Shares {
 public:
  explicit Shares(int size) {
    std::vector<int> owners;
    for (int r = 0; r < world().size(); ++r)
      if (r != 1 || world().size() == 2) owners.push_back(r);
    for (int i = 0; i < size; ++i)
      if (owners[i * 7 % 5 % static_cast<int>(owners.size())] == world().rank()) places_.push_back(i);
    own_ = places_.size();
    if (world().rank() == 2) return;
    std::vector<char> mine(static_cast<std::size_t>(size), 0);
    for (const int i : places_) mine[i] = 1;
    for (int i = size - 1; i >= 0 && places_.size() < own_ + 2; --i)
      if (!mine[i]) places_.push_back(i);
  }

  InterfaceSpace space() const { return {world(), own_}; }
  Vector here(const Vector& whole) const {
    Vector part;
    for (const int i : places_) part.push_back(whole[i]);
    return part;
  }
  std::vector<Vector> here(const std::vector<Vector>& whole) const {
    std::vector<Vector> parts;
    for (const auto& column : whole) parts.push_back(here(column));
    return parts;
  }
  void expect_same(const Vector& part, const Vector& whole, double tolerance, const std::string& where) const {
    const double bound = tolerance * norm(whole);
    ASSERT_EQ(part.size(), places_.size());
    for (std::size_t i = 0; i < part.size(); ++i) EXPECT_NEAR(part[i], whole[places_[i]], bound) << where;
  }

 private:
  std::vector<int> places_;
  std::size_t own_ = 0;
};

std::vector<const Vector*> pointers(const std::vector<Vector>& columns) {
  std::vector<const Vector*> list;
  for (const auto& column : columns) list.push_back(&column);
  return list;
}

std::vector<Vector> some_columns(int size) {
  std::vector<Vector> columns;
  for (int j = 0; j < 6; ++j) {
    columns.emplace_back(static_cast<std::size_t>(size));
    for (int i = 0; i < size; ++i) columns.back()[i] = std::cos(1.3 * i * (j + 1) + j) + (j > 3 ? 1e-3 * i : 0);
  }
  for (int i = 0; i < size; ++i) columns[2][i] = 2 * columns[0][i] + 1e-4 * columns[1][i];  // adds next to nothing
  return columns;
}

TEST(SharedInterface, CountsEachNumberOnceAndInOneMessage) {
  const Shares shares(11);
  const auto columns = some_columns(11);
  const auto parts = shares.here(columns);
  const auto space = shares.space();
  EXPECT_EQ(space.size(parts[0]), 11);
  const auto before = world().traffic().reductions;
  const Vector products = space.dots(parts, parts[3]);
  EXPECT_EQ(world().traffic().reductions - before, world().is_alone() ? 0 : 1);
  for (std::size_t j = 0; j < columns.size(); ++j) {
    EXPECT_NEAR(products[j], dot(columns[j], columns[3]), 1e-13);
    EXPECT_NEAR(space.dot(parts[j], parts[3]), dot(columns[j], columns[3]), 1e-13);
    EXPECT_NEAR(space.norm(parts[j]), norm(columns[j]), 1e-13);
  }
}

TEST(SharedInterface, AloneHasTheSameBits) {
  if (!world().is_alone()) GTEST_SKIP() << "of one process";
  const auto columns = some_columns(37);
  const InterfaceSpace space(world(), 37);
  EXPECT_EQ(space.dot(columns[0], columns[1]), dot(columns[0], columns[1]));
  EXPECT_EQ(space.norm(columns[1]), norm(columns[1]));
  const FilteredQr whole(pointers(columns), 1e-2), shared(pointers(columns), 1e-2, space);
  EXPECT_EQ(whole.kept(), shared.kept());
  EXPECT_EQ(whole.pseudo_inverse(), shared.pseudo_inverse());
}

TEST(SharedInterface, QrDropsAndSolvesAlike) {
  const Shares shares(17);
  const auto columns = some_columns(17);
  const auto parts = shares.here(columns);
  const FilteredQr whole(pointers(columns), 1e-2), shared(pointers(parts), 1e-2, shares.space());
  EXPECT_EQ(whole.kept(), (std::vector<std::size_t>{0, 1, 3, 4, 5}));
  EXPECT_EQ(shared.kept(), whole.kept());
  Vector b(17);
  for (std::size_t i = 0; i < b.size(); ++i) b[i] = 1.0 / (1.0 + static_cast<double>(i));
  const Vector c = whole.least_squares(b), c_here = shared.least_squares(shares.here(b));
  ASSERT_EQ(c.size(), c_here.size());
  for (std::size_t j = 0; j < c.size(); ++j) EXPECT_NEAR(c[j], c_here[j], 1e-13);
  const auto rows = whole.pseudo_inverse(), rows_here = shared.pseudo_inverse();
  for (std::size_t j = 0; j < rows.size(); ++j) shares.expect_same(rows_here[j], rows[j], 1e-13, "row of V^+");
}

TEST(SharedInterface, MapsAreTruncatedAlike) {
  const Shares shares(17);
  const auto columns = some_columns(17);
  const auto space = shares.space();
  LowRankMap whole, shared(space);
  for (std::size_t j = 0; j + 1 < columns.size(); ++j) {
    Vector a = columns[j], b = columns[j + 1];
    scale(std::pow(0.1, static_cast<double>(j)), a);
    shared.add(shares.here(a), shares.here(b));
    whole.add(a, b);
  }
  whole.add(columns[0], columns[0]);  // nothing new on the left
  shared.add(shares.here(columns[0]), shares.here(columns[0]));
  const Vector x = columns[4];
  shares.expect_same(shared.times(shares.here(x)), whole.times(x), 1e-14, "all terms");
  for (const std::size_t rank : {5u, 3u, 1u}) {
    whole.truncate(rank, 1e-4);
    shared.truncate(rank, 1e-4);
    EXPECT_EQ(shared.rank(), whole.rank());
    shares.expect_same(shared.times(shares.here(x)), whole.times(x), 1e-12, "rank " + std::to_string(rank));
  }
  LowRankMap nothing(space);
  nothing.add(shares.here(Vector(17, 0.0)), shares.here(x));
  nothing.truncate(1, 0);
  shares.expect_same(nothing.times(shares.here(x)), Vector(17, 0.0), 0, "of zero");
}

struct Method {
  std::string name;
  std::function<std::unique_ptr<Accelerator>(const QuasiNewtonOptions&, const InterfaceSpace&)> make;
};

class SharedAccelerator : public testing::TestWithParam<Method> {
 protected:
  using Made = std::unique_ptr<Accelerator>;
  static constexpr int size = 12;

  Made whole(const QuasiNewtonOptions& options) const { return GetParam().make(options, {}); }
  Made shared(const QuasiNewtonOptions& options) const { return GetParam().make(options, shares_.space()); }

  /// One step of both: the pass is of the whole vectors, so that what is compared is one correction's rounding.
  void step(Accelerator& of_whole, Accelerator& of_parts, const AddedMassMap& map, Vector& x, int passes) {
    of_whole.start();
    of_parts.start();
    Vector r = map.residual(x);
    for (int k = 0; k < passes; ++k) {
      Vector x_here = shares_.here(x);
      of_whole.aim(1e-9);
      of_parts.aim(1e-9);
      of_parts.correct(x_here, shares_.here(r));
      of_whole.correct(x, r);
      ASSERT_TRUE(all_finite(x));
      shares_.expect_same(x_here, x, 1e-12, GetParam().name + ", pass " + std::to_string(k));
      EXPECT_EQ(of_parts.status().columns, of_whole.status().columns);
      EXPECT_EQ(of_parts.allows_change(), of_whole.allows_change());
      r = map.residual(x);
    }
    of_whole.accept(x, r);
    of_parts.accept(shares_.here(x), shares_.here(r));
  }

  Shares shares_{size};
};

TEST_P(SharedAccelerator, CorrectsAsOnOneProcess) {
  QuasiNewtonOptions options;
  options.columns = 7;  // so that terms are dropped, and maps truncated
  options.mixing = 0.5;
  const auto of_whole = whole(options), of_parts = shared(options);
  Vector x(size, 0.0);
  for (int k = 0; k < 3; ++k) step(*of_whole, *of_parts, {size, 0.2, 0.2 * k}, x, 6);
  of_whole->change(false);
  of_parts->change(false);
  for (int k = 3; k < 5; ++k) step(*of_whole, *of_parts, {size, 0.3, 0.2 * k}, x, 5);
  of_whole->start();
  of_parts->start();
  of_whole->abandon();
  of_parts->abandon();
  step(*of_whole, *of_parts, {size, 0.3, 1}, x, 3);
}

// A process without interface nodes remembers empty arrays, and how many.
TEST_P(SharedAccelerator, GoesOnFromItsMemory) {
  const QuasiNewtonOptions options;
  const auto of_whole = whole(options), of_parts = shared(options), restarted = shared(options);
  Vector x(size, 0.0);
  step(*of_whole, *of_parts, {size, 0.2}, x, 5);
  WrittenArchive archive = archive_of(*of_parts);
  restarted->keep(archive.turn());
  step(*of_whole, *restarted, {size, 0.2, 0.3}, x, 4);
}

template <class T>
Method quasi_newton(const std::string& name) {
  return {name, [](const QuasiNewtonOptions& o, const InterfaceSpace& s) { return std::make_unique<T>(o, s); }};
}

INSTANTIATE_TEST_SUITE_P(All, SharedAccelerator,
                         testing::Values(Method{"aitken",
                                                [](const QuasiNewtonOptions&, const InterfaceSpace& s) {
                                                  return std::make_unique<AitkenRelaxation>(0.01, 0.05, s);
                                                }},
                                         quasi_newton<IqnIls>("iqn_ils"), quasi_newton<IqnImvj>("iqn_imvj"),
                                         quasi_newton<NewtonKrylov>("newton_krylov")),
                         [](const auto& test) { return test.param.name; });

}  // namespace

}  // namespace fsi::test
