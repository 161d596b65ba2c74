// Bytes that all ranks read and none changes: one copy on each machine, however many ranks it runs.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>

#include "decomp/comm.hpp"

namespace decomp {

struct MachineCopy {
  std::shared_ptr<const std::byte> bytes;  ///< on a cache line
  std::size_t size = 0;
  std::string problem;  ///< why each rank of this machine has a copy of its own; empty if none has
};

/// Of what rank 0 gives. Collective.
[[nodiscard]] MachineCopy copy_to_machines(const Comm& comm, std::shared_ptr<const std::byte> bytes,
                                           std::size_t size);

}  // namespace decomp
