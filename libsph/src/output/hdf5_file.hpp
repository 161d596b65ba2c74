// The only door to HDF5. A file is written in two parts: one rank lays out its whole structure and reserves
// the disk space, then all ranks fill in rows. After the first part nothing but raw rows changes, so the
// bytes do not depend on the number of ranks, and a full disk shows up on one rank before others are involved
// (collective HDF5 calls that fail on some ranks only leave the others waiting).
#pragma once

#include <mpi.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <variant>
#include <vector>

#include "output/durable_file.hpp"
#include "sph/fields.hpp"

namespace sph {

enum class Element : std::uint8_t { f64, i64, u64, u32, u8 };
[[nodiscard]] std::size_t bytes(Element element);
[[nodiscard]] Element element_of(Type type);

struct DataSet {
  std::string name;  ///< with its groups: "particles/velocity"
  Element element;
  std::uint64_t rows;
  int components;
  std::string unit, meaning;  ///< attributes; empty: none
};

struct Attribute {
  std::string name;
  std::variant<std::int64_t, double, std::string, std::vector<std::int64_t>, std::vector<std::string>> value;
};

/// Creates `path` with all its structure and reserves its disk space. One rank. Returns where the rows of
/// each data set lie in the file: contiguous, in the machine's own byte order.
std::vector<Extent> lay_out(const std::filesystem::path& path, const std::vector<Attribute>& attributes,
                            const std::vector<DataSet>& data_sets);

/// A laid-out file, open for rows on all ranks of a communicator. Opening and closing are collective,
/// writing is not. Errors are std::runtime_error with HDF5's innermost reason.
class SharedHdf5File {
 public:
  SharedHdf5File(const std::filesystem::path& path, MPI_Comm comm);
  ~SharedHdf5File();
  SharedHdf5File(const SharedHdf5File&) = delete;
  SharedHdf5File& operator=(const SharedHdf5File&) = delete;
  void write(const DataSet& set, std::uint64_t first, std::uint64_t rows, const void* values);
  void close();

 private:
  std::int64_t id_;
};

/// A file open for reading by one process.
class Hdf5Reader {
 public:
  explicit Hdf5Reader(const std::filesystem::path& path);
  ~Hdf5Reader();
  Hdf5Reader(const Hdf5Reader&) = delete;
  Hdf5Reader& operator=(const Hdf5Reader&) = delete;
  [[nodiscard]] bool has(const std::string& data_set) const;
  [[nodiscard]] std::uint64_t rows(const std::string& data_set) const;
  [[nodiscard]] int components(const std::string& data_set) const;
  void read(const std::string& data_set, Element element, void* values) const;  ///< all rows
  void read_rows(const std::string& data_set, Element element, std::uint64_t first, std::uint64_t rows,
                 void* values) const;

  [[nodiscard]] std::int64_t integer(const std::string& attribute) const;
  [[nodiscard]] double real(const std::string& attribute) const;
  [[nodiscard]] std::string text(const std::string& attribute) const;

 private:
  std::int64_t id_;
};

[[nodiscard]] std::string hdf5_version();

}  // namespace sph
