#include "parallel/communicator.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <stdexcept>
#include <utility>

#ifdef FSI_WITH_MPI
#include "parallel/mpi_handle.hpp"
#else
#include "base/error.hpp"
#endif

namespace fsi {

#ifndef FSI_WITH_MPI
struct Communicator::Handle {};
#endif

namespace {

const Communicator* of_program = nullptr;

}  // namespace

Communicator::~Communicator() = default;

const Communicator& Communicator::alone() {
  static const Communicator one(nullptr);
  return one;
}

const Communicator& Communicator::world() {
  return of_program ? *of_program : alone();
}

double Communicator::sum(double mine) const {
  sum(&mine, 1);
  return mine;
}

std::int64_t Communicator::sum(std::int64_t mine) const {
  if (is_alone()) return mine;
  std::int64_t total = 0;
  for (const std::int64_t one : gather(mine)) total += one;
  return total;
}

void Communicator::sum(double* mine, std::size_t count) const {
  if (is_alone() || count == 0) return;
  const std::vector<double> all = gather_equal(mine, count);
  std::fill_n(mine, count, 0.0);
  for (std::size_t at = 0; at < all.size(); ++at) mine[at % count] += all[at];
}

double Communicator::smallest(double mine) const {
  if (is_alone()) return mine;
  double result = std::numeric_limits<double>::infinity();
  for (const double one : gather(mine))
    if (std::isnan(one) || one < result) result = one;  // NaN stays: nothing is less
  return result;
}

double Communicator::largest(double mine) const {
  return -smallest(-mine);
}

bool Communicator::any(bool mine) const {
  return largest(mine ? 1 : 0) > 0;
}

std::int64_t Communicator::sum_before(std::int64_t mine) const {
  const auto all = gather(mine);
  std::int64_t before = 0;
  for (int r = 0; r < rank_; ++r) before += all[r];
  return before;
}

std::vector<double> Communicator::gather(double mine) const {
  return gather(std::vector<double>{mine});
}

std::vector<std::int64_t> Communicator::gather(std::int64_t mine) const {
  return gather(std::vector<std::int64_t>{mine});
}

#ifdef FSI_WITH_MPI

namespace {

bool has_begun() {
  int begun = 0;
  MPI_Initialized(&begun);
  return begun != 0;
}

/// Whether a launcher of several processes started this one. They say so in the environment, each in its way.
bool is_launched() {
  for (const char* name : {"OMPI_COMM_WORLD_SIZE", "PMI_RANK", "PMIX_RANK", "MPI_LOCALRANKID"})
    if (std::getenv(name) != nullptr) return true;
  return false;
}

/// While MPI begins in a process that no launcher has started: there is nobody to talk to. Open MPI otherwise starts a
/// daemon of its own and looks for networks, half a second. What the user's environment says about it stands.
class LoneStart {
 public:
  LoneStart() {
    for (const auto& [name, value] : settings)
      if (std::getenv(name) == nullptr && setenv(name, value, 0) == 0) set_.push_back(name);
  }
  ~LoneStart() {
    for (const char* name : set_) unsetenv(name);  // programs that this one starts may be launchers
  }
  LoneStart(const LoneStart&) = delete;
  LoneStart& operator=(const LoneStart&) = delete;

 private:
  static constexpr std::pair<const char*, const char*> settings[] = {
      {"OMPI_MCA_ess_singleton_isolated", "1"}, {"OMPI_MCA_pml", "ob1"}, {"OMPI_MCA_btl", "self"}};
  std::vector<const char*> set_;
};

template <class T>
std::vector<T> gather_all(const std::vector<T>& mine, MPI_Datatype type, MPI_Comm communicator, int size) {
  const int count = static_cast<int>(mine.size());
  std::vector<int> counts(size), starts(size, 0);
  MPI_Allgather(&count, 1, MPI_INT, counts.data(), 1, MPI_INT, communicator);
  for (int r = 1; r < size; ++r) starts[r] = starts[r - 1] + counts[r - 1];
  std::vector<T> all(static_cast<std::size_t>(starts.back() + counts.back()));
  MPI_Allgatherv(mine.data(), count, type, all.data(), counts.data(), starts.data(), type, communicator);
  return all;
}

}  // namespace

Communicator::Communicator(std::unique_ptr<Handle> handle) : handle_(std::move(handle)) {
  if (!handle_) return;
  MPI_Comm_rank(handle_->communicator, &rank_);
  MPI_Comm_size(handle_->communicator, &size_);
}

std::vector<double> Communicator::gather(const std::vector<double>& mine) const {
  if (is_alone()) return mine;
  ++traffic_.reductions;
  return gather_all(mine, MPI_DOUBLE, handle_->communicator, size_);
}

std::vector<std::int64_t> Communicator::gather(const std::vector<std::int64_t>& mine) const {
  if (is_alone()) return mine;
  ++traffic_.reductions;
  return gather_all(mine, MPI_INT64_T, handle_->communicator, size_);
}

std::vector<int> Communicator::gather(const std::vector<int>& mine) const {
  if (is_alone()) return mine;
  ++traffic_.reductions;
  return gather_all(mine, MPI_INT, handle_->communicator, size_);
}

std::vector<double> Communicator::gather_at_first(const std::vector<double>& mine) const {
  if (is_alone()) return mine;
  ++traffic_.reductions;
  const int count = static_cast<int>(mine.size());
  std::vector<int> counts(size_), starts(size_, 0);
  MPI_Gather(&count, 1, MPI_INT, counts.data(), 1, MPI_INT, 0, handle_->communicator);
  std::vector<double> all;
  if (is_first()) {
    for (int r = 1; r < size_; ++r) starts[r] = starts[r - 1] + counts[r - 1];
    all.resize(static_cast<std::size_t>(starts.back()) + static_cast<std::size_t>(counts.back()));
  }
  MPI_Gatherv(mine.data(), count, MPI_DOUBLE, all.data(), counts.data(), starts.data(), MPI_DOUBLE, 0,
              handle_->communicator);
  return all;
}

void Communicator::gather(const float* mine, const std::vector<int>& counts, float* all) const {
  if (is_alone()) {
    std::copy_n(mine, counts[0], all);
    return;
  }
  ++traffic_.reductions;
  std::vector<int> starts(size_, 0);
  for (int r = 1; r < size_; ++r) starts[r] = starts[r - 1] + counts[r - 1];
  MPI_Allgatherv(mine, counts[rank_], MPI_FLOAT, all, counts.data(), starts.data(), MPI_FLOAT, handle_->communicator);
}

std::vector<double> Communicator::gather_equal(const double* mine, std::size_t count) const {
  ++traffic_.reductions;
  std::vector<double> all(count * static_cast<std::size_t>(size_));
  MPI_Allgather(mine, static_cast<int>(count), MPI_DOUBLE, all.data(), static_cast<int>(count), MPI_DOUBLE,
                handle_->communicator);
  return all;
}

void Communicator::broadcast(std::string& text) const {
  if (is_alone()) return;
  std::int64_t length = static_cast<std::int64_t>(text.size());
  broadcast(length);
  text.resize(static_cast<std::size_t>(length));
  MPI_Bcast(text.data(), static_cast<int>(length), MPI_CHAR, 0, handle_->communicator);
}

void Communicator::broadcast(std::vector<double>& numbers) const {
  if (is_alone()) return;
  std::int64_t length = static_cast<std::int64_t>(numbers.size());
  broadcast(length);
  numbers.resize(static_cast<std::size_t>(length));
  MPI_Bcast(numbers.data(), static_cast<int>(length), MPI_DOUBLE, 0, handle_->communicator);
}

void Communicator::broadcast(std::int64_t& number) const {
  if (is_alone()) return;
  ++traffic_.reductions;
  MPI_Bcast(&number, 1, MPI_INT64_T, 0, handle_->communicator);
}

void Communicator::wait() const {
  if (!is_alone()) MPI_Barrier(handle_->communicator);
}

std::vector<std::vector<double>> Communicator::send_and_receive(const std::vector<std::vector<double>>& to_each) const {
  if (is_alone()) return to_each;
  std::vector<int> sent(size_), received(size_), sent_from(size_, 0), received_from(size_, 0);
  std::vector<double> outgoing;
  for (int r = 0; r < size_; ++r) {
    sent[r] = static_cast<int>(to_each[r].size());
    sent_from[r] = static_cast<int>(outgoing.size());
    outgoing.insert(outgoing.end(), to_each[r].begin(), to_each[r].end());
    if (r == rank_ || sent[r] == 0) continue;
    ++traffic_.messages;
    traffic_.bytes += static_cast<std::int64_t>(sizeof(double)) * sent[r];
  }
  MPI_Alltoall(sent.data(), 1, MPI_INT, received.data(), 1, MPI_INT, handle_->communicator);
  for (int r = 1; r < size_; ++r) received_from[r] = received_from[r - 1] + received[r - 1];
  std::vector<double> incoming(static_cast<std::size_t>(received_from.back() + received.back()));
  MPI_Alltoallv(outgoing.data(), sent.data(), sent_from.data(), MPI_DOUBLE, incoming.data(), received.data(),
                received_from.data(), MPI_DOUBLE, handle_->communicator);
  std::vector<std::vector<double>> from_each(size_);
  for (int r = 0; r < size_; ++r)
    from_each[r].assign(incoming.begin() + received_from[r], incoming.begin() + received_from[r] + received[r]);
  return from_each;
}

ProcessGroup::ProcessGroup() {
  if (!is_launched()) return;
  if (!has_begun()) require_mpi();
  auto handle = std::make_unique<Communicator::Handle>();
  MPI_Comm_dup(MPI_COMM_WORLD, &handle->communicator);
  of_program = new Communicator(std::move(handle));
}

ProcessGroup::~ProcessGroup() {
  if (of_program != nullptr) {
    MPI_Comm communicator = of_program->handle()->communicator;
    delete std::exchange(of_program, nullptr);
    MPI_Comm_free(&communicator);
  }
  int ended = 0;
  MPI_Finalized(&ended);
  if (has_begun() && ended == 0) MPI_Finalize();
}

void ProcessGroup::require_mpi() {
  if (has_begun()) return;
  const std::unique_ptr<LoneStart> lone(is_launched() ? nullptr : new LoneStart);
  int provided = 0;
  MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &provided);
}

void ProcessGroup::abort(int exit_code) {
  if (has_begun()) MPI_Abort(MPI_COMM_WORLD, exit_code);
  std::_Exit(exit_code);
}

#else

Communicator::Communicator(std::unique_ptr<Handle> handle) : handle_(std::move(handle)) {}

std::vector<double> Communicator::gather(const std::vector<double>& mine) const {
  return mine;
}
std::vector<std::int64_t> Communicator::gather(const std::vector<std::int64_t>& mine) const {
  return mine;
}
std::vector<int> Communicator::gather(const std::vector<int>& mine) const {
  return mine;
}
std::vector<double> Communicator::gather_at_first(const std::vector<double>& mine) const {
  return mine;
}
void Communicator::gather(const float* mine, const std::vector<int>& counts, float* all) const {
  std::copy_n(mine, counts[0], all);
}
std::vector<double> Communicator::gather_equal(const double* mine, std::size_t count) const {
  return {mine, mine + count};
}
void Communicator::broadcast(std::string&) const {}
void Communicator::broadcast(std::vector<double>&) const {}
void Communicator::broadcast(std::int64_t&) const {}
void Communicator::wait() const {}
std::vector<std::vector<double>> Communicator::send_and_receive(const std::vector<std::vector<double>>& to_each) const {
  return to_each;
}

ProcessGroup::ProcessGroup() {
  for (const char* name : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "MPI_LOCALNRANKS"}) {
    const char* processes = std::getenv(name);
    if (processes == nullptr || std::atoi(processes) <= 1) continue;
    throw InputError("mpirun", "",
                     std::string("this build is without MPI, and would do the same ") + processes + " times",
                     "start one process, or build with -DFSI_MPI=ON");
  }
}
ProcessGroup::~ProcessGroup() = default;
void ProcessGroup::require_mpi() {
  throw std::logic_error("this build is without MPI (FSI_MPI=OFF)");
}
void ProcessGroup::abort(int exit_code) {
  std::_Exit(exit_code);
}

#endif

}  // namespace fsi
