#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "host/parallel_for.hpp"

namespace fsi {

/// Entries per partial sum of a reduction. Fixed, so that sums do not depend on the number of threads.
constexpr std::size_t reduction_chunk = 4096;
/// Loops over fewer entries than this run on one thread.
constexpr std::size_t serial_entries = 16384;

/// x . y, summed by chunks of fixed size and then over the chunks in order: the same bits for any number of threads.
inline double dot(const std::vector<double>& x, const std::vector<double>& y) {
  const std::size_t size = x.size(), chunks = (size + reduction_chunk - 1) / reduction_chunk;
  const auto partial_sum = [&](std::size_t chunk) {
    const std::size_t end = std::min(size, (chunk + 1) * reduction_chunk);
    double lanes[8] = {};  // independent sums, so that the loop vectorises without reassociating
    std::size_t i = chunk * reduction_chunk;
    for (; i + 8 <= end; i += 8)
      for (int l = 0; l < 8; ++l) lanes[l] += x[i + l] * y[i + l];
    double sum = ((lanes[0] + lanes[4]) + (lanes[1] + lanes[5])) + ((lanes[2] + lanes[6]) + (lanes[3] + lanes[7]));
    for (; i < end; ++i) sum += x[i] * y[i];
    return sum;
  };
  double sum = 0;
  if (size < serial_entries) {
    for (std::size_t c = 0; c < chunks; ++c) sum += partial_sum(c);
    return sum;
  }
  thread_local std::vector<double> buffer;  // grows once
  if (buffer.size() < chunks) buffer.resize(chunks);
  double* partial = buffer.data();
#pragma omp parallel for schedule(static)
  for (std::size_t c = 0; c < chunks; ++c) partial[c] = partial_sum(c);
  for (std::size_t c = 0; c < chunks; ++c) sum += partial[c];
  return sum;
}

/// |x|_2
inline double norm(const std::vector<double>& x) {
  return std::sqrt(dot(x, x));
}

/// y += a x
inline void axpy(double a, const std::vector<double>& x, std::vector<double>& y) {
  parallel_for(y.size(), y.size() >= serial_entries, [&](std::size_t i) { y[i] += a * x[i]; });
}

/// y = a x
inline void scaled_copy(double a, const std::vector<double>& x, std::vector<double>& y) {
  parallel_for(y.size(), y.size() >= serial_entries, [&](std::size_t i) { y[i] = a * x[i]; });
}

/// x *= a
inline void scale(double a, std::vector<double>& x) {
  parallel_for(x.size(), x.size() >= serial_entries, [&](std::size_t i) { x[i] *= a; });
}

/// x = 0, size kept.
inline void set_zero(std::vector<double>& x) {
  std::fill(x.begin(), x.end(), 0.0);
}

}  // namespace fsi
