// The second part of writing a laid-out HDF5 file: rows from all ranks, then everything on disk.
#pragma once

#include <filesystem>

#include "output/durable_file.hpp"
#include "output/hdf5_file.hpp"
#include "run/agree.hpp"

namespace sph {

/// Opens `path` on the ranks of `writers`, lets `work(file)` write this rank's rows, closes and waits for the
/// disk. Several groups of writers may fill in a file each: all ranks of `everyone` succeed or all throw
/// OutputError("<what>: <reason>"). Collective over everyone; `work` must not communicate.
template <class Work>
void fill_in(const decomp::Comm& everyone, const decomp::Comm& writers, const std::filesystem::path& path,
             const std::string& what, Work&& work) {
  // The collective open below must not fail on some ranks only, as it does where a node cannot see the file.
  all_or_none(everyone, what, [&] { check_writable(path); });
  all_or_none(everyone, what, [&] {
    SharedHdf5File file(path, writers.get());
    const std::string failure = attempt([&] { work(file); });
    file.close();  // collective: also by a rank that could not write
    if (!failure.empty()) throw OutputError(failure);
    sync_to_disk(path);
  });
}

}  // namespace sph
