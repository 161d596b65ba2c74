// Moves rows, all their columns and their payload to new owners. Nothing is lost or duplicated: count and
// xor of the ids are conserved. Moving needs no collective, so the check is the caller's: compare `census`
// with the one known since the start.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "decomp/comm.hpp"
#include "decomp/partition.hpp"
#include "decomp/table.hpp"

namespace decomp {

struct MigrationPeers {
  std::vector<Rank> to;    ///< ranks that may get rows of mine; ascending, without this rank
  std::vector<Rank> from;  ///< ranks whose rows I may get; likewise
};

/// Peers for a move from `before` to `after` when no particle is further than `reach` quanta outside the
/// box it was in: from the replicated cuts alone, the same on both sides, without communication.
[[nodiscard]] MigrationPeers migration_peers(const JaggedPartition& before, const JaggedPartition& after,
                                             Rank me, std::int64_t reach);

/// Sends owned row r to rank owner[r]; halo rows are dropped first. Rows that stay keep their order and come
/// first, then those from `from` in ascending rank, each in its sender's order. `payload` may be null.
/// Returns the number of rows this rank sent away. Throws GuardError, before any message, if an owner is not
/// among peers.to; the other ranks then wait for this one, so the program must end.
std::size_t migrate(const Comm& comm, std::span<const Rank> owner, const MigrationPeers& peers, Table& table,
                    Payload* payload);

/// The same with any owner allowed: for set-up, resume and sorted output, where an all-to-all is fine.
std::size_t redistribute(const Comm& comm, std::span<const Rank> owner, Table& table, Payload* payload);

/// Count and xor of the 8-byte ids in column `id`, over all ranks.
struct Census {
  std::int64_t count = 0;
  std::uint64_t xor_of_ids = 0;
  friend bool operator==(const Census&, const Census&) = default;
};
[[nodiscard]] Census census(const Comm& comm, const Table& table, int id);

}  // namespace decomp
