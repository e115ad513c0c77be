#pragma once

#include <omp.h>

#include "host/threads.hpp"

namespace fsi {

namespace detail {

#if defined(__clang__)
#define FSI_ONE_COPY [[gnu::noinline]]
#else
#define FSI_ONE_COPY [[gnu::noinline, gnu::noclone]]
#endif

/// One copy of the machine code for all callers, so that sums have the same bits with a team and without.
template <class Index, class Body>
FSI_ONE_COPY void run_part(Index begin, Index end, const Body& body) {
  for (Index i = begin; i < end; ++i) body(i);
}

#undef FSI_ONE_COPY

}  // namespace detail

/// Calls body(i) for i = 0 .. count - 1: with `shared` by all threads, an equal part of successive i each; else, or
/// with one thread, by the caller without a team. OpenMP's own `if` makes a one-thread team, which takes as long to
/// begin and end as a sum of some thousand products: too long for short loops that run often (docs/archive.md).
/// \param shared  whether the loop is long enough to wake the threads
/// \param body    writes nothing that the body of another i reads or writes
template <class Index, class Body>
void parallel_for(Index count, bool shared, const Body& body) {
  if (!shared || threads() == 1) {
    detail::run_part(Index{0}, count, body);
    return;
  }
#pragma omp parallel
  {
    const auto team = static_cast<Index>(omp_get_num_threads()), member = static_cast<Index>(omp_get_thread_num());
    const Index length = count / team, longer = count % team;  // parts that hold one more
    const Index begin = member * length + (member < longer ? member : longer);
    detail::run_part(begin, static_cast<Index>(begin + length + (member < longer ? 1 : 0)), body);
  }
}

}  // namespace fsi
