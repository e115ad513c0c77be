#include "parallel/exchange.hpp"

#include <algorithm>
#include <cassert>
#include <numeric>
#include <type_traits>

#ifdef FSI_WITH_MPI
#include "parallel/mpi_handle.hpp"
#endif

namespace fsi {

Exchange::Exchange(const Communicator& processes, std::vector<Neighbour> neighbours)
    : processes_(&processes), neighbours_(std::move(neighbours)) {}

template <class Real>
Exchange::Buffers<Real>& Exchange::buffers() const {
  if constexpr (std::is_same_v<Real, double>)
    return doubles_;
  else
    return floats_;
}

template <class Real>
void Exchange::update_copies(Real* values, int entries) const {
  communicate(values, entries, Way::to_copies);
  for (std::size_t i = 0; i < neighbours_.size(); ++i) {
    const Real* from = buffers<Real>().incoming[i].data();
    for (const int item : neighbours_[i].received) {
      std::copy_n(from, entries, values + static_cast<std::size_t>(item) * entries);
      from += entries;
    }
  }
}

void Exchange::update(double* values, int entries) const {
  update_copies(values, entries);
}

void Exchange::update(float* values, int entries) const {
  update_copies(values, entries);
}

template <class Real>
void Exchange::add_from_copies(std::vector<Real>& values, int entries) const {
  communicate(values.data(), entries, Way::to_owners);
  for (std::size_t i = 0; i < neighbours_.size(); ++i) {
    const Real* from = buffers<Real>().incoming[i].data();
    for (const int item : neighbours_[i].sent)
      for (int e = 0; e < entries; ++e) values[static_cast<std::size_t>(item) * entries + e] += *from++;
  }
}

template void Exchange::add_from_copies(std::vector<double>&, int) const;
template void Exchange::add_from_copies(std::vector<float>&, int) const;

std::vector<Exchange::Rows> Exchange::communicate_rows(const Rows& rows, Way way) const {
  std::vector<Rows> result(neighbours_.size());
  if (processes_ == nullptr || processes_->is_alone()) return result;
  Rows to_each(processes_->size());
  for (const Neighbour& n : neighbours_)
    for (const int item : outgoing(n, way)) {
      to_each[n.rank].push_back(static_cast<double>(rows[item].size()));
      to_each[n.rank].insert(to_each[n.rank].end(), rows[item].begin(), rows[item].end());
    }
  const auto from_each = processes_->send_and_receive(to_each);
  for (std::size_t i = 0; i < neighbours_.size(); ++i) {
    auto from = from_each[neighbours_[i].rank].begin();
    for (std::size_t item = 0; item < incoming(neighbours_[i], way).size(); ++item) {
      const auto length = static_cast<std::ptrdiff_t>(*from++);
      result[i].emplace_back(from, from + length);
      from += length;
    }
  }
  return result;
}

void Exchange::update_rows(Rows& rows) const {
  auto received = communicate_rows(rows, Way::to_copies);
  for (std::size_t i = 0; i < neighbours_.size(); ++i)
    for (std::size_t item = 0; item < received[i].size(); ++item)
      rows[neighbours_[i].received[item]] = std::move(received[i][item]);
}

std::vector<std::vector<double>> Exchange::from_copies(const std::vector<double>& values, int entries) const {
  communicate(values.data(), entries, Way::to_owners);
  return doubles_.incoming;
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

template <class Real>
void Exchange::communicate(const Real* values, int entries, Way way) const {
  auto& [to_send, to_receive] = buffers<Real>();
  to_send.resize(neighbours_.size());
  to_receive.resize(neighbours_.size());
  if (neighbours_.empty()) return;
  assert(processes_ != nullptr);
  MPI_Datatype type = std::is_same_v<Real, double> ? MPI_DOUBLE : MPI_FLOAT;
  constexpr int tag = 1;
  MPI_Comm communicator = mpi_of(*processes_);
  std::vector<MPI_Request> requests(2 * neighbours_.size(), MPI_REQUEST_NULL);
  for (std::size_t i = 0; i < neighbours_.size(); ++i) {
    to_receive[i].resize(incoming(neighbours_[i], way).size() * entries);
    if (to_receive[i].empty()) continue;
    MPI_Irecv(to_receive[i].data(), static_cast<int>(to_receive[i].size()), type, neighbours_[i].rank, tag,
              communicator, &requests[2 * i]);
  }
  for (std::size_t i = 0; i < neighbours_.size(); ++i) {
    const auto& items = outgoing(neighbours_[i], way);
    to_send[i].resize(items.size() * entries);
    if (items.empty()) continue;
    Real* to = to_send[i].data();
    for (const int item : items) to = std::copy_n(values + static_cast<std::size_t>(item) * entries, entries, to);
    MPI_Isend(to_send[i].data(), static_cast<int>(to_send[i].size()), type, neighbours_[i].rank, tag, communicator,
              &requests[2 * i + 1]);
    ++processes_->traffic_.messages;
    processes_->traffic_.bytes += static_cast<std::int64_t>(sizeof(Real) * to_send[i].size());
  }
  MPI_Waitall(static_cast<int>(requests.size()), requests.data(), MPI_STATUSES_IGNORE);
}

#else

template <class Real>
void Exchange::communicate(const Real*, int, Way) const {
  assert(neighbours_.empty());
  buffers<Real>().incoming.resize(neighbours_.size());
}

#endif

ShareOfNumbers::ShareOfNumbers(const Communicator& all, int own_items, std::vector<std::int64_t> numbers_of_copies)
    : processes(&all), own(own_items), copies(std::move(numbers_of_copies)) {
  if (all.is_alone()) return;
  const auto counts = all.gather(std::int64_t{own});
  std::vector<std::int64_t> firsts(counts.size() + 1, 0);
  std::partial_sum(counts.begin(), counts.end(), firsts.begin() + 1);
  first = firsts[all.rank()];
  std::vector<std::vector<double>> wanted(all.size());
  std::vector<std::vector<int>> received(all.size());
  for (std::size_t i = 0; i < copies.size(); ++i) {
    const auto owner = std::upper_bound(firsts.begin(), firsts.end(), copies[i]) - firsts.begin() - 1;
    assert(owner >= 0 && owner < all.size() && owner != all.rank());
    wanted[owner].push_back(static_cast<double>(copies[i] - firsts[owner]));
    received[owner].push_back(own + static_cast<int>(i));
  }
  const auto sent = all.send_and_receive(wanted);
  std::vector<Exchange::Neighbour> neighbours;
  for (int r = 0; r < all.size(); ++r)
    if (!sent[r].empty() || !received[r].empty())
      neighbours.push_back({r, std::vector<int>(sent[r].begin(), sent[r].end()), received[r]});
  exchange = Exchange(all, std::move(neighbours));
}

}  // namespace fsi
