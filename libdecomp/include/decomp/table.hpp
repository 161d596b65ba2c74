// Rows of particles stored as columns of fixed width. The library moves rows and columns; only the user
// knows what a column means. Rows [0, owned) belong to this rank, rows [owned, rows) are halo copies.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace decomp {

/// What becomes of a column's values where rows move: they go with their rows; or they are written anew before anyone
/// reads them, so that they take no time, no messages and, in rows that nobody writes, no memory.
enum class Values : std::uint8_t { kept, passing };

/// One column: `width` bytes a row, contiguous by row, 64-byte aligned, padded so that a SIMD block that
/// starts at any row may be read past the end without leaving the allocation.
class Column {
 public:
  Column(std::string name, std::size_t width, Values values = Values::kept)
      : name_(std::move(name)), width_(width), values_(values) {}
  [[nodiscard]] const std::string& name() const { return name_; }
  [[nodiscard]] std::size_t width() const { return width_; }
  [[nodiscard]] bool kept() const { return values_ == Values::kept; }
  [[nodiscard]] std::byte* data() { return data_.get(); }
  [[nodiscard]] const std::byte* data() const { return data_.get(); }
  [[nodiscard]] std::size_t capacity() const { return capacity_; }  ///< rows
  void reserve(std::size_t rows);          ///< keeps what is kept of the first min(old, new) rows
  void swap_data(Column& other) noexcept;  ///< exchanges storage with a column of the same width

 private:
  struct Free {
    void operator()(std::byte* p) const noexcept;
  };
  std::string name_;
  std::size_t width_;
  Values values_;
  std::size_t capacity_ = 0;
  std::unique_ptr<std::byte[], Free> data_;
};

class Table {
 public:
  /// Returns the new column's index. Only while the table is empty.
  int add_column(std::string name, std::size_t width, Values values = Values::kept);
  [[nodiscard]] int columns() const { return static_cast<int>(columns_.size()); }
  [[nodiscard]] Column& column(int c) { return columns_[static_cast<std::size_t>(c)]; }
  [[nodiscard]] const Column& column(int c) const { return columns_[static_cast<std::size_t>(c)]; }
  [[nodiscard]] std::size_t kept_bytes() const;  ///< of a row: sum of widths of what is kept

  [[nodiscard]] std::size_t owned() const { return owned_; }
  [[nodiscard]] std::size_t halo() const { return halo_; }
  [[nodiscard]] std::size_t rows() const { return owned_ + halo_; }
  /// Grows or shrinks; rows that stay have what is kept, new rows are unspecified.
  void resize(std::size_t owned, std::size_t halo);
  /// Owned row r becomes old row order[r]; order.size() is the new number of owned rows (may be smaller:
  /// rows not named are dropped). Halo rows are dropped.
  void reorder(std::span<const std::uint32_t> order);

  template <class T>
  [[nodiscard]] T* as(int c) {
    return reinterpret_cast<T*>(column(c).data());
  }
  template <class T>
  [[nodiscard]] const T* as(int c) const {
    return reinterpret_cast<const T*>(column(c).data());
  }

 private:
  std::vector<Column> columns_;
  std::size_t owned_ = 0;
  std::size_t halo_ = 0;
};

/// Variable-length data that travels with a row (contact history, bonds). Row r owns bytes
/// [offset[r], offset[r+1]) of `bytes`; offset has owned+1 entries.
struct Payload {
  std::vector<std::uint64_t> offset{0};
  std::vector<std::byte> bytes;
  [[nodiscard]] std::size_t rows() const { return offset.size() - 1; }
  void reorder(std::span<const std::uint32_t> order);  ///< as Table::reorder
};

}  // namespace decomp
