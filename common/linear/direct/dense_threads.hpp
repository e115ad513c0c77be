#pragma once

namespace fsi {

/// Threads of the dense kernels inside factorisations. The bits of factors depend on them.
void set_dense_threads(int count);

/// OpenBLAS starts its threads when it is told their number, and each takes 128 MiB of addresses: not before they are
/// needed. To be called before a factorisation or a solve with factors.
void start_dense_threads();

/// One such thread for as long as this lives: where results must not depend on the number of threads.
class OneDenseThread {
 public:
  OneDenseThread();
  ~OneDenseThread();
  OneDenseThread(const OneDenseThread&) = delete;
  OneDenseThread& operator=(const OneDenseThread&) = delete;

 private:
  int before_;
};

}  // namespace fsi
