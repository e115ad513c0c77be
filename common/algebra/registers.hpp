#pragma once

namespace fsi {

namespace detail {

/// A few numbers in a register, with arithmetic lane by lane.
template <class Real, int count>
struct Lanes;
template <>
struct Lanes<float, 8> {
  using Type = float __attribute__((vector_size(32)));
};
template <>
struct Lanes<float, 4> {
  using Type = float __attribute__((vector_size(16)));
};
template <>
struct Lanes<float, 2> {
  using Type = float __attribute__((vector_size(8)));
};
template <>
struct Lanes<double, 4> {
  using Type = double __attribute__((vector_size(32)));
};

}  // namespace detail

/// Length of a vector of `size` numbers padded to fill a register.
template <int size>
constexpr int padded = size <= 2   ? 2
                       : size <= 4 ? 4
                                   : 8;

/// How far software prefetch runs ahead, in bytes. Not all processors prefetch as far by themselves
/// (docs/guide/solvers.md#speed).
inline constexpr int prefetch_distance = 4096;

/// A padded vector in a register.
template <int size, class Real = float>
using Register = typename detail::Lanes<Real, padded<size>>::Type;

template <int size, class Real>
inline Register<size, Real> load(const Real* from) {
  Register<size, Real> x;
  __builtin_memcpy(&x, from, sizeof x);
  return x;
}
template <int size>
inline void store(Register<size> x, float* to) {
  __builtin_memcpy(to, &x, sizeof x);
}

/// Lane i plus lane i + 4.
inline Register<4> folded(Register<8> x) {
  return __builtin_shufflevector(x, x, 0, 1, 2, 3) + __builtin_shufflevector(x, x, 4, 5, 6, 7);
}

template <class Four>
inline auto sum_of_lanes(Four x) {
  return (x[0] + x[2]) + (x[1] + x[3]);
}
/// Sums of the lanes of four registers, one in each lane.
inline Register<4> sums_of_lanes(Register<4> a, Register<4> b, Register<4> c, Register<4> d) {
  const Register<4> ab = __builtin_shufflevector(a, b, 0, 4, 1, 5) + __builtin_shufflevector(a, b, 2, 6, 3, 7);
  const Register<4> cd = __builtin_shufflevector(c, d, 0, 4, 1, 5) + __builtin_shufflevector(c, d, 2, 6, 3, 7);
  return __builtin_shufflevector(ab, cd, 0, 1, 4, 5) + __builtin_shufflevector(ab, cd, 2, 3, 6, 7);
}

}  // namespace fsi
