// The only door to HDF5. A file is written in two parts: one rank lays out its whole structure and reserves
// the disk space, then all ranks fill in rows, each at its own place. After the first part nothing but raw
// rows changes, so the bytes do not depend on the number of ranks. Of compressed rows the sizes are known before
// the first part, and chunks of them are filled in. HDF5 makes the structure in memory and
// meets no disk (memory_file.hpp); no rank waits for another while files are written, so that one that
// cannot write is no reason to hang.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "files/descriptor.hpp"
#include "files/durable_file.hpp"
#include "sph/core/fields.hpp"

namespace sph {

enum class Element : std::uint8_t { f64, i64, u64, u32, u8 };
[[nodiscard]] std::size_t bytes(Element element);
[[nodiscard]] Element element_of(Type type);

/// Rows that are stored in compressed chunks (packed_rows.hpp).
struct Chunks {
  std::uint64_t rows = 0;            ///< of each, the last filled up with zeros; 0: contiguous, as they are
  int level = 0;                     ///< of deflate
  std::vector<std::uint64_t> bytes;  ///< of each as it is stored
};

struct DataSet {
  std::string name;  ///< with its groups: "particles/velocity"
  Element element;
  std::uint64_t rows;
  int components;
  std::string unit, meaning;         ///< attributes; empty: none
  std::string component_names = {};  ///< attribute "components"; empty: none
  Chunks chunks = {};
  [[nodiscard]] std::size_t extents() const { return chunks.rows > 0 ? chunks.bytes.size() : 1; }
};

/// Rows of a data set once more, in another shape and under another name (HDF5's virtual data set): no values of its own.
struct DataView {
  std::string name;
  std::size_t of;                    ///< which data set
  std::uint64_t first;               ///< of its rows
  std::vector<std::uint64_t> shape;  ///< of the rows, the slowest axis first
};

struct Attribute {
  std::string name;
  std::variant<std::int64_t, double, std::string, std::vector<std::int64_t>, std::vector<std::string>> value;
};

/// Creates `path` with all its structure and reserves its disk space. One rank. Returns where the rows of
/// each data set lie in the file: contiguous, in the machine's own byte order, or those of each of its chunks.
std::vector<Extent> lay_out(const std::filesystem::path& path, const std::vector<Attribute>& attributes,
                            const std::vector<DataSet>& data_sets, const std::vector<DataView>& views = {});

/// Where rows go.
class RowSink {
 public:
  virtual ~RowSink() = default;
  /// Rows [first, first + rows) of the set-th data set.
  virtual void write(std::size_t set, std::uint64_t first, std::uint64_t rows, const void* values) = 0;
};

/// A laid-out file, open for rows on this rank. For writing only: a client of NFS then sends just the bytes
/// it was given, and none of what other ranks write beside them. Errors are std::runtime_error.
class RowFile : public RowSink {
 public:
  /// `sets` and `extents` are those of lay_out(), and must outlive this.
  RowFile(const std::filesystem::path& path, const std::vector<DataSet>& sets,
          const std::vector<Extent>& extents);
  /// Of a file without chunks.
  void write(std::size_t set, std::uint64_t first, std::uint64_t rows, const void* values) override;
  void fill(std::size_t extent, std::span<const std::byte> bytes);
  void finish();  ///< waits for the disk and closes

 private:
  Descriptor file_;
  const std::vector<DataSet>& sets_;
  const std::vector<Extent>& extents_;
};

/// How a data set is stored, whatever it is converted to when it is read.
struct StoredAs {
  enum class Numbers { whole, real, none };
  Numbers numbers = Numbers::none;
  bool with_sign = false;
  std::size_t bytes = 0;  ///< of a number
  std::string type;       ///< "64-bit real numbers", for messages
  std::vector<std::uint64_t> extent;
};

/// A file open for reading by one process.
class Hdf5Reader {
 public:
  explicit Hdf5Reader(const std::filesystem::path& path);
  ~Hdf5Reader();
  Hdf5Reader(const Hdf5Reader&) = delete;
  Hdf5Reader& operator=(const Hdf5Reader&) = delete;
  [[nodiscard]] bool has(const std::string& data_set) const;
  [[nodiscard]] StoredAs stored_as(const std::string& data_set) const;
  [[nodiscard]] std::uint64_t rows(const std::string& data_set) const;
  [[nodiscard]] int components(const std::string& data_set) const;
  void read(const std::string& data_set, Element element, void* values) const;  ///< all rows
  void read_rows(const std::string& data_set, Element element, std::uint64_t first, std::uint64_t rows,
                 void* values) const;

  [[nodiscard]] std::int64_t integer(const std::string& attribute) const;
  [[nodiscard]] double real(const std::string& attribute) const;
  [[nodiscard]] std::string text(const std::string& attribute) const;
  [[nodiscard]] bool has_attribute(const std::string& attribute) const;
  /// An attribute of a data set, if it has that.
  [[nodiscard]] std::optional<std::string> text_of(const std::string& data_set,
                                                   const std::string& attribute) const;

 private:
  std::int64_t id_;
};

[[nodiscard]] std::string hdf5_version();

}  // namespace sph
