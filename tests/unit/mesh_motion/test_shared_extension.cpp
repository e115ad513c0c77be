// The harmonic extension of nodes that processes share, by factors and by iteration, against that of one process. Run by 2 and 3.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "lattice_extension.hpp"
#include "parallel/even_stretch.hpp"

namespace fsi::test {

namespace {

/// A function: before main() there are none.
const Communicator& everyone() {
  return Communicator::world();
}

/// A process's stretch of the nodes of a problem, and copies of the nodes beside them.
struct SharedProblem {
  ExtensionProblem whole;
  NodeShare share;
  BlockMatrix<1, 3> laplacian;
  std::vector<char> inner;
  std::vector<double> right, field;

  explicit SharedProblem(ExtensionProblem of) : whole(std::move(of)) {
    const NodeGraph& graph = *whole.laplacian.graph;
    const auto owner = [&](int node) {
      return static_cast<int>(((node + std::int64_t{1}) * everyone().size() - 1) / graph.rows());
    };
    std::vector<char> held(graph.rows(), 0);
    for (int a = 0; a < graph.rows(); ++a)
      for (int at = graph.offsets[a]; at < graph.offsets[a + 1]; ++at)
        if (owner(graph.columns[at]) == everyone().rank()) held[a] = 1;
    std::vector<int> local(graph.rows(), -1);
    share.processes = &everyone();
    share.whole_nodes = graph.rows();
    for (int a = 0; a < graph.rows(); ++a)
      if (held[a]) {
        local[a] = static_cast<int>(share.whole_node.size());
        share.whole_node.push_back(a);
        share.owned.push_back(owner(a) == everyone().rank() ? 1 : 0);
      }
    std::vector<Exchange::Neighbour> neighbours;
    for (int rank = 0; rank < everyone().size(); ++rank) {
      Exchange::Neighbour n{rank, {}, {}};
      for (const int a : share.whole_node) {
        if (owner(a) == rank) n.received.push_back(local[a]);
        if (owner(a) != everyone().rank()) continue;
        for (int at = graph.offsets[a]; at < graph.offsets[a + 1]; ++at)
          if (owner(graph.columns[at]) == rank) {
            n.sent.push_back(local[a]);
            break;
          }
      }
      if (rank != everyone().rank() && (!n.sent.empty() || !n.received.empty())) neighbours.push_back(std::move(n));
    }
    share.exchange = Exchange(everyone(), std::move(neighbours));
    auto here = std::make_shared<NodeGraph>();
    here->offsets = {0};
    std::vector<int> blocks;
    for (const int a : share.whole_node) {
      for (int at = graph.offsets[a]; at < graph.offsets[a + 1]; ++at)
        if (const int column = local[graph.columns[at]]; column >= 0) {
          here->columns.push_back(column);
          blocks.push_back(at);
        }
      here->offsets.push_back(static_cast<int>(here->columns.size()));
      for (int k = 0; k < 3; ++k) {
        const std::size_t entry = VectorLayout<3>::vector(a, k);
        inner.push_back(whole.inner[entry]);
        right.push_back(whole.right[entry]);
        field.push_back(whole.field[entry]);
      }
    }
    laplacian = BlockMatrix<1, 3>(here);
    for (std::size_t at = 0; at < blocks.size(); ++at)
      std::copy_n(whole.laplacian.block(blocks[at]), 3, laplacian.block(static_cast<int>(at)));
  }

  /// Largest difference between the solution of the whole and that of the share, of all nodes here.
  double difference(const HarmonicExtensionOptions& options, double tolerance, bool iterates) const {
    HarmonicExtensionOptions by_factors;
    by_factors.iterative_from = 1 << 30;
    HarmonicExtension<3> alone(whole.laplacian, whole.inner, by_factors);
    HarmonicExtension<3> shared(laplacian, inner, nullptr, share, nullptr, options);
    EXPECT_EQ(shared.iterates(), iterates);
    std::vector<double> expected = whole.field, found = field;
    alone.solve(whole.right, expected);
    shared.solve(right, found, tolerance);
    double largest = 0;
    for (std::size_t i = 0; i < share.whole_node.size(); ++i)
      for (int k = 0; k < 3; ++k)
        largest = std::max(largest, std::abs(found[VectorLayout<3>::vector(static_cast<int>(i), k)] -
                                             expected[VectorLayout<3>::vector(share.whole_node[i], k)]));
    return everyone().largest(largest);
  }
};

TEST(SharedExtension, FactorsAndIterationSolveAsOneProcessDoes) {
  for (const double last : {1.0, 2.5}) {  // the last component with the others, and by itself
    const SharedProblem problem{ExtensionProblem(18, last)};
    EXPECT_LT(problem.difference({}, 1e-12, false), 1e-12);
    HarmonicExtensionOptions options;
    options.iterative_from = 1;
    EXPECT_LT(problem.difference(options, 1e-12, true), 1e-10);
  }
}

/// Factors in single precision serve for few digits, and are corrected for more.
TEST(SharedExtension, SinglePrecisionIsCorrected) {
  const SharedProblem problem{ExtensionProblem(18)};
  HarmonicExtensionOptions options;
  options.single_precision = true;
  const double few = problem.difference(options, 1e-3, false);
  EXPECT_GT(few, 1e-10);
  EXPECT_LT(few, 1e-5);
  EXPECT_LT(problem.difference(options, 1e-12, false), 1e-11);
}

/// An iteration that is cut short leaves the rest to the rescue.
TEST(SharedExtension, RescueTakesOver) {
  struct Rescue : MeshExtension<3> {
    int& calls;
    explicit Rescue(int& count) : calls(count) {}
    void update() override {}
    void solve(const std::vector<double>&, std::vector<double>& field, double) override {
      ++calls;
      std::fill(field.begin(), field.end(), 7.0);
    }
    bool iterates() const override { return false; }
    double memory_mib() const override { return 0; }
    int iterations() const override { return 0; }
  };
  const SharedProblem problem{ExtensionProblem(18)};
  HarmonicExtensionOptions options;
  options.iterative_from = 1;
  options.max_iterations = 1;
  int calls = 0;
  HarmonicExtension<3> extension(
      problem.laplacian, problem.inner, nullptr, problem.share, [&] { return std::make_unique<Rescue>(calls); },
      options);
  auto field = problem.field;
  extension.solve(problem.right, field, 1e-12);
  EXPECT_EQ(calls, 1);
  EXPECT_EQ(field.front(), 7.0);
}

}  // namespace

}  // namespace fsi::test
