#include "io/hdf5_file.hpp"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <utility>

#include "base/error.hpp"
#include "io/hdf5_library.hpp"
#include "io/write_error.hpp"

#ifdef FSI_WITH_MPI
#include "parallel/mpi_handle.hpp"
#endif

namespace fsi {

namespace {

template <class Value>
hid_t native_type();
template <>
hid_t native_type<double>() {
  return H5T_NATIVE_DOUBLE;
}
template <>
hid_t native_type<std::int32_t>() {
  return H5T_NATIVE_INT32;
}
template <>
hid_t native_type<std::int64_t>() {
  return H5T_NATIVE_INT64;
}
template <>
hid_t native_type<std::uint8_t>() {
  return H5T_NATIVE_UINT8;
}

/// No locks, so that ParaView can read finished steps of a running computation; no error messages of the library. The
/// format of files that every version reads: later ones, which HDF5 2 takes by itself, keep the time of day in groups,
/// so that no two runs have the same bytes. Called before any other function of the library.
Hdf5Handle access_properties() {
  begin_hdf5();
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  Hdf5Handle properties(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  H5Pset_file_locking(properties.id(), false, true);
  H5Pset_libver_bounds(properties.id(), H5F_LIBVER_EARLIEST, H5F_LIBVER_LATEST);
  return properties;
}

Hdf5Handle text_type(std::size_t length) {
  Hdf5Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
  H5Tset_size(type.id(), std::max<std::size_t>(length, 1));
  return type;
}

std::uint64_t product(const std::vector<std::uint64_t>& shape) {
  std::uint64_t size = 1;
  for (const auto n : shape) size *= n;
  return size;
}

}  // namespace

void begin_hdf5() {
  static const herr_t no_work_at_exit = H5dont_atexit();
  static const herr_t begun = H5open();
  static_cast<void>(no_work_at_exit);
  static_cast<void>(begun);
}

Hdf5Handle& Hdf5Handle::operator=(Hdf5Handle&& other) noexcept {
  std::swap(id_, other.id_);
  std::swap(close_, other.close_);
  return *this;
}

bool Hdf5Handle::reset() {
  const hid_t id = std::exchange(id_, -1);
  return id < 0 || close_(id) >= 0;
}

Hdf5File::Unfinished::~Unfinished() {
  if (!file_.empty()) ::unlink(file_.c_str());
}

Hdf5File Hdf5File::create(const std::filesystem::path& file, const std::filesystem::path& shown_as,
                          std::uint64_t user_block) {
  const auto access = access_properties();
  const Hdf5Handle creation(H5Pcreate(H5P_FILE_CREATE), H5Pclose);
  if (user_block > 0) H5Pset_userblock(creation.id(), user_block);
  errno = 0;
  Hdf5File created(shown_as.empty() ? file : shown_as,
                   {H5Fcreate(file.c_str(), H5F_ACC_TRUNC, creation.id(), access.id()), H5Fclose});
  created.unfinished_ = Unfinished(file);  // whether or not it is valid: the library makes the file, then writes to it
  if (!created.file_.valid()) created.refuse_writing("");
  return created;
}

Hdf5File Hdf5File::create_in_memory(const std::filesystem::path& shown_as, std::uint64_t user_block,
                                    std::uint64_t size) {
  const auto access = access_properties();
  const Hdf5Handle creation(H5Pcreate(H5P_FILE_CREATE), H5Pclose);
  constexpr bool backing_store = false;
  errno = 0;
  // The file's memory grows by whole multiples of the second argument.
  if (H5Pset_fapl_core(access.id(), std::max<std::uint64_t>(size, 1 << 16), backing_store) < 0 ||
      (user_block > 0 && H5Pset_userblock(creation.id(), user_block) < 0))
    throw WriteError(shown_as, errno);
  // The library would read an existing file of this name: a name beneath a file never exists.
  const auto name = shown_as / "in memory";
  Hdf5File created(shown_as, {H5Fcreate(name.c_str(), H5F_ACC_TRUNC, creation.id(), access.id()), H5Fclose});
  if (!created.file_.valid()) created.refuse_writing("");
  return created;
}

Hdf5File Hdf5File::open(const std::filesystem::path& file, bool for_writing) {
  const auto access = access_properties();
  errno = 0;
  Hdf5File opened(file, {H5Fopen(file.c_str(), for_writing ? H5F_ACC_RDWR : H5F_ACC_RDONLY, access.id()), H5Fclose});
  if (!opened.file_.valid() && for_writing && errno != 0) opened.refuse_writing("");
  if (!opened.file_.valid()) opened.refuse_reading("");
  return opened;
}

Hdf5File Hdf5File::open_together(const std::filesystem::path& file, const std::filesystem::path& shown_as,
                                 const Communicator& processes) {
  const auto access = access_properties();
  Hdf5Handle transfer(H5Pcreate(H5P_DATASET_XFER), H5Pclose);
#ifdef FSI_WITH_MPI
  if (!processes.is_alone()) {
    H5Pset_fapl_mpio(access.id(), mpi_of(processes), MPI_INFO_NULL);
    H5Pset_all_coll_metadata_ops(access.id(), true);  // one reads them for all
    H5Pset_dxpl_mpio(transfer.id(), H5FD_MPIO_COLLECTIVE);
  }
#else
  static_cast<void>(processes);
#endif
  errno = 0;
  Hdf5File opened(shown_as, {H5Fopen(file.c_str(), H5F_ACC_RDWR, access.id()), H5Fclose});
  opened.transfer_ = std::move(transfer);
  if (!opened.file_.valid()) opened.refuse_writing("");
  return opened;
}

bool Hdf5File::has(const std::string& path) const {
  // The library wants every step of the path to exist before it is asked for the next.
  for (std::size_t slash = path.find('/', 1); slash != std::string::npos; slash = path.find('/', slash + 1))
    if (H5Lexists(file_.id(), path.substr(0, slash).c_str(), H5P_DEFAULT) <= 0) return false;
  return H5Lexists(file_.id(), path.c_str(), H5P_DEFAULT) > 0;
}

std::vector<std::uint64_t> Hdf5File::shape(const std::string& dataset) const {
  const Hdf5Handle data(H5Dopen2(file_.id(), dataset.c_str(), H5P_DEFAULT), H5Dclose);
  if (!data.valid()) refuse_reading(dataset);
  const Hdf5Handle space(H5Dget_space(data.id()), H5Sclose);
  const int rank = space.valid() ? H5Sget_simple_extent_ndims(space.id()) : -1;
  if (rank < 0) refuse_reading(dataset);
  std::vector<hsize_t> extent(static_cast<std::size_t>(rank));
  H5Sget_simple_extent_dims(space.id(), extent.data(), nullptr);
  return {extent.begin(), extent.end()};
}

std::uint64_t Hdf5File::place_of(const std::string& dataset) const {
  const Hdf5Handle data(H5Dopen2(file_.id(), dataset.c_str(), H5P_DEFAULT), H5Dclose);
  const haddr_t place = data.valid() ? H5Dget_offset(data.id()) : HADDR_UNDEF;
  if (place == HADDR_UNDEF) refuse_reading(dataset);
  return place;
}

std::vector<std::string> Hdf5File::members(const std::string& group) const {
  const Hdf5Handle opened(H5Gopen2(file_.id(), group.c_str(), H5P_DEFAULT), H5Gclose);
  H5G_info_t info;
  if (!opened.valid() || H5Gget_info(opened.id(), &info) < 0) refuse_reading(group);
  std::vector<std::string> names;
  for (hsize_t i = 0; i < info.nlinks; ++i) {
    const auto name_of = [&](char* name, std::size_t size) {
      return H5Lget_name_by_idx(opened.id(), ".", H5_INDEX_NAME, H5_ITER_INC, i, name, size, H5P_DEFAULT);
    };
    const auto length = name_of(nullptr, 0);
    if (length < 0) refuse_reading(group);
    std::string name(static_cast<std::size_t>(length), '\0');
    name_of(name.data(), name.size() + 1);
    names.push_back(name);
  }
  return names;
}

template <class Value>
void Hdf5File::create_dataset(const std::string& dataset, const std::vector<std::uint64_t>& shape) {
  const std::vector<hsize_t> extent(shape.begin(), shape.end());
  const Hdf5Handle space(H5Screate_simple(static_cast<int>(extent.size()), extent.data(), nullptr), H5Sclose);
  const Hdf5Handle links(H5Pcreate(H5P_LINK_CREATE), H5Pclose);
  H5Pset_create_intermediate_group(links.id(), 1);
  const Hdf5Handle creation(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  H5Pset_layout(creation.id(), H5D_CONTIGUOUS);
  H5Pset_alloc_time(creation.id(), H5D_ALLOC_TIME_EARLY);
  H5Pset_fill_time(creation.id(), H5D_FILL_TIME_NEVER);
  H5Pset_obj_track_times(creation.id(), false);
  errno = 0;
  Hdf5Handle data(
      H5Dcreate2(file_.id(), dataset.c_str(), native_type<Value>(), space.id(), links.id(), creation.id(), H5P_DEFAULT),
      H5Dclose);
  finish(data, dataset);
}

template <class Value>
void Hdf5File::write(const std::string& dataset, const Value* values) {
  if (product(shape(dataset)) == 0) return;
  Hdf5Handle data(H5Dopen2(file_.id(), dataset.c_str(), H5P_DEFAULT), H5Dclose);
  errno = 0;
  if (!data.valid() || H5Dwrite(data.id(), native_type<Value>(), H5S_ALL, H5S_ALL, H5P_DEFAULT, values) < 0)
    refuse_writing(dataset);
  finish(data, dataset);
}

template <class Value>
std::vector<Value> Hdf5File::read(const std::string& dataset) const {
  std::vector<Value> values(product(shape(dataset)));
  if (values.empty()) return values;
  const Hdf5Handle data(H5Dopen2(file_.id(), dataset.c_str(), H5P_DEFAULT), H5Dclose);
  if (!data.valid() || H5Dread(data.id(), native_type<Value>(), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) < 0)
    refuse_reading(dataset);
  return values;
}

namespace {

/// A dataset with a selected stretch of its numbers, which must be whole rows.
struct Part {
  Part(hid_t file, const std::string& dataset, std::uint64_t first, std::uint64_t count)
      : data(H5Dopen2(file, dataset.c_str(), H5P_DEFAULT), H5Dclose) {
    if (!data.valid()) return;
    there = Hdf5Handle(H5Dget_space(data.id()), H5Sclose);
    std::vector<hsize_t> from(static_cast<std::size_t>(std::max(H5Sget_simple_extent_ndims(there.id()), 1)), 0),
        size = from;
    H5Sget_simple_extent_dims(there.id(), size.data(), nullptr);
    std::uint64_t row = 1;
    for (std::size_t k = 1; k < size.size(); ++k) row *= size[k];
    from[0] = first / row;
    size[0] = count / row;
    const hsize_t numbers = count;
    here = Hdf5Handle(H5Screate_simple(1, &numbers, nullptr), H5Sclose);
    if (count == 0) {
      chosen = H5Sselect_none(there.id()) >= 0 && H5Sselect_none(here.id()) >= 0;
    } else {
      chosen = first % row == 0 && count % row == 0 &&
               H5Sselect_hyperslab(there.id(), H5S_SELECT_SET, from.data(), nullptr, size.data(), nullptr) >= 0;
    }
  }

  Hdf5Handle data, there, here;
  bool chosen = false;
};

}  // namespace

template <class Value>
bool Hdf5File::write_part(const std::string& dataset, std::uint64_t first, std::uint64_t count, const Value* values) {
  Part part(file_.id(), dataset, first, count);
  errno = 0;
  return part.chosen &&
         H5Dwrite(part.data.id(), native_type<Value>(), part.here.id(), part.there.id(), transfer_.id(), values) >= 0;
}

template <class Value>
std::vector<Value> Hdf5File::read_part(const std::string& dataset, std::uint64_t first, std::uint64_t count) const {
  std::vector<Value> values(count);
  const Part part(file_.id(), dataset, first, count);
  if (!part.chosen || (count > 0 && H5Dread(part.data.id(), native_type<Value>(), part.here.id(), part.there.id(),
                                            H5P_DEFAULT, values.data()) < 0))
    refuse_reading(dataset);
  return values;
}

bool Hdf5File::sync_together() {
  errno = 0;
  return H5Fflush(file_.id(), H5F_SCOPE_GLOBAL) >= 0;  // with MPI that is MPI_File_sync
}

template void Hdf5File::create_dataset<double>(const std::string&, const std::vector<std::uint64_t>&);
template void Hdf5File::create_dataset<std::int32_t>(const std::string&, const std::vector<std::uint64_t>&);
template void Hdf5File::create_dataset<std::int64_t>(const std::string&, const std::vector<std::uint64_t>&);
template void Hdf5File::create_dataset<std::uint8_t>(const std::string&, const std::vector<std::uint64_t>&);
template void Hdf5File::write<double>(const std::string&, const double*);
template void Hdf5File::write<std::int32_t>(const std::string&, const std::int32_t*);
template void Hdf5File::write<std::int64_t>(const std::string&, const std::int64_t*);
template void Hdf5File::write<std::uint8_t>(const std::string&, const std::uint8_t*);
template bool Hdf5File::write_part<double>(const std::string&, std::uint64_t, std::uint64_t, const double*);
template bool Hdf5File::write_part<std::int32_t>(const std::string&, std::uint64_t, std::uint64_t, const std::int32_t*);
template std::vector<double> Hdf5File::read_part<double>(const std::string&, std::uint64_t, std::uint64_t) const;
template std::vector<double> Hdf5File::read<double>(const std::string&) const;
template std::vector<std::int32_t> Hdf5File::read<std::int32_t>(const std::string&) const;
template std::vector<std::int64_t> Hdf5File::read<std::int64_t>(const std::string&) const;
template std::vector<std::uint8_t> Hdf5File::read<std::uint8_t>(const std::string&) const;

void Hdf5File::write_attribute(const std::string& object, const std::string& name, const std::string& text) {
  Hdf5Handle owner(H5Oopen(file_.id(), object.c_str(), H5P_DEFAULT), H5Oclose);
  const Hdf5Handle space(H5Screate(H5S_SCALAR), H5Sclose);
  const auto type = text_type(text.size());
  errno = 0;
  Hdf5Handle attribute(H5Acreate2(owner.id(), name.c_str(), type.id(), space.id(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  if (!attribute.valid() || H5Awrite(attribute.id(), type.id(), text.c_str()) < 0) refuse_writing(object);
  finish(attribute, object);
  finish(owner, object);
}

std::string Hdf5File::read_attribute(const std::string& object, const std::string& name) const {
  const Hdf5Handle attribute(H5Aopen_by_name(file_.id(), object.c_str(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT),
                             H5Aclose);
  if (!attribute.valid()) refuse_reading(object);
  const Hdf5Handle stored(H5Aget_type(attribute.id()), H5Tclose);
  std::string text(H5Tget_size(stored.id()), '\0');
  if (H5Tget_class(stored.id()) != H5T_STRING || H5Aread(attribute.id(), stored.id(), text.data()) < 0)
    refuse_reading(object);
  text.resize(text.find('\0') == std::string::npos ? text.size() : text.find('\0'));
  return text;
}

void Hdf5File::append_image(std::string& bytes) {
  flush();
  const ssize_t size = H5Fget_file_image(file_.id(), nullptr, 0);
  if (size <= 0) refuse_writing("");
  const auto before = bytes.size();
  bytes.resize(before + static_cast<std::size_t>(size));
  if (H5Fget_file_image(file_.id(), &bytes[before], static_cast<std::size_t>(size)) != size) refuse_writing("");
}

void Hdf5File::flush() {
  errno = 0;
  if (H5Fflush(file_.id(), H5F_SCOPE_GLOBAL) < 0) refuse_writing("");
}

void Hdf5File::close() {
  flush();
  errno = 0;
  if (!file_.reset()) refuse_writing("");
  unfinished_.forget();
}

void Hdf5File::finish(Hdf5Handle& handle, const std::string& object) {
  if (!handle.valid() || !handle.reset()) refuse_writing(object);
}

void Hdf5File::refuse_reading(const std::string& object) const {
  throw InputError(path_.string(), object, "cannot be read as HDF5", "give an undamaged result of this program");
}

void Hdf5File::refuse_writing(const std::string& object) {
  const int number = errno;
  file_.abandon();
  throw WriteError(path_, number, object);
}

}  // namespace fsi
