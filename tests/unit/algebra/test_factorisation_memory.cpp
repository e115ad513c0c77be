#include "linear/direct/factorisation_memory.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cstdio>
#include <string>
#include <vector>

#include "host/available_memory.hpp"
#include "linear/direct/direct_solver.hpp"

namespace fsi {
namespace {

constexpr double mib = 1 << 20;

/// The Laplacian on a cube of points, by columns.
SparseMatrix laplacian(int points) {
  SparseMatrix a;
  a.offsets.push_back(0);
  const auto number = [points](int i, int j, int k) { return (std::int64_t{i} * points + j) * points + k; };
  for (int i = 0; i < points; ++i)
    for (int j = 0; j < points; ++j)
      for (int k = 0; k < points; ++k) {
        const auto add = [&](int x, int y, int z, double value) {
          if (x < 0 || y < 0 || z < 0 || x >= points || y >= points || z >= points) return;
          a.rows.push_back(number(x, y, z));
          a.values.push_back(value);
        };
        add(i - 1, j, k, -1);
        add(i, j - 1, k, -1);
        add(i, j, k - 1, -1);
        add(i, j, k, 6.5);
        add(i, j, k + 1, -1);
        add(i, j + 1, k, -1);
        add(i + 1, j, k, -1);
        a.offsets.push_back(static_cast<std::int64_t>(a.rows.size()));
      }
  return a;
}

/// Entries of the factors as the analysis expects them, entries of the matrix, and the memory that UMFPACK then counted,
/// MiB: first Newton matrices of the neo-Hookean artery (coupled coarse, axisymmetric, fluid alone, quadratic coarse,
/// coupled intermediate).
TEST(FactorisationMemory, EstimateIsWithinAnEighthOfWhatWasMeasured) {
  const double measured[][3] = {{2.30331e6, 253816, 21.3},
                                {555728, 147275, 6.5},
                                {677582, 115240, 6.7},
                                {3.5283e7, 2674663, 301.1},
                                {4.40821e7, 2070802, 354.0}};
  for (const auto& [factors, matrix, used] : measured)
    EXPECT_NEAR(factorisation_bytes(factors, matrix) / mib / used, 1, 0.125) << used;
}

TEST(FactorisationMemory, IsRefusedWhereItWillNotFit) {
  EXPECT_FALSE(will_not_fit(100, 100));
  EXPECT_FALSE(will_not_fit(110, 100));
  EXPECT_TRUE(will_not_fit(120, 100));
  EXPECT_FALSE(takes_more_than_half(49, 100));
  EXPECT_TRUE(takes_more_than_half(51, 100));
}

/// Factorises with so much room for data; ends the process.
[[noreturn]] void factorise_in(double room) {
  const SparseMatrix a = laplacian(22);  // factors of 19 MiB as estimated
  set_dense_threads(1);
  DirectSolver().factorise(laplacian(14));  // OpenBLAS takes its buffer, without which it tries again for ever
  const std::uint64_t left = available_memory().bytes;
  std::string notice;
  set_memory_notices([&](const std::string& said) { notice += said; });
  // Upwards in small steps, until there is as much room as wanted.
  rlimit limit{1, RLIM_INFINITY};
  do {
    limit.rlim_cur += 1 << 20;
    setrlimit(RLIMIT_DATA, &limit);
  } while (available_memory().bytes < room && limit.rlim_cur < left);
  try {
    DirectSolver solver;
    solver.factorise(a);
    std::vector<double> x;
    solver.solve(a, std::vector<double>(static_cast<std::size_t>(a.size()), 1.0), x);
  } catch (const OutOfMemory& error) {
    std::fprintf(stderr, "refused: %s\n", error.what());
    _exit(3);
  }
  std::fprintf(stderr, "done: %s\n", notice.c_str());
  _exit(0);
}

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool sanitized = true;
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
constexpr bool sanitized = true;
#else
constexpr bool sanitized = false;
#endif
#else
constexpr bool sanitized = false;
#endif

TEST(FactorisationMemory, SolverRefusesWarnsOrIsSilent) {
  if (sanitized) GTEST_SKIP() << "a sanitizer takes terabytes of addresses, which no limit of data allows";
  EXPECT_EXIT(factorise_in(14 * mib), testing::ExitedWithCode(3),
              "refused: out of memory \\(factorising a matrix\\): the factors of 10648 unknowns take about .* MiB");
  EXPECT_EXIT(factorise_in(2000 * mib), testing::ExitedWithCode(0), "done: \n");
  EXPECT_EXIT(factorise_in(200 * mib), testing::ExitedWithCode(0), "done: \n");
  EXPECT_EXIT(factorise_in(34 * mib), testing::ExitedWithCode(0), "done: the factors .* more than half of the");
}

}  // namespace
}  // namespace fsi
