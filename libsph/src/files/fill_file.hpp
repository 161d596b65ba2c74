// The second part of writing a laid-out HDF5 file: rows from all ranks, then everything on disk.
#pragma once

#include <filesystem>
#include <vector>

#include "files/agree.hpp"
#include "files/hdf5_file.hpp"

namespace sph {

/// Lets `work(file)` write this rank's rows into `path` on the ranks of `writers`, and waits for the disk.
/// `extents`, on rank 0 of the writers, is what lay_out() has returned there. Several groups of writers may
/// fill in a file each: all ranks of `everyone` succeed or all throw OutputError("<what>: <reason>").
/// Collective over everyone; `work` must not communicate.
template <class Work>
void fill_in(const decomp::Comm& everyone, const decomp::Comm& writers, const std::filesystem::path& path,
             const std::vector<DataSet>& sets, std::vector<Extent> extents, const std::string& what,
             Work&& work) {
  std::size_t count = 0;
  for (const DataSet& set : sets) count += set.extents();
  extents.resize(count);
  writers.broadcast(std::as_writable_bytes(std::span(extents)), 0);
  all_or_none(everyone, what, [&] {
    RowFile file(path, sets, extents);
    work(file);
    file.finish();
  });
}

}  // namespace sph
