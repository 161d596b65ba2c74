#include "decomp/table.hpp"

#include <algorithm>
#include <cstring>
#include <map>
#include <stdexcept>

#include "decomp/memory.hpp"
#include "decomp/poison.hpp"
#include "row_copy.hpp"

namespace decomp {
namespace {

constexpr std::size_t padding = 4096;

}  // namespace

void Column::Free::operator()(std::byte* p) const noexcept { release_large(p); }

void Column::reserve(std::size_t rows) {
  if (data_ && rows <= capacity_) return;
  const std::size_t capacity = std::max(rows, capacity_ + capacity_ / 8);
  const std::size_t bytes = capacity * width_ + padding;
  std::unique_ptr<std::byte[], Free> grown(static_cast<std::byte*>(allocate_large(bytes)));
  const std::size_t old = kept() ? capacity_ * width_ : 0;
  if (old > 0) std::memcpy(grown.get(), data_.get(), old);
  // Lanes past the last row are computed and thrown away: zeros keep them from raising traps.
  if (kept()) std::memset(grown.get() + old, 0, bytes - old);
  poison(grown.get() + old, bytes - old);
  data_ = std::move(grown);
  capacity_ = capacity;
}

void Column::swap_data(Column& other) noexcept {
  std::swap(data_, other.data_);
  std::swap(capacity_, other.capacity_);
}

int Table::add_column(std::string name, std::size_t width, Values values) {
  if (rows() != 0) throw std::logic_error("column '" + name + "' added to a table that has rows");
  if (width == 0) throw std::logic_error("column '" + name + "' has no width");
  columns_.emplace_back(std::move(name), width, values);
  columns_.back().reserve(0);
  return columns() - 1;
}

std::size_t Table::kept_bytes() const {
  std::size_t sum = 0;
  for (const Column& c : columns_) sum += c.kept() ? c.width() : 0;
  return sum;
}

void Table::resize(std::size_t owned, std::size_t halo) {
  for (Column& c : columns_) c.reserve(owned + halo);
  if (poisons() && owned + halo > rows())
    for (Column& c : columns_) poison(c.data() + rows() * c.width(), (owned + halo - rows()) * c.width());
  owned_ = owned;
  halo_ = halo;
}

void Table::reorder(std::span<const std::uint32_t> order) {
  std::map<std::size_t, Column> spare;  // one of each width
  for (Column& c : columns_) {
    const std::size_t width = c.width();
    if (!c.kept()) {
      poison(c.data(), order.size() * width);
      continue;
    }
    Column& to = spare.try_emplace(width, "spare", width).first->second;
    to.reserve(order.size() + halo_);  // or the next resize would take the column twice for a while
    gather_rows(to.data(), c.data(), order, width);
    c.swap_data(to);
  }
  owned_ = order.size();
  halo_ = 0;
}

void Payload::reorder(std::span<const std::uint32_t> order) {
  Payload sorted;
  sorted.offset.reserve(order.size() + 1);
  for (const std::uint32_t r : order)
    sorted.offset.push_back(sorted.offset.back() + offset[r + 1] - offset[r]);
  sorted.bytes.resize(sorted.offset.back());
  for (std::size_t k = 0; k < order.size(); ++k)
    std::copy(bytes.begin() + static_cast<std::ptrdiff_t>(offset[order[k]]),
              bytes.begin() + static_cast<std::ptrdiff_t>(offset[order[k] + 1]),
              sorted.bytes.begin() + static_cast<std::ptrdiff_t>(sorted.offset[k]));
  *this = std::move(sorted);
}

}  // namespace decomp
