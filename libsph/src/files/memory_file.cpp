#include "files/memory_file.hpp"

#include <hdf5.h>

#include <algorithm>
#include <cstring>
#include <exception>
#include <memory>
#include <vector>

namespace sph {
namespace {

bool all_zero(std::span<const std::byte> bytes) {
  return std::ranges::all_of(bytes, [](std::byte b) { return b == std::byte{0}; });
}

}  // namespace

void SparseBytes::write(std::uint64_t at, std::span<const std::byte> from) {
  while (!from.empty()) {
    const std::uint64_t within = at % page_bytes;
    const std::size_t n = std::min<std::size_t>(from.size(), page_bytes - within);
    if (!all_zero(from.first(n)) || pages_.contains(at / page_bytes))
      std::memcpy(pages_.try_emplace(at / page_bytes).first->second.data() + within, from.data(), n);
    at += n;
    from = from.subspan(n);
  }
}

void SparseBytes::read(std::uint64_t at, std::span<std::byte> to) const {
  while (!to.empty()) {
    const std::uint64_t within = at % page_bytes;
    const std::size_t n = std::min<std::size_t>(to.size(), page_bytes - within);
    if (const auto page = pages_.find(at / page_bytes); page != pages_.end())
      std::memcpy(to.data(), page->second.data() + within, n);
    else
      std::memset(to.data(), 0, n);
    at += n;
    to = to.subspan(n);
  }
}

void SparseBytes::for_each_run(
    std::uint64_t end, const std::function<void(std::uint64_t, std::span<const std::byte>)>& take) const {
  std::vector<std::byte> run;
  std::uint64_t start = 0;
  const auto flush = [&] {
    if (start < end && !run.empty())
      take(start, std::span(run).first(std::min<std::uint64_t>(run.size(), end - start)));
    run.clear();
  };
  for (const auto& [index, page] : pages_) {
    if (run.empty() || start + run.size() != index * page_bytes) {
      flush();
      start = index * page_bytes;
    }
    run.insert(run.end(), page.begin(), page.end());
  }
  flush();
}

namespace {

/// HDF5's handle of a file, as its drivers extend it: the public part comes first.
struct OpenFile {
  H5FD_t common;
  MemoryFile* file;
  haddr_t allocated;  ///< "end of address": how long the file is to be
};
OpenFile& open_file(H5FD_t* file) { return *reinterpret_cast<OpenFile*>(file); }
const OpenFile& open_file(const H5FD_t* file) { return *reinterpret_cast<const OpenFile*>(file); }

/// HDF5 is C: nothing may be thrown through it.
template <class Work>
herr_t status_of(Work&& work) {
  try {
    work();
    return 0;
  } catch (const std::exception&) {
    return -1;
  }
}

H5FD_t* open_in_memory(const char*, unsigned, hid_t access, haddr_t) {
  const auto* const to = static_cast<MemoryFile* const*>(H5Pget_driver_info(access));
  if (to == nullptr) return nullptr;
  std::unique_ptr<OpenFile> made;
  if (status_of([&] { made = std::make_unique<OpenFile>(OpenFile{{}, *to, 0}); }) < 0) return nullptr;
  return &made.release()->common;
}
herr_t close_in_memory(H5FD_t* file) {
  delete &open_file(file);
  return 0;
}
haddr_t allocated(const H5FD_t* file, H5FD_mem_t) { return open_file(file).allocated; }
herr_t allocate(H5FD_t* file, H5FD_mem_t, haddr_t to) {
  open_file(file).allocated = to;
  return 0;
}
haddr_t length(const H5FD_t* file, H5FD_mem_t) { return open_file(file).file->length; }
herr_t read_memory(H5FD_t* file, H5FD_mem_t, hid_t, haddr_t at, std::size_t size, void* to) {
  open_file(file).file->bytes.read(at, {static_cast<std::byte*>(to), size});
  return 0;
}
herr_t write_memory(H5FD_t* file, H5FD_mem_t, hid_t, haddr_t at, std::size_t size, const void* from) {
  MemoryFile& to = *open_file(file).file;
  return status_of([&] {
    to.bytes.write(at, {static_cast<const std::byte*>(from), size});
    to.length = std::max<std::uint64_t>(to.length, at + size);
  });
}
herr_t truncate_memory(H5FD_t* file, hid_t, hbool_t) {
  open_file(file).file->length = open_file(file).allocated;
  return 0;
}
herr_t features(const H5FD_t*, unsigned long* flags) {
  if (flags != nullptr)
    *flags = H5FD_FEAT_AGGREGATE_METADATA | H5FD_FEAT_ACCUMULATE_METADATA | H5FD_FEAT_AGGREGATE_SMALLDATA;
  return 0;
}

const H5FD_class_t& driver_class() {
  static const H5FD_class_t driver = [] {
    H5FD_class_t c{};
    c.name = "memory of peperite";
    c.maxaddr = HADDR_MAX / 2;
    c.fc_degree = H5F_CLOSE_WEAK;
    c.fapl_size = sizeof(MemoryFile*);
    c.open = open_in_memory;
    c.close = close_in_memory;
    c.query = features;
    c.get_eoa = allocated;
    c.set_eoa = allocate;
    c.get_eof = length;
    c.read = read_memory;
    c.write = write_memory;
    c.truncate = truncate_memory;
    constexpr std::array<H5FD_mem_t, H5FD_MEM_NTYPES> map = H5FD_FLMAP_DICHOTOMY;  // structure, rows
    std::copy(map.begin(), map.end(), c.fl_map);
    return c;
  }();
  return driver;
}

}  // namespace

std::int64_t access_in_memory(MemoryFile& to) {
  const hid_t access = H5Pcreate(H5P_FILE_ACCESS);
  const hid_t driver = H5FDregister(&driver_class());
  MemoryFile* const info = &to;
  const bool good = access >= 0 && driver >= 0 && H5Pset_driver(access, driver, &info) >= 0;
  if (driver >= 0) H5FDunregister(driver);  // the property list keeps it as long as it is needed
  if (good) return access;
  if (access >= 0) H5Pclose(access);
  return -1;
}

}  // namespace sph
