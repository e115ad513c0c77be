#include "io/stretch_writer.hpp"

#include <cerrno>
#include <utility>

#include "io/write_error.hpp"

namespace fsi {

StretchWriter::StretchWriter(const std::filesystem::path& file, std::filesystem::path shown_as,
                             const Communicator& processes)
    : processes_(processes),
      shown_as_(std::move(shown_as)),
      file_(Hdf5File::open_together(file, shown_as_, processes)) {}

void StretchWriter::note_failure(const std::string& dataset) {
  if (!failed_) {
    error_ = errno;
    dataset_ = dataset;
  }
  failed_ = true;
}

void StretchWriter::close() {
  if (!file_.sync_together()) note_failure("");
  if (!processes_.any(failed_)) return file_.close();
  file_.abandon();
  if (failed_) throw WriteError(shown_as_, error_, dataset_);
}

}  // namespace fsi
