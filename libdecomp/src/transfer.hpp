// Point-to-point transfers of any length. MPI counts are ints, so a longer transfer goes out as several
// messages with one tag: MPI keeps messages between two ranks in order, which puts the pieces together.
#pragma once

#include <mpi.h>

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include "decomp/comm.hpp"

namespace decomp {

inline constexpr std::size_t max_message_bytes = std::size_t{1} << 30;

/// Calls work(first, count) for consecutive pieces of at most `longest` items; never for `items` = 0.
template <class Work>
void for_each_chunk(std::size_t items, std::size_t longest, Work&& work) {
  for (std::size_t first = 0; first < items; first += longest)
    work(first, static_cast<int>(std::min(longest, items - first)));
}

/// Appends to `requests` the messages that carry `bytes`: none if it is empty.
inline void start_send(const Comm& comm, std::span<const std::byte> bytes, Rank to, int tag,
                       std::vector<MPI_Request>& requests) {
  for_each_chunk(bytes.size(), max_message_bytes, [&](std::size_t first, int count) {
    MPI_Request& request = requests.emplace_back(MPI_REQUEST_NULL);
    check_mpi(MPI_Isend(bytes.data() + first, count, MPI_BYTE, to, tag, comm.get(), &request), "MPI_Isend");
  });
}

inline void start_receive(const Comm& comm, std::span<std::byte> bytes, Rank from, int tag,
                          std::vector<MPI_Request>& requests) {
  for_each_chunk(bytes.size(), max_message_bytes, [&](std::size_t first, int count) {
    MPI_Request& request = requests.emplace_back(MPI_REQUEST_NULL);
    check_mpi(MPI_Irecv(bytes.data() + first, count, MPI_BYTE, from, tag, comm.get(), &request), "MPI_Irecv");
  });
}

/// Waits for all and empties the list (its memory stays).
inline void wait_all(std::vector<MPI_Request>& requests) {
  check_mpi(MPI_Waitall(static_cast<int>(requests.size()), requests.data(), MPI_STATUSES_IGNORE),
            "MPI_Waitall");
  requests.clear();
}

}  // namespace decomp
