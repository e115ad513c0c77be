#include "linear/direct/dense_threads.hpp"

extern "C" void openblas_set_num_threads(int);
extern "C" int openblas_get_num_threads();

namespace fsi {

namespace {
int dense_threads = openblas_get_num_threads();  // as it begins, until it is set
}

void set_dense_threads(int count) {
  dense_threads = count;
}

void start_dense_threads() {
  if (openblas_get_num_threads() != dense_threads) openblas_set_num_threads(dense_threads);
}

OneDenseThread::OneDenseThread() : before_(dense_threads) {
  set_dense_threads(1);
}
OneDenseThread::~OneDenseThread() {
  set_dense_threads(before_);
}

}  // namespace fsi
