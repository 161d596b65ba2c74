#include "decomp/migrate.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>
#include <stdexcept>

#include "row_message.hpp"
#include "transfer.hpp"

namespace decomp {
namespace {

constexpr int migrate_tag = 301;
constexpr int redistribute_tag = 302;

using Rows = std::vector<std::uint32_t>;
using Message = std::vector<std::byte>;

std::vector<Rank> others_touching(const JaggedPartition& partition, Box box, Rank me, std::int64_t reach) {
  for (int a = 0; a < max_axes; ++a) {
    box.lo[a] -= reach;
    box.hi[a] += reach;
  }
  std::vector<Rank> ranks = partition.ranks_touching(box);
  std::erase(ranks, me);
  return ranks;
}

struct Leaving {
  Rows stay;
  std::vector<Rows> rows;  ///< for each entry of the list of destinations
  [[nodiscard]] std::size_t count() const {
    return std::accumulate(rows.begin(), rows.end(), std::size_t{0},
                           [](std::size_t sum, const Rows& r) { return sum + r.size(); });
  }
};

/// Rows by destination; `to` is ascending and lacks `me`. Throws GuardError if an owner is not in it.
Leaving sort_by_owner(std::span<const Rank> owner, std::span<const Rank> to, Rank me) {
  Leaving leaving{{}, std::vector<Rows>(to.size())};
  for (std::size_t r = 0; r < owner.size(); ++r) {
    const auto row = static_cast<std::uint32_t>(r);
    if (owner[r] == me) {
      leaving.stay.push_back(row);
      continue;
    }
    const auto at = std::lower_bound(to.begin(), to.end(), owner[r]);
    if (at == to.end() || *at != owner[r])
      throw GuardError("row " + std::to_string(r) + " of rank " + std::to_string(me) + " belongs to rank " +
                       std::to_string(owner[r]) + ", which is not among the " + std::to_string(to.size()) +
                       " ranks it may move to");
    leaving.rows[static_cast<std::size_t>(at - to.begin())].push_back(row);
  }
  return leaving;
}

void check_arguments(std::span<const Rank> owner, const Table& table, const Payload* payload) {
  if (owner.size() != table.owned()) throw std::logic_error("migration needs one owner for each owned row");
  if (owner.size() > std::numeric_limits<std::uint32_t>::max())
    throw GuardError("more than 2^32 rows on one rank");
  if (payload != nullptr && payload->rows() != table.owned())
    throw std::logic_error("the payload's rows are not the table's");
}

void keep_only(const Rows& stay, Table& table, Payload* payload) {
  if (stay.size() == table.owned()) {
    table.resize(stay.size(), 0);
    return;
  }
  table.reorder(stay);
  if (payload != nullptr) payload->reorder(stay);
}

/// The first piece says how long the whole is.
Message receive_unknown(const Comm& comm, Rank from, int tag) {
  MPI_Message handle = MPI_MESSAGE_NULL;
  MPI_Status status;
  check_mpi(MPI_Mprobe(from, tag, comm.get(), &handle, &status), "MPI_Mprobe");
  int count = 0;
  check_mpi(MPI_Get_count(&status, MPI_BYTE, &count), "MPI_Get_count");
  const auto first = static_cast<std::size_t>(count);
  Message message(first);
  check_mpi(MPI_Mrecv(message.data(), count, MPI_BYTE, &handle, &status), "MPI_Mrecv");
  message.resize(head_of(message).bytes);
  std::vector<MPI_Request> rest;
  start_receive(comm, std::span(message).subspan(first), from, tag, rest);
  wait_all(rest);
  return message;
}

}  // namespace

MigrationPeers migration_peers(const JaggedPartition& before, const JaggedPartition& after, Rank me,
                               std::int64_t reach) {
  // Growing one box or the other is the same condition, which makes the two lists agree between ranks.
  return {.to = others_touching(after, before.quanta(me), me, reach),
          .from = others_touching(before, after.quanta(me), me, reach)};
}

std::size_t migrate(const Comm& comm, std::span<const Rank> owner, const MigrationPeers& peers, Table& table,
                    Payload* payload) {
  check_arguments(owner, table, payload);
  const Leaving leaving = sort_by_owner(owner, peers.to, comm.rank());

  std::vector<MPI_Request> sends;
  std::vector<Message> out, in;
  for (std::size_t p = 0; p < peers.to.size(); ++p) {
    out.push_back(pack_rows(table, payload, leaving.rows[p]));
    start_send(comm, out.back(), peers.to[p], migrate_tag, sends);
  }
  keep_only(leaving.stay, table, payload);
  for (const Rank from : peers.from) in.push_back(receive_unknown(comm, from, migrate_tag));
  append_rows(in, table, payload);
  wait_all(sends);
  return leaving.count();
}

std::size_t redistribute(const Comm& comm, std::span<const Rank> owner, Table& table, Payload* payload) {
  check_arguments(owner, table, payload);
  std::vector<Rank> to(static_cast<std::size_t>(comm.size()));
  std::iota(to.begin(), to.end(), 0);
  std::erase(to, comm.rank());
  const Leaving leaving = sort_by_owner(owner, to, comm.rank());

  std::vector<Message> out;
  std::vector<std::uint64_t> out_bytes(static_cast<std::size_t>(comm.size())), in_bytes(out_bytes.size());
  for (std::size_t p = 0; p < to.size(); ++p) {
    out.push_back(leaving.rows[p].empty() ? Message{} : pack_rows(table, payload, leaving.rows[p]));
    out_bytes[static_cast<std::size_t>(to[p])] = out.back().size();
  }
  keep_only(leaving.stay, table, payload);
  check_mpi(MPI_Alltoall(out_bytes.data(), 1, MPI_UINT64_T, in_bytes.data(), 1, MPI_UINT64_T, comm.get()),
            "MPI_Alltoall");

  std::vector<MPI_Request> requests;
  std::vector<Message> in;
  in.reserve(to.size());  // the receives point into its elements
  for (Rank from = 0; from < comm.size(); ++from)
    if (const std::uint64_t bytes = in_bytes[static_cast<std::size_t>(from)]; bytes > 0)
      start_receive(comm, in.emplace_back(bytes), from, redistribute_tag, requests);
  for (std::size_t p = 0; p < to.size(); ++p) start_send(comm, out[p], to[p], redistribute_tag, requests);
  wait_all(requests);
  append_rows(in, table, payload);
  return leaving.count();
}

Census census(const Comm& comm, const Table& table, int id) {
  if (table.column(id).width() != sizeof(Gid))
    throw std::logic_error("column '" + table.column(id).name() + "' does not hold ids");
  const Gid* ids = table.as<Gid>(id);
  std::array<std::uint64_t, 1> bits{};
  for (std::size_t r = 0; r < table.owned(); ++r) bits[0] ^= ids[r];
  comm.bit_xor(bits);
  return {.count = comm.sum(static_cast<std::int64_t>(table.owned())), .xor_of_ids = bits[0]};
}

}  // namespace decomp
