#include <gtest/gtest.h>

#include <tuple>

#include "decomp/migrate.hpp"
#include "decomp/test_particles.hpp"

namespace {

using namespace decomp_test;

/// Some rows have no payload; the bytes spell the id.
std::vector<std::byte> payload_of(Gid id) { return expected_value(id, 99, splitmix(id) % 23, 0); }

Payload make_payload(const Table& table) {
  Payload payload;
  for (std::size_t r = 0; r < table.owned(); ++r) {
    const std::vector<std::byte> bytes = payload_of(table.as<Gid>(0)[r]);
    payload.bytes.insert(payload.bytes.end(), bytes.begin(), bytes.end());
    payload.offset.push_back(payload.bytes.size());
  }
  return payload;
}

void expect_intact(const Table& table, const Payload& payload) {
  ASSERT_EQ(payload.rows(), table.owned());
  ASSERT_EQ(payload.offset.back(), payload.bytes.size());
  for (std::size_t r = 0; r < table.owned(); ++r) {
    const Gid id = table.as<Gid>(0)[r];
    EXPECT_EQ(wrong_value(table, r, id), "");
    const std::vector<std::byte> bytes(
        payload.bytes.begin() + static_cast<std::ptrdiff_t>(payload.offset[r]),
        payload.bytes.begin() + static_cast<std::ptrdiff_t>(payload.offset[r + 1]));
    EXPECT_EQ(bytes, payload_of(id)) << "payload of id " << id;
  }
}

/// All ids of the scene are somewhere, once each.
void expect_complete(const Comm& comm, const Table& table, std::uint64_t particles) {
  std::vector<std::int64_t> times(particles);
  for (std::size_t r = 0; r < table.owned(); ++r) ++times.at(table.as<Gid>(0)[r]);
  comm.sum(times);
  for (Gid id = 0; id < particles; ++id) EXPECT_EQ(times[id], 1) << "id " << id;
}

/// [2 id] and [2 id + 1]: rank and row of each particle before a move, which fix its place afterwards.
std::vector<std::int64_t> origins(const Comm& comm, const Table& table, std::uint64_t particles) {
  std::vector<std::int64_t> rank_and_row(2 * particles);
  for (std::size_t r = 0; r < table.owned(); ++r) {
    rank_and_row[2 * table.as<Gid>(0)[r]] = comm.rank();
    rank_and_row[2 * table.as<Gid>(0)[r] + 1] = static_cast<std::int64_t>(r);
  }
  comm.sum(rank_and_row);
  return rank_and_row;
}

void expect_order(const Comm& comm, const Table& table, const std::vector<std::int64_t>& origin) {
  std::tuple<bool, std::int64_t, std::int64_t> last{false, -1, -1};
  for (std::size_t r = 0; r < table.owned(); ++r) {
    const Gid id = table.as<Gid>(0)[r];
    const std::tuple now{origin[2 * id] != comm.rank(), origin[2 * id], origin[2 * id + 1]};
    EXPECT_LT(last, now) << "row " << r << ", id " << id;
    last = now;
  }
}

/// Moves the particles by up to `reach` on each axis; returns the owner of each row under `after`.
std::vector<Rank> drift(const Scene& scene, const JaggedPartition& after, std::int64_t reach,
                        std::uint64_t round, Table& table) {
  std::vector<Rank> owner(table.owned());
  for (std::size_t r = 0; r < table.owned(); ++r) {
    Int3 x = position_in(table, r, scene.dim);
    for (int a = 0; a < scene.dim; ++a) {
      const auto k = 100 * round + static_cast<std::uint64_t>(a);
      x[a] += draw(table.as<Gid>(0)[r], k, 2 * reach + 1) - reach;
    }
    x = after.grid().wrap(x);
    set_position(table, r, scene.dim, x);
    owner[r] = owner_of(after, x);
  }
  return owner;
}

bool has(const std::vector<Rank>& ranks, Rank r) { return std::binary_search(ranks.begin(), ranks.end(), r); }

TEST(MigrationPeers, agree_between_the_two_sides) {
  for (const Scene& scene : scenes())
    for (const int ranks : {1, 2, 3, 5, 7})
      for (std::uint64_t seed = 0; seed < 6; ++seed) {
        const JaggedPartition before = random_partition(scene, ranks, seed);
        const JaggedPartition after = random_partition(scene, ranks, seed + 50);
        std::vector<MigrationPeers> peers;
        for (Rank r = 0; r < ranks; ++r)
          peers.push_back(migration_peers(before, after, r, static_cast<std::int64_t>(seed) * 700));
        for (Rank a = 0; a < ranks; ++a) {
          EXPECT_FALSE(has(peers[static_cast<std::size_t>(a)].to, a));
          EXPECT_FALSE(has(peers[static_cast<std::size_t>(a)].from, a));
          for (Rank b = 0; b < ranks; ++b)
            EXPECT_EQ(has(peers[static_cast<std::size_t>(a)].to, b),
                      has(peers[static_cast<std::size_t>(b)].from, a))
                << scene.name << ": from " << a << " to " << b;
        }
      }
}

TEST(MigrationPeers, are_none_when_nothing_moves) {
  for (const Scene& scene : scenes()) {
    const JaggedPartition partition = random_partition(scene, 7, 4);
    for (Rank r = 0; r < 7; ++r) {
      const MigrationPeers peers = migration_peers(partition, partition, r, 0);
      EXPECT_TRUE(peers.to.empty() && peers.from.empty());
    }
  }
}

TEST(Migrate, permutes_rows_under_ever_new_cuts) {
  const Comm comm(MPI_COMM_WORLD);
  for (const Scene& scene : scenes())
    for (const std::int64_t reach : {std::int64_t{0}, Scene::edge / 2, 2 * Scene::edge}) {
      SCOPED_TRACE(scene.name + ", reach " + std::to_string(reach));
      JaggedPartition before = random_partition(scene, comm.size(), 11);
      Table table = fill_table(scene, before, comm.rank());
      Payload payload = make_payload(table);
      const Census start = census(comm, table, 0);
      EXPECT_EQ(start.count, static_cast<std::int64_t>(scene.particles));
      for (std::uint64_t round = 0; round < 6; ++round) {
        const JaggedPartition after = random_partition(scene, comm.size(), 13 * round + 1);
        const std::vector<Rank> owner = drift(scene, after, reach, round, table);
        const std::vector<std::int64_t> origin = origins(comm, table, scene.particles);
        table.resize(table.owned(), 17);
        const std::size_t sent =
            migrate(comm, owner, migration_peers(before, after, comm.rank(), reach), table, &payload);
        EXPECT_EQ(sent + static_cast<std::size_t>(std::count(owner.begin(), owner.end(), comm.rank())),
                  owner.size());
        EXPECT_EQ(table.halo(), 0U);
        for (std::size_t r = 0; r < table.owned(); ++r)
          EXPECT_EQ(owner_of(after, position_in(table, r, scene.dim)), comm.rank());
        expect_order(comm, table, origin);
        EXPECT_EQ(census(comm, table, 0), start);
        before = after;
      }
      expect_complete(comm, table, scene.particles);
      expect_intact(table, payload);
    }
}

TEST(Migrate, works_without_payload) {
  const Comm comm(MPI_COMM_WORLD);
  const Scene scene = scenes()[0];
  const JaggedPartition before = random_partition(scene, comm.size(), 1);
  const JaggedPartition after = random_partition(scene, comm.size(), 2);
  Table table = fill_table(scene, before, comm.rank());
  const std::vector<Rank> owner = drift(scene, after, 100, 0, table);
  migrate(comm, owner, migration_peers(before, after, comm.rank(), 100), table, nullptr);
  expect_complete(comm, table, scene.particles);
  for (std::size_t r = 0; r < table.owned(); ++r) EXPECT_EQ(wrong_value(table, r, table.as<Gid>(0)[r]), "");
}

TEST(Migrate, reports_an_owner_that_is_no_peer) {
  const Comm comm(MPI_COMM_WORLD);
  Table table = make_table(2);
  table.resize(2, 0);
  const std::vector<Rank> owner{comm.rank(), comm.rank() + 1};
  EXPECT_THROW(migrate(comm, owner, {}, table, nullptr), GuardError);
  EXPECT_EQ(table.owned(), 2U);
  EXPECT_THROW(redistribute(comm, std::vector<Rank>{0, comm.size()}, table, nullptr), GuardError);
  EXPECT_THROW(migrate(comm, std::vector<Rank>{}, {}, table, nullptr), std::logic_error);
}

TEST(Redistribute, sends_any_row_anywhere) {
  const Comm comm(MPI_COMM_WORLD);
  const Scene scene = scenes()[5];
  Table table = fill_table(scene, random_partition(scene, comm.size(), 8), comm.rank());
  Payload payload = make_payload(table);
  for (std::uint64_t round = 0; round < 6; ++round) {
    std::vector<Rank> owner(table.owned());
    for (std::size_t r = 0; r < owner.size(); ++r) {
      const bool all_to_last = round == 3;
      owner[r] = all_to_last ? comm.size() - 1
                             : static_cast<Rank>(draw(table.as<Gid>(0)[r], 500 + round, comm.size()));
    }
    const std::vector<std::int64_t> origin = origins(comm, table, scene.particles);
    redistribute(comm, owner, table, &payload);
    expect_order(comm, table, origin);
    expect_complete(comm, table, scene.particles);
    expect_intact(table, payload);
    if (round == 3) {
      EXPECT_EQ(table.owned(), comm.rank() == comm.size() - 1 ? scene.particles : 0U);
    }
  }
}

TEST(Census, needs_an_id_column) {
  const Comm comm(MPI_COMM_WORLD);
  EXPECT_THROW((void)census(comm, make_table(2), 1), std::logic_error);
}

}  // namespace
