#include "output/hdf5_file.hpp"

#include <hdf5.h>

#include <algorithm>
#include <array>
#include <stdexcept>
#include <utility>

namespace sph {
namespace {

constexpr std::uint64_t max_io_bytes = std::uint64_t{1} << 30;

/// HDF5's innermost reason: the outer ones only name its own functions.
std::string innermost_reason() {
  std::string reason = "unknown HDF5 error";
  const auto keep_first = [](unsigned n, const H5E_error2_t* error, void* to) -> herr_t {
    if (n == 0 && error->desc != nullptr) *static_cast<std::string*>(to) = error->desc;
    return 0;
  };
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, keep_first, &reason);
  return reason;
}

[[noreturn]] void fail(const std::string& what) {
  throw std::runtime_error(what + ": " + innermost_reason());
}

void check(herr_t status, const std::string& what) {
  if (status < 0) fail(what);
}

class Handle {
 public:
  using Close = herr_t (*)(hid_t);
  Handle(hid_t id, Close close, const std::string& what) : id_(id), close_(close) {
    if (id_ < 0) fail(what);
  }
  ~Handle() {
    if (id_ >= 0) close_(id_);
  }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  operator hid_t() const { return id_; }
  [[nodiscard]] hid_t release() { return std::exchange(id_, -1); }

 private:
  hid_t id_;
  Close close_;
};

/// HDF5 prints every error by itself unless told not to; the setting belongs to the calling process.
void silence() { H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr); }

hid_t memory_type(Element element) {
  switch (element) {
    case Element::f64:
      return H5T_NATIVE_DOUBLE;
    case Element::i64:
      return H5T_NATIVE_INT64;
    case Element::u64:
      return H5T_NATIVE_UINT64;
    case Element::u32:
      return H5T_NATIVE_UINT32;
    case Element::u8:
      return H5T_NATIVE_UINT8;
  }
  throw std::logic_error("element type without HDF5 type");
}

Handle text_type() {
  Handle type(H5Tcopy(H5T_C_S1), H5Tclose, "H5Tcopy");
  check(H5Tset_size(type, H5T_VARIABLE), "H5Tset_size");
  check(H5Tset_cset(type, H5T_CSET_UTF8), "H5Tset_cset");
  return Handle(type.release(), H5Tclose, "text type");
}

Handle space_of(std::uint64_t rows, int components) {
  const std::array<hsize_t, 2> size{rows, static_cast<hsize_t>(components)};
  return Handle(H5Screate_simple(components == 1 ? 1 : 2, size.data(), nullptr), H5Sclose,
                "H5Screate_simple");
}

void add_attribute(hid_t object, const std::string& name, hid_t type, const Handle& space,
                   const void* value) {
  const Handle attribute(H5Acreate2(object, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose,
                         "create attribute " + name);
  if (value != nullptr) check(H5Awrite(attribute, type, value), "write attribute " + name);
}

Handle scalar_space() { return Handle(H5Screate(H5S_SCALAR), H5Sclose, "H5Screate"); }

void add_attribute(hid_t object, const std::string& name, const std::string& value) {
  const char* text = value.c_str();
  add_attribute(object, name, text_type(), scalar_space(), &text);
}
void add_attribute(hid_t object, const std::string& name, std::int64_t value) {
  add_attribute(object, name, H5T_NATIVE_INT64, scalar_space(), &value);
}
void add_attribute(hid_t object, const std::string& name, double value) {
  add_attribute(object, name, H5T_NATIVE_DOUBLE, scalar_space(), &value);
}
void add_attribute(hid_t object, const std::string& name, const std::vector<std::int64_t>& values) {
  add_attribute(object, name, H5T_NATIVE_INT64, space_of(values.size(), 1), values.data());
}
void add_attribute(hid_t object, const std::string& name, const std::vector<std::string>& values) {
  std::vector<const char*> texts;
  for (const std::string& value : values) texts.push_back(value.c_str());
  add_attribute(object, name, text_type(), space_of(values.size(), 1), texts.data());
}

std::uint64_t data_bytes(const DataSet& set) {
  return set.rows * static_cast<std::uint64_t>(set.components) * bytes(set.element);
}

Extent add_data_set(hid_t file, const DataSet& set) {
  const Handle links(H5Pcreate(H5P_LINK_CREATE), H5Pclose, "H5Pcreate");
  check(H5Pset_create_intermediate_group(links, 1), "H5Pset_create_intermediate_group");
  const Handle create(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, "H5Pcreate");
  check(H5Pset_layout(create, H5D_CONTIGUOUS), "H5Pset_layout");
  check(H5Pset_alloc_time(create, H5D_ALLOC_TIME_EARLY), "H5Pset_alloc_time");
  check(H5Pset_fill_time(create, H5D_FILL_TIME_NEVER), "H5Pset_fill_time");
  check(H5Pset_obj_track_times(create, false), "H5Pset_obj_track_times");
  const Handle data(H5Dcreate2(file, set.name.c_str(), memory_type(set.element),
                               space_of(set.rows, set.components), links, create, H5P_DEFAULT),
                    H5Dclose, "create data set " + set.name);
  if (!set.unit.empty()) add_attribute(data, "unit", set.unit);
  if (!set.meaning.empty()) add_attribute(data, "meaning", set.meaning);
  const haddr_t offset = H5Dget_offset(data);
  if (offset != HADDR_UNDEF) return {offset, data_bytes(set)};
  if (set.rows > 0) fail("place of data set " + set.name);
  return {0, 0};
}

/// An HDF5 file without contents, made in memory.
std::vector<std::byte> empty_file() {
  constexpr std::size_t increment = 4096;
  const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, "H5Pcreate");
  check(H5Pset_fapl_core(access, increment, false), "H5Pset_fapl_core");
  const Handle file(H5Fcreate("empty", H5F_ACC_TRUNC, H5P_DEFAULT, access), H5Fclose, "H5Fcreate");
  check(H5Fflush(file, H5F_SCOPE_GLOBAL), "H5Fflush");
  std::vector<std::byte> image(static_cast<std::size_t>(H5Fget_file_image(file, nullptr, 0)));
  if (H5Fget_file_image(file, image.data(), image.size()) < 0) fail("H5Fget_file_image");
  return image;
}

/// More than HDF5 needs besides the rows: it must never meet a full disk itself, since a file that it could
/// not close stays half open in the library and is its end when the program ends.
std::uint64_t structure_bytes(const std::vector<Attribute>& attributes,
                              const std::vector<DataSet>& data_sets) {
  constexpr std::uint64_t per_file = 32768;
  constexpr std::uint64_t per_object = 4096;
  std::uint64_t sum = per_file + per_object * (attributes.size() + 4 * data_sets.size());
  for (const Attribute& attribute : attributes) {
    if (const auto* text = std::get_if<std::string>(&attribute.value)) sum += 2 * text->size();
    if (const auto* texts = std::get_if<std::vector<std::string>>(&attribute.value))
      for (const std::string& text : *texts) sum += per_object + 2 * text.size();
  }
  return sum;
}

std::uint64_t data_bytes(const std::vector<DataSet>& data_sets) {
  std::uint64_t sum = 0;
  for (const DataSet& set : data_sets) sum += data_bytes(set);
  return sum;
}

}  // namespace

std::size_t bytes(Element element) {
  switch (element) {
    case Element::u8:
      return 1;
    case Element::u32:
      return 4;
    default:
      return 8;
  }
}

Element element_of(Type type) {
  switch (type) {
    case Type::f64:
      return Element::f64;
    case Type::i64:
      return Element::i64;
    case Type::u64:
      return Element::u64;
    case Type::u32:
      return Element::u32;
  }
  throw std::logic_error("field type without element type");
}

std::vector<Extent> lay_out(const std::filesystem::path& path, const std::vector<Attribute>& attributes,
                            const std::vector<DataSet>& data_sets) {
  silence();
  create_reserved(path, empty_file(), data_bytes(data_sets) + structure_bytes(attributes, data_sets));
  std::vector<Extent> extents;
  Handle file(H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT), H5Fclose, "open " + path.string());
  for (const Attribute& attribute : attributes)
    std::visit([&](const auto& value) { add_attribute(file, attribute.name, value); }, attribute.value);
  for (const DataSet& set : data_sets) extents.push_back(add_data_set(file, set));
  check(H5Fclose(file.release()), "close " + path.string());  // gives back what was reserved too much
  return extents;
}

SharedHdf5File::SharedHdf5File(const std::filesystem::path& path, MPI_Comm comm) : id_(-1) {
  silence();
  const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, "H5Pcreate");
  check(H5Pset_fapl_mpio(access, comm, MPI_INFO_NULL), "H5Pset_fapl_mpio");
  id_ = Handle(H5Fopen(path.c_str(), H5F_ACC_RDWR, access), H5Fclose, "open " + path.string()).release();
}

SharedHdf5File::~SharedHdf5File() {
  if (id_ >= 0) H5Fclose(id_);
}

void SharedHdf5File::close() { check(H5Fclose(std::exchange(id_, -1)), "close"); }

void SharedHdf5File::write(const DataSet& set, std::uint64_t first, std::uint64_t rows, const void* values) {
  if (rows == 0) return;
  const Handle data(H5Dopen2(id_, set.name.c_str(), H5P_DEFAULT), H5Dclose, "open data set " + set.name);
  const Handle file_space(H5Dget_space(data), H5Sclose, "H5Dget_space");
  const std::uint64_t row_bytes = static_cast<std::uint64_t>(set.components) * bytes(set.element);
  const std::uint64_t longest = std::max<std::uint64_t>(1, max_io_bytes / row_bytes);
  for (std::uint64_t done = 0; done < rows;) {
    const std::uint64_t n = std::min(longest, rows - done);
    const std::array<hsize_t, 2> start{first + done, 0};
    const std::array<hsize_t, 2> count{n, static_cast<hsize_t>(set.components)};
    check(H5Sselect_hyperslab(file_space, H5S_SELECT_SET, start.data(), nullptr, count.data(), nullptr),
          "select rows of " + set.name);
    // Independent transfer: a rank's rows are one contiguous run, and a failure stays on its rank.
    check(H5Dwrite(data, memory_type(set.element), space_of(n, set.components), file_space, H5P_DEFAULT,
                   static_cast<const std::byte*>(values) + done * row_bytes),
          "write " + set.name);
    done += n;
  }
}

Hdf5Reader::Hdf5Reader(const std::filesystem::path& path) : id_(-1) {
  silence();
  id_ =
      Handle(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose, "open " + path.string()).release();
}

Hdf5Reader::~Hdf5Reader() { H5Fclose(id_); }

bool Hdf5Reader::has(const std::string& data_set) const {
  // A path exists if each of its groups does; asking for the whole path at once is an error otherwise.
  for (std::size_t end = 0; end != std::string::npos;) {
    end = data_set.find('/', end + 1);
    if (H5Lexists(id_, data_set.substr(0, end).c_str(), H5P_DEFAULT) <= 0) return false;
  }
  return true;
}

std::uint64_t Hdf5Reader::rows(const std::string& data_set) const {
  const Handle data(H5Dopen2(id_, data_set.c_str(), H5P_DEFAULT), H5Dclose, "open data set " + data_set);
  const Handle space(H5Dget_space(data), H5Sclose, "H5Dget_space");
  std::array<hsize_t, H5S_MAX_RANK> size{};
  check(H5Sget_simple_extent_dims(space, size.data(), nullptr), "size of " + data_set);
  return size[0];
}

int Hdf5Reader::components(const std::string& data_set) const {
  const Handle data(H5Dopen2(id_, data_set.c_str(), H5P_DEFAULT), H5Dclose, "open data set " + data_set);
  const Handle space(H5Dget_space(data), H5Sclose, "H5Dget_space");
  std::array<hsize_t, H5S_MAX_RANK> size{};
  const int rank = H5Sget_simple_extent_dims(space, size.data(), nullptr);
  if (rank < 1) fail("size of " + data_set);
  return rank == 1 ? 1 : static_cast<int>(size[1]);
}

void Hdf5Reader::read(const std::string& data_set, Element element, void* values) const {
  const Handle data(H5Dopen2(id_, data_set.c_str(), H5P_DEFAULT), H5Dclose, "open data set " + data_set);
  check(H5Dread(data, memory_type(element), H5S_ALL, H5S_ALL, H5P_DEFAULT, values), "read " + data_set);
}

void Hdf5Reader::read_rows(const std::string& data_set, Element element, std::uint64_t first,
                           std::uint64_t rows, void* values) const {
  if (rows == 0) return;
  const Handle data(H5Dopen2(id_, data_set.c_str(), H5P_DEFAULT), H5Dclose, "open data set " + data_set);
  const Handle file_space(H5Dget_space(data), H5Sclose, "H5Dget_space");
  const std::array<hsize_t, 2> start{first, 0};
  const std::array<hsize_t, 2> count{rows, static_cast<hsize_t>(components(data_set))};
  check(H5Sselect_hyperslab(file_space, H5S_SELECT_SET, start.data(), nullptr, count.data(), nullptr),
        "select rows of " + data_set);
  const Handle memory(H5Screate_simple(2, count.data(), nullptr), H5Sclose, "H5Screate_simple");
  check(H5Dread(data, memory_type(element), memory, file_space, H5P_DEFAULT, values), "read " + data_set);
}

std::int64_t Hdf5Reader::integer(const std::string& attribute) const {
  const Handle handle(H5Aopen(id_, attribute.c_str(), H5P_DEFAULT), H5Aclose, "attribute " + attribute);
  std::int64_t value = 0;
  check(H5Aread(handle, H5T_NATIVE_INT64, &value), "read attribute " + attribute);
  return value;
}

double Hdf5Reader::real(const std::string& attribute) const {
  const Handle handle(H5Aopen(id_, attribute.c_str(), H5P_DEFAULT), H5Aclose, "attribute " + attribute);
  double value = 0;
  check(H5Aread(handle, H5T_NATIVE_DOUBLE, &value), "read attribute " + attribute);
  return value;
}

std::string Hdf5Reader::text(const std::string& attribute) const {
  const Handle handle(H5Aopen(id_, attribute.c_str(), H5P_DEFAULT), H5Aclose, "attribute " + attribute);
  char* value = nullptr;
  check(H5Aread(handle, text_type(), static_cast<void*>(&value)), "read attribute " + attribute);
  const std::string text = value == nullptr ? "" : value;
  check(H5free_memory(value), "H5free_memory");
  return text;
}

std::string hdf5_version() {
  unsigned major = 0, minor = 0, release = 0;
  check(H5get_libversion(&major, &minor, &release), "H5get_libversion");
  return std::to_string(major) + "." + std::to_string(minor) + "." + std::to_string(release);
}

}  // namespace sph
