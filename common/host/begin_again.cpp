#include "host/begin_again.hpp"

#include <unistd.h>

#include <array>
#include <cstddef>
#include <cstring>

#include "host/instruction_set.hpp"

namespace fsi {

void begin_again_with_settings(const char* const* argv, char* const* environment) noexcept {
  static char spins[] = "GOMP_SPINCOUNT=1000", dense[] = "OPENBLAS_NUM_THREADS=1",
              pages[] = "GLIBC_TUNABLES=glibc.malloc.hugetlb=1:glibc.malloc.trim_threshold=268435456";
  std::array<char*, 1024> with{};
  std::size_t count = 0;
  static std::array<char, 64> kernels{"OPENBLAS_CORETYPE="};
  const char* const processor = dense_kernel_processor();
  if (processor != nullptr) std::strncat(kernels.data(), processor, kernels.size() - std::strlen(kernels.data()) - 1);
  bool waits = false, starts_dense = false, names_kernels = processor == nullptr, names_pages = false;
  const auto begins = [](const char* entry, const char* name) {
    return std::strncmp(entry, name, std::strlen(name)) == 0;
  };
  for (; environment != nullptr && environment[count] != nullptr; ++count) {
    if (count + 5 >= with.size()) return;
    with[count] = environment[count];
    waits = waits || begins(with[count], "OMP_WAIT_POLICY=") || begins(with[count], "GOMP_SPINCOUNT=");
    starts_dense = starts_dense || begins(with[count], "OPENBLAS_NUM_THREADS=");
    names_kernels = names_kernels || begins(with[count], "OPENBLAS_CORETYPE=");
    names_pages = names_pages || begins(with[count], "GLIBC_TUNABLES=");
  }
  if (waits && starts_dense && names_kernels && names_pages) return;
  if (!waits) with[count++] = spins;
  if (!starts_dense) with[count++] = dense;
  if (!names_kernels) with[count++] = kernels.data();
  if (!names_pages) with[count++] = pages;
  std::array<char, 4096> file{};  // the program's own name: ps would show "/proc/self/exe"
  if (readlink("/proc/self/exe", file.data(), file.size() - 1) > 0)
    execve(file.data(), const_cast<char* const*>(argv), with.data());
  // Where that is not possible the run goes on as it is.
}

}  // namespace fsi
