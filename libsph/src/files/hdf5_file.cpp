#include "files/hdf5_file.hpp"

#include <fcntl.h>
#include <hdf5.h>

#include <algorithm>
#include <array>
#include <stdexcept>
#include <utility>

#include "files/memory_file.hpp"

namespace sph {
namespace {

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

/// Of rows in any shape.
Handle space_of(const std::vector<std::uint64_t>& shape, int components) {
  std::vector<hsize_t> size(shape.begin(), shape.end());
  if (components != 1) size.push_back(static_cast<hsize_t>(components));
  return Handle(H5Screate_simple(static_cast<int>(size.size()), size.data(), nullptr), H5Sclose,
                "H5Screate_simple");
}
Handle space_of(std::uint64_t rows, int components) {
  return space_of(std::vector<std::uint64_t>{rows}, components);
}

void select_rows(const Handle& space, const std::string& data_set, std::uint64_t first, std::uint64_t rows,
                 int components) {
  const std::array<hsize_t, 2> start{first, 0};
  const std::array<hsize_t, 2> count{rows, static_cast<hsize_t>(components)};
  check(H5Sselect_hyperslab(space, H5S_SELECT_SET, start.data(), nullptr, count.data(), nullptr),
        "select rows of " + data_set);
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

std::string text_at(hid_t object, const std::string& attribute) {
  const Handle handle(H5Aopen(object, attribute.c_str(), H5P_DEFAULT), H5Aclose, "attribute " + attribute);
  char* value = nullptr;
  check(H5Aread(handle, text_type(), static_cast<void*>(&value)), "read attribute " + attribute);
  const std::string text = value == nullptr ? "" : value;
  check(H5free_memory(value), "H5free_memory");
  return text;
}

std::uint64_t data_bytes(const DataSet& set) {
  return set.rows * static_cast<std::uint64_t>(set.components) * bytes(set.element);
}

/// With the groups that it is in, and what it says of itself.
Handle create_described(hid_t file, const std::string& name, const DataSet& set, const Handle& space,
                        const Handle& create) {
  const Handle links(H5Pcreate(H5P_LINK_CREATE), H5Pclose, "H5Pcreate");
  check(H5Pset_create_intermediate_group(links, 1), "H5Pset_create_intermediate_group");
  check(H5Pset_obj_track_times(create, false), "H5Pset_obj_track_times");
  Handle data(H5Dcreate2(file, name.c_str(), memory_type(set.element), space, links, create, H5P_DEFAULT),
              H5Dclose, "create data set " + name);
  if (!set.unit.empty()) add_attribute(data, "unit", set.unit);
  if (!set.meaning.empty()) add_attribute(data, "meaning", set.meaning);
  if (!set.component_names.empty()) add_attribute(data, "components", set.component_names);
  return Handle(data.release(), H5Dclose, name);
}

/// Each chunk gets its place by being written, though with zeros, of which the file in memory keeps none.
void add_chunks(hid_t file, const DataSet& set, std::vector<Extent>& extents) {
  const std::array<hsize_t, 2> size{set.chunks.rows, static_cast<hsize_t>(set.components)};
  const Handle create(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, "H5Pcreate");
  check(H5Pset_chunk(create, set.components == 1 ? 1 : 2, size.data()), "H5Pset_chunk");
  check(H5Pset_shuffle(create), "H5Pset_shuffle");
  check(H5Pset_deflate(create, static_cast<unsigned>(set.chunks.level)), "H5Pset_deflate");
  const Handle data = create_described(file, set.name, set, space_of(set.rows, set.components), create);
  const std::vector<std::byte> zeros(std::ranges::max(set.chunks.bytes));
  std::array<hsize_t, 2> first{};
  for (const std::uint64_t bytes : set.chunks.bytes) {
    haddr_t offset = 0;
    if (bytes > 0) {  // HDF5 reads zeros where there is no chunk
      check(H5Dwrite_chunk(data, H5P_DEFAULT, 0, first.data(), bytes, zeros.data()), "H5Dwrite_chunk");
      check(H5Dget_chunk_info_by_coord(data, first.data(), nullptr, &offset, nullptr),
            "H5Dget_chunk_info_by_coord");
    }
    extents.push_back({offset, bytes});
    first[0] += set.chunks.rows;
  }
}

Extent add_data_set(hid_t file, const DataSet& set) {
  const Handle create(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, "H5Pcreate");
  check(H5Pset_layout(create, H5D_CONTIGUOUS), "H5Pset_layout");
  check(H5Pset_alloc_time(create, H5D_ALLOC_TIME_EARLY), "H5Pset_alloc_time");
  check(H5Pset_fill_time(create, H5D_FILL_TIME_NEVER), "H5Pset_fill_time");
  const Handle data = create_described(file, set.name, set, space_of(set.rows, set.components), create);
  const haddr_t offset = H5Dget_offset(data);
  if (offset != HADDR_UNDEF) return {offset, data_bytes(set)};
  if (set.rows > 0) fail("place of data set " + set.name);
  return {0, 0};
}

void add_view(hid_t file, const DataView& view, const DataSet& set) {
  const Handle whole = space_of(view.shape, set.components);
  const Handle rows = space_of(set.rows, set.components);
  std::uint64_t count = 1;
  for (std::uint64_t size : view.shape) count *= size;
  select_rows(rows, set.name, view.first, count, set.components);
  const Handle create(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, "H5Pcreate");
  // "." is the file that the view is in, whatever its name.
  check(H5Pset_virtual(create, whole, ".", ("/" + set.name).c_str(), rows), "H5Pset_virtual");
  (void)create_described(file, view.name, set, whole, create);
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
                            const std::vector<DataSet>& data_sets, const std::vector<DataView>& views) {
  silence();
  std::vector<Extent> extents;
  MemoryFile image;
  {
    const Handle access(access_in_memory(image), H5Pclose, "HDF5 file in memory");
    Handle file(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access), H5Fclose, "H5Fcreate");
    for (const Attribute& attribute : attributes)
      std::visit([&](const auto& value) { add_attribute(file, attribute.name, value); }, attribute.value);
    for (const DataSet& set : data_sets)
      if (set.chunks.rows > 0)
        add_chunks(file, set, extents);
      else
        extents.push_back(add_data_set(file, set));
    for (const DataView& view : views) add_view(file, view, data_sets[view.of]);
    check(H5Fclose(file.release()), "H5Fclose");
  }
  Descriptor file = create_anew(path);
  file.reserve(image.length);
  image.bytes.for_each_run(
      image.length, [&](std::uint64_t at, std::span<const std::byte> bytes) { file.write_at(at, bytes); });
  file.close();
  return extents;
}

RowFile::RowFile(const std::filesystem::path& path, const std::vector<DataSet>& sets,
                 const std::vector<Extent>& extents)
    : file_(path, O_WRONLY), sets_(sets), extents_(extents) {}

void RowFile::write(std::size_t set, std::uint64_t first, std::uint64_t rows, const void* values) {
  const DataSet& s = sets_[set];
  if (rows == 0) return;
  if (first + rows > s.rows) throw std::logic_error("rows beyond the end of data set " + s.name);
  const std::uint64_t row_bytes = static_cast<std::uint64_t>(s.components) * bytes(s.element);
  file_.write_at(extents_[set].offset + first * row_bytes,
                 {static_cast<const std::byte*>(values), rows * row_bytes});
}

void RowFile::fill(std::size_t extent, std::span<const std::byte> bytes) {
  if (bytes.size() != extents_[extent].bytes) throw std::logic_error("bytes do not fill their place");
  file_.write_at(extents_[extent].offset, bytes);
}

void RowFile::finish() {
  file_.sync();
  file_.close();
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

StoredAs Hdf5Reader::stored_as(const std::string& data_set) const {
  const Handle data(H5Dopen2(id_, data_set.c_str(), H5P_DEFAULT), H5Dclose, "open data set " + data_set);
  const Handle type(H5Dget_type(data), H5Tclose, "type of " + data_set);
  const Handle space(H5Dget_space(data), H5Sclose, "H5Dget_space");
  StoredAs out;
  out.bytes = H5Tget_size(type);
  const std::string bits = std::to_string(8 * out.bytes) + "-bit ";
  switch (H5Tget_class(type)) {
    case H5T_INTEGER:
      out.numbers = StoredAs::Numbers::whole;
      out.with_sign = H5Tget_sign(type) != H5T_SGN_NONE;
      out.type = bits + (out.with_sign ? "integers" : "integers without sign");
      break;
    case H5T_FLOAT:
      out.numbers = StoredAs::Numbers::real;
      out.type = bits + "real numbers";
      break;
    default:
      out.type = "no numbers";
  }
  std::array<hsize_t, H5S_MAX_RANK> size{};
  const int axes = H5Sget_simple_extent_dims(space, size.data(), nullptr);
  if (axes < 0) fail("size of " + data_set);
  out.extent.assign(size.begin(), size.begin() + axes);
  return out;
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
  select_rows(file_space, data_set, first, rows, components(data_set));
  const Handle memory = space_of(rows, components(data_set));
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

std::string Hdf5Reader::text(const std::string& attribute) const { return text_at(id_, attribute); }

bool Hdf5Reader::has_attribute(const std::string& attribute) const {
  return H5Aexists(id_, attribute.c_str()) > 0;
}

std::optional<std::string> Hdf5Reader::text_of(const std::string& data_set,
                                               const std::string& attribute) const {
  const Handle data(H5Dopen2(id_, data_set.c_str(), H5P_DEFAULT), H5Dclose, "open data set " + data_set);
  if (H5Aexists(data, attribute.c_str()) <= 0) return std::nullopt;
  return text_at(data, attribute);
}

std::string hdf5_version() {
  unsigned major = 0, minor = 0, release = 0;
  check(H5get_libversion(&major, &minor, &release), "H5get_libversion");
  return std::to_string(major) + "." + std::to_string(minor) + "." + std::to_string(release);
}

}  // namespace sph
