#include "mesh_io/temporary_mesh.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <system_error>

#include "base/error.hpp"

namespace fsi {

TemporaryMesh::TemporaryMesh(const std::filesystem::path& final_name, const std::string& purpose)
    : final_name_(final_name),
      path_(final_name.parent_path() /
            (".fsi-mesh-" + purpose + std::to_string(getpid()) + ".msh")),  // picks gmsh's writer
      on_signal_(path_) {}

TemporaryMesh::~TemporaryMesh() {
  std::error_code ignored;
  std::filesystem::remove(path_, ignored);
}

void TemporaryMesh::move_into_place() const {
  const int descriptor = ::open(path_.c_str(), O_RDONLY | O_CLOEXEC);
  int error = descriptor < 0 || ::fsync(descriptor) != 0 ? errno : 0;
  if (descriptor >= 0 && ::close(descriptor) != 0 && error == 0) error = errno;
  if (error != 0)
    throw InputError(final_name_.string(), "", std::string("cannot be written (") + std::strerror(error) + ")",
                     "check the space on the disk");
  std::error_code failure;
  std::filesystem::rename(path_, final_name_, failure);
  if (failure)
    throw InputError(final_name_.string(), "", "cannot be written (" + failure.message() + ")", "choose another file");
}

}  // namespace fsi
