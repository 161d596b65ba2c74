// Rows of an HDF5 file, compressed. A data set is cut into chunks of so many rows, which HDF5 would put through its
// filters "shuffle" (all first bytes of the numbers, all second ones, ...) and "deflate"; here each rank does it
// for the chunks that it has, before the file is laid out with their sizes. A chunk holds the same rows on
// any number of ranks, so the bytes of the file do not depend on it.
#pragma once

#include <vector>

#include "decomp/comm.hpp"
#include "files/hdf5_file.hpp"

namespace sph {

/// Rows of a chunk: 128 kB of numbers, which HDF5's readers keep in their cache, too.
inline constexpr std::uint64_t chunk_rows = std::uint64_t{1} << 14;

class PackedRows : public RowSink {
 public:
  /// For `sets`, of which those with any rows are to be compressed; they must outlive this.
  PackedRows(std::vector<DataSet>& sets, int level);
  /// Whole chunks, but for the end of the data set.
  void write(std::size_t set, std::uint64_t first, std::uint64_t rows, const void* values) override;
  /// Tells all ranks how long the chunks of all are, in `sets`: the file can be laid out. Collective.
  void agree_on_sizes(const decomp::Comm& comm);
  void fill(RowFile& file) const;

 private:
  struct Chunk {
    std::size_t set, number;
    std::vector<std::byte> bytes;
  };
  std::vector<DataSet>& sets_;
  int level_;
  std::vector<Chunk> chunks_;
};

}  // namespace sph
