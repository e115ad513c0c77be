#include "parallel/exchange.hpp"

#include <cassert>

#ifdef FSI_WITH_MPI
#include "parallel/mpi_handle.hpp"
#endif

namespace fsi {

Exchange::Exchange(const Communicator& processes, std::vector<Neighbour> neighbours)
    : processes_(&processes),
      neighbours_(std::move(neighbours)),
      outgoing_(neighbours_.size()),
      incoming_(neighbours_.size()) {}

void Exchange::update(double* values, int entries) const {
  communicate(values, entries, Way::to_copies);
  for (std::size_t i = 0; i < neighbours_.size(); ++i) {
    const double* from = incoming_[i].data();
    for (const int item : neighbours_[i].received) {
      std::copy_n(from, entries, values + static_cast<std::size_t>(item) * entries);
      from += entries;
    }
  }
}

std::vector<std::vector<double>> Exchange::from_copies(const std::vector<double>& values, int entries) const {
  communicate(values.data(), entries, Way::to_owners);
  return incoming_;
}

std::size_t Exchange::sent_items() const {
  std::size_t all = 0;
  for (const auto& n : neighbours_) all += n.sent.size();
  return all;
}

std::size_t Exchange::received_items() const {
  std::size_t all = 0;
  for (const auto& n : neighbours_) all += n.received.size();
  return all;
}

#ifdef FSI_WITH_MPI

void Exchange::communicate(const double* values, int entries, Way way) const {
  if (neighbours_.empty()) return;
  assert(processes_ != nullptr);
  constexpr int tag = 1;
  MPI_Comm communicator = mpi_of(*processes_);
  std::vector<MPI_Request> requests(2 * neighbours_.size(), MPI_REQUEST_NULL);
  for (std::size_t i = 0; i < neighbours_.size(); ++i) {
    incoming_[i].resize(incoming(neighbours_[i], way).size() * entries);
    if (incoming_[i].empty()) continue;
    MPI_Irecv(incoming_[i].data(), static_cast<int>(incoming_[i].size()), MPI_DOUBLE, neighbours_[i].rank, tag,
              communicator, &requests[2 * i]);
  }
  for (std::size_t i = 0; i < neighbours_.size(); ++i) {
    const auto& items = outgoing(neighbours_[i], way);
    outgoing_[i].resize(items.size() * entries);
    if (items.empty()) continue;
    double* to = outgoing_[i].data();
    for (const int item : items) to = std::copy_n(values + static_cast<std::size_t>(item) * entries, entries, to);
    MPI_Isend(outgoing_[i].data(), static_cast<int>(outgoing_[i].size()), MPI_DOUBLE, neighbours_[i].rank, tag,
              communicator, &requests[2 * i + 1]);
    ++processes_->traffic_.messages;
    processes_->traffic_.bytes += static_cast<std::int64_t>(sizeof(double) * outgoing_[i].size());
  }
  MPI_Waitall(static_cast<int>(requests.size()), requests.data(), MPI_STATUSES_IGNORE);
}

#else

void Exchange::communicate(const double*, int, Way) const {
  assert(neighbours_.empty());
}

#endif

}  // namespace fsi
