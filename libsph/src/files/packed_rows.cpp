#include "files/packed_rows.hpp"

#include <zlib.h>

#include <algorithm>
#include <numeric>
#include <stdexcept>

namespace sph {
namespace {

std::vector<std::byte> shuffled(std::span<const std::byte> from, std::size_t element) {
  const std::size_t count = from.size() / element;
  std::vector<std::byte> to(from.size());
  for (std::size_t k = 0; k < count; ++k)
    for (std::size_t b = 0; b < element; ++b) to[b * count + k] = from[k * element + b];
  return to;
}

std::vector<std::byte> deflated(const std::vector<std::byte>& from, int level) {
  uLongf size = compressBound(from.size());
  std::vector<std::byte> to(size);
  const int status = compress2(reinterpret_cast<Bytef*>(to.data()), &size,
                               reinterpret_cast<const Bytef*>(from.data()), from.size(), level);
  if (status != Z_OK) throw std::runtime_error(std::string("zlib: ") + zError(status));
  return {to.begin(), to.begin() + static_cast<std::ptrdiff_t>(size)};
}

}  // namespace

PackedRows::PackedRows(std::vector<DataSet>& sets, int level) : sets_(sets), level_(level) {
  for (DataSet& set : sets_) {
    if (set.rows == 0) continue;
    set.chunks = {std::min(set.rows, chunk_rows), level, {}};
    set.chunks.bytes.resize((set.rows + set.chunks.rows - 1) / set.chunks.rows);
  }
}

void PackedRows::write(std::size_t set, std::uint64_t first, std::uint64_t rows, const void* values) {
  if (rows == 0) return;
  const DataSet& s = sets_[set];
  const std::uint64_t n = s.chunks.rows, end = first + rows;
  if (first % n != 0 || (end % n != 0 && end != s.rows))
    throw std::logic_error("rows of " + s.name + " are no whole chunks");
  const std::size_t row_bytes = static_cast<std::size_t>(s.components) * bytes(s.element);
  const auto* from = static_cast<const std::byte*>(values);
  for (; first < end; first += n) {
    const std::size_t size = std::min(n, end - first) * row_bytes;
    std::vector<std::byte> whole(from, from + size);
    whole.resize(n * row_bytes);
    chunks_.push_back({set, first / n, deflated(shuffled(whole, bytes(s.element)), level_)});
    from += size;
  }
}

void PackedRows::agree_on_sizes(const decomp::Comm& comm) {
  for (const Chunk& chunk : chunks_) sets_[chunk.set].chunks.bytes[chunk.number] = chunk.bytes.size();
  for (DataSet& set : sets_) comm.sum(std::span<std::uint64_t>(set.chunks.bytes));
}

void PackedRows::fill(RowFile& file) const {
  std::vector<std::size_t> before{0};
  for (const DataSet& set : sets_) before.push_back(before.back() + set.extents());
  for (const Chunk& chunk : chunks_) file.fill(before[chunk.set] + chunk.number, chunk.bytes);
}

}  // namespace sph
