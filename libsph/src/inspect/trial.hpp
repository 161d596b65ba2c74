// Trying something in a process of its own first: HDF5 may loop or crash on a damaged file.
#pragma once

#include <functional>
#include <string>

namespace sph {

/// Does `work` in a copy of this process. Returns what became of the copy, empty if it came to an end, be it
/// by an exception: then the same is to be expected here. It may use so many seconds of processor time,
/// however long it waits for the disk. Not for a run, whose network may dislike copies.
[[nodiscard]] std::string fate_in_a_copy(const std::function<void()>& work, int seconds = 5);

}  // namespace sph
