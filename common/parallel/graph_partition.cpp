#include "parallel/graph_partition.hpp"

#include <cassert>
#include <cstdint>
#include <stdexcept>

#ifdef FSI_WITH_MPI
#include <cstdio>  // what ptscotch.h needs

#include "parallel/mpi_handle.hpp"

#include <ptscotch.h>
#endif

namespace fsi {

#ifdef FSI_WITH_MPI

namespace {

void require(int error, const char* what) {
  if (error != 0) throw std::runtime_error(std::string("PT-Scotch failed: ") + what);
}

class DistributedGraph {
 public:
  explicit DistributedGraph(const Communicator& processes) {
    require(SCOTCH_dgraphInit(&graph_, mpi_of(processes)), "no graph");
  }
  ~DistributedGraph() { SCOTCH_dgraphExit(&graph_); }
  DistributedGraph(const DistributedGraph&) = delete;
  DistributedGraph& operator=(const DistributedGraph&) = delete;
  SCOTCH_Dgraph* get() { return &graph_; }

 private:
  SCOTCH_Dgraph graph_;
};

/// One thread, and nothing that depends on which message comes first.
class Reproducible {
 public:
  Reproducible() {
    require(SCOTCH_contextInit(&context_), "no context");
    require(SCOTCH_contextOptionSetNum(&context_, SCOTCH_OPTIONNUMDETERMINISTIC, 1), "no context");
    require(SCOTCH_contextThreadSpawn(&context_, 1, nullptr), "no context");
    SCOTCH_contextRandomReset(&context_);
  }
  ~Reproducible() { SCOTCH_contextExit(&context_); }
  Reproducible(const Reproducible&) = delete;
  Reproducible& operator=(const Reproducible&) = delete;
  SCOTCH_Context* get() const { return &context_; }

 private:
  mutable SCOTCH_Context context_;
};

}  // namespace

std::vector<int> partition_of_graph(const std::vector<int>& offsets, const std::vector<int>& columns,
                                    const std::vector<int>& weights, const Communicator& processes) {
  if (processes.is_alone()) return std::vector<int>(weights.size(), 0);
  const int count = static_cast<int>(weights.size());
  const auto first = static_cast<int>(processes.sum_before(std::int64_t{count}));
  std::vector<SCOTCH_Num> rows{0}, edges, loads(weights.begin(), weights.end());
  edges.reserve(columns.size());
  for (int row = 0; row < count; ++row) {
    for (int at = offsets[row]; at < offsets[row + 1]; ++at)
      if (columns[at] != first + row) edges.push_back(columns[at]);
    rows.push_back(static_cast<SCOTCH_Num>(edges.size()));
  }
  edges.reserve(1);
  loads.reserve(1);
  std::vector<SCOTCH_Num> owners(static_cast<std::size_t>(count) + 1, 0);
  {
    DistributedGraph graph(processes);
    const auto size = static_cast<SCOTCH_Num>(edges.size());
    require(SCOTCH_dgraphBuild(graph.get(), 0, count, count, rows.data(), rows.data() + 1, loads.data(), nullptr, size,
                               size, edges.data(), nullptr, nullptr),
            "the graph is refused");
    const Reproducible context;
    DistributedGraph reproducible(processes);
    require(SCOTCH_contextBindDgraph(context.get(), graph.get(), reproducible.get()), "no context");
    SCOTCH_Strat strategy;
    require(SCOTCH_stratInit(&strategy), "no strategy");
    const int error = SCOTCH_dgraphPart(reproducible.get(), processes.size(), &strategy, owners.data());
    SCOTCH_stratExit(&strategy);
    require(error, "no partition");
  }
  owners.resize(weights.size());
  return processes.gather(owners);
}

#else

std::vector<int> partition_of_graph(const std::vector<int>&, const std::vector<int>&, const std::vector<int>& weights,
                                    const Communicator& processes) {
  assert(processes.is_alone());
  static_cast<void>(processes);
  return std::vector<int>(weights.size(), 0);
}

#endif

}  // namespace fsi
