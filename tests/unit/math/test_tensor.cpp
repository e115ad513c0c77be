#include <gtest/gtest.h>

#include <cmath>

#include "math/tensor.hpp"
#include "support/random.hpp"

namespace fsi::test {

namespace {

using M = Mat3<Pack>;
using V = Vec3<Pack>;
using S = Sym3<Pack>;

M random_matrix(unsigned seed) {
  Random random(seed);
  M m;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      for (int lane = 0; lane < pack_width; ++lane) m(i, j).set(lane, random());
  return m;
}
V random_vector(unsigned seed) {
  const M m = random_matrix(seed);
  return {{m(0, 0), m(1, 1), m(2, 2)}};
}
S random_symmetric(unsigned seed) {
  const M m = random_matrix(seed);
  S s;
  for (int i = 0; i < 3; ++i)
    for (int j = i; j < 3; ++j) s(i, j) = m(i, j);
  return s;
}
/// The components of one lane, written out.
struct Plain {
  double c[3][3];
};
template <class Tensor>
Plain plain(const Tensor& t, int lane) {
  Plain p;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) p.c[i][j] = t(i, j)[lane];
  return p;
}
Plain product(const Plain& a, const Plain& b, bool a_transposed = false, bool b_transposed = false) {
  Plain p{};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      for (int k = 0; k < 3; ++k)
        p.c[i][j] += (a_transposed ? a.c[k][i] : a.c[i][k]) * (b_transposed ? b.c[j][k] : b.c[k][j]);
  return p;
}
template <class Tensor>
void expect_equal(const Tensor& t, int lane, const Plain& expected) {
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) EXPECT_NEAR(t(i, j)[lane], expected.c[i][j], 2e-15) << i << j;
}

constexpr int last = pack_width - 1;

TEST(Tensor, VectorAlgebra) {
  const V a = random_vector(1), b = random_vector(2);
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ((a + b)[i][last], a[i][last] + b[i][last]);
    EXPECT_EQ((a - b)[i][last], a[i][last] - b[i][last]);
    EXPECT_EQ((Pack(2.0) * a)[i][last], 2 * a[i][last]);
  }
  const V c = cross(a, b);
  EXPECT_NEAR(dot(c, a)[last], 0, 1e-15);
  EXPECT_NEAR(dot(c, b)[last], 0, 1e-15);
  // |a x b|^2 = |a|^2 |b|^2 - (a . b)^2, and e_x x e_y = e_z for the sign.
  EXPECT_NEAR(dot(c, c)[last], (dot(a, a) * dot(b, b) - dot(a, b) * dot(a, b))[last], 1e-15);
  const V ex{{Pack(1.0), Pack(0.0), Pack(0.0)}}, ey{{Pack(0.0), Pack(1.0), Pack(0.0)}};
  EXPECT_EQ(cross(ex, ey)[2][0], 1.0);
}

TEST(Tensor, ProductsOfMatrices) {
  const M a = random_matrix(3), b = random_matrix(4);
  const Plain pa = plain(a, last), pb = plain(b, last);
  expect_equal(a * b, last, product(pa, pb));
  expect_equal(times_transposed(a, b), last, product(pa, pb, false, true));
  expect_equal(gram(a), last, product(pa, pa, true, false));
  const S s = random_symmetric(5);
  expect_equal(a * s, last, product(pa, plain(s, last)));
  expect_equal(congruence(s, a), last, product(product(pa, plain(s, last), true, false), pa));
  const V v = random_vector(6);
  for (int i = 0; i < 3; ++i) {
    double av = 0, atv = 0, sv = 0;
    for (int j = 0; j < 3; ++j) {
      av += pa.c[i][j] * v[j][last];
      atv += pa.c[j][i] * v[j][last];
      sv += s(i, j)[last] * v[j][last];
    }
    EXPECT_NEAR((a * v)[i][last], av, 1e-15);
    EXPECT_NEAR(transposed_times(a, v)[i][last], atv, 1e-15);
    EXPECT_NEAR((s * v)[i][last], sv, 1e-15);
  }
  EXPECT_NEAR(trace(a)[last], pa.c[0][0] + pa.c[1][1] + pa.c[2][2], 1e-15);
}

TEST(Tensor, SymmetricStorageReachesEveryComponentOnce) {
  S s;
  for (int k = 0; k < 6; ++k) s.c[k] = Pack(-1.0);
  double next = 0;
  for (int i = 0; i < 3; ++i)
    for (int j = i; j < 3; ++j) s(i, j) = Pack(next++);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) EXPECT_EQ(s(i, j)[0], s(j, i)[0]);
  double sum = 0;
  for (int k = 0; k < 6; ++k) sum += s.c[k][0];
  EXPECT_EQ(sum, 15.0) << "0 + 1 + ... + 5: no component shared, none missed";
}

TEST(Tensor, ContractionCountsOffDiagonalsTwice) {
  const S s = random_symmetric(7), t = random_symmetric(8);
  double expected = 0;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) expected += s(i, j)[last] * t(i, j)[last];
  EXPECT_NEAR(contract(s, t)[last], expected, 1e-15);
  EXPECT_EQ(contract(identity<Pack>(), s)[0], trace(s)[0]);
}

TEST(Tensor, SumsAndMultiples) {
  const M a = random_matrix(9), b = random_matrix(10);
  const S s = random_symmetric(11), t = random_symmetric(12);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      EXPECT_EQ((a + b)(i, j)[last], a(i, j)[last] + b(i, j)[last]);
      EXPECT_EQ((a - b)(i, j)[last], a(i, j)[last] - b(i, j)[last]);
      EXPECT_EQ((Pack(3.0) * a)(i, j)[last], 3 * a(i, j)[last]);
      EXPECT_EQ((s + t)(i, j)[last], s(i, j)[last] + t(i, j)[last]);
      EXPECT_EQ((s - t)(i, j)[last], s(i, j)[last] - t(i, j)[last]);
      EXPECT_EQ((Pack(3.0) * s)(i, j)[last], 3 * s(i, j)[last]);
    }
}

TEST(Tensor, CofactorTimesTransposeIsTheDeterminant) {
  const M a = random_matrix(13);
  const Plain p = plain(a, last);
  const double det = p.c[0][0] * (p.c[1][1] * p.c[2][2] - p.c[1][2] * p.c[2][1]) -
                     p.c[0][1] * (p.c[1][0] * p.c[2][2] - p.c[1][2] * p.c[2][0]) +
                     p.c[0][2] * (p.c[1][0] * p.c[2][1] - p.c[1][1] * p.c[2][0]);
  EXPECT_GT(std::abs(det), 0.01);
  expect_equal(times_transposed(cofactor(a), a), last, {{{det, 0, 0}, {0, det, 0}, {0, 0, det}}});
  // The symmetric overload agrees with the full one.
  const S s = random_symmetric(14);
  M full;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) full(i, j) = s(i, j);
  expect_equal(cofactor(s), last, plain(cofactor(full), last));
}

TEST(Tensor, DyadIsTheOuterProduct) {
  const V v = random_vector(15);
  const S d = dyad(v);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) EXPECT_EQ(d(i, j)[last], v[i][last] * v[j][last]);
}

}  // namespace

}  // namespace fsi::test
