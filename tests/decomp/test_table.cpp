#include <gtest/gtest.h>

#include <algorithm>

#include "decomp/poison.hpp"
#include "decomp/test_particles.hpp"

namespace {

using namespace decomp_test;

bool aligned(const std::byte* p) { return reinterpret_cast<std::uintptr_t>(p) % 64 == 0; }

Table numbered_table(std::size_t rows) {
  Table table = make_table(3);
  table.resize(rows, 0);
  for (std::size_t r = 0; r < rows; ++r) {
    table.as<Gid>(0)[r] = r;
    set_position(table, r, 3, {static_cast<std::int64_t>(r), -1, 5});
    write_values(table, r, r);
  }
  return table;
}

void expect_rows(const Table& table, std::span<const std::uint32_t> ids) {
  ASSERT_EQ(table.owned(), ids.size());
  for (std::size_t r = 0; r < ids.size(); ++r) {
    EXPECT_EQ(table.as<Gid>(0)[r], ids[r]);
    EXPECT_EQ(position_in(table, r, 3), (Int3{ids[r], -1, 5}));
    EXPECT_EQ(wrong_value(table, r, ids[r]), "");
  }
}

TEST(Column, is_aligned_padded_and_zero_past_its_rows) {
  const std::byte fresh{decomp::poisons() ? std::uint8_t{0xFF} : std::uint8_t{0}};
  for (const std::size_t width : value_widths) {
    Column column("c", width);
    for (const std::size_t rows : {0, 1, 13, 1000}) {
      column.reserve(rows);
      ASSERT_NE(column.data(), nullptr);
      EXPECT_TRUE(aligned(column.data()));
      EXPECT_GE(column.capacity(), rows);
      const std::byte* unused = column.data() + rows * width;
      const std::byte* end = column.data() + column.capacity() * width + 4096;
      EXPECT_TRUE(std::all_of(unused, end, [&](std::byte b) { return b == fresh; }));
    }
  }
}

TEST(Column, grows_by_an_eighth_and_keeps_its_rows) {
  Column column("c", 8);
  column.reserve(100);
  for (std::size_t r = 0; r < 100; ++r) reinterpret_cast<std::uint64_t*>(column.data())[r] = r;
  column.reserve(101);
  EXPECT_EQ(column.capacity(), 112U);
  column.reserve(20);
  EXPECT_EQ(column.capacity(), 112U);
  for (std::size_t r = 0; r < 100; ++r) EXPECT_EQ(reinterpret_cast<std::uint64_t*>(column.data())[r], r);
}

TEST(Column, swaps_storage) {
  Column a("a", 1), b("b", 1);
  a.reserve(3);
  b.reserve(50);
  a.data()[0] = std::byte{7};
  const std::byte* of_a = a.data();
  a.swap_data(b);
  EXPECT_EQ(b.data(), of_a);
  EXPECT_EQ(b.data()[0], std::byte{7});
  EXPECT_EQ(a.capacity(), 50U);
  EXPECT_EQ(b.capacity(), 3U);
  EXPECT_EQ(a.name(), "a");
}

TEST(Table, knows_its_shape) {
  Table table = make_table(2);
  EXPECT_EQ(table.columns(), 3 + static_cast<int>(value_widths.size()));
  EXPECT_EQ(table.kept_bytes(), 8U + 16U + 1 + 4 + 5 + 8 + 12 + 16 + 24 + 32 + 48);
  EXPECT_EQ(table.rows(), 0U);
  table.resize(5, 3);
  EXPECT_EQ(table.owned(), 5U);
  EXPECT_EQ(table.halo(), 3U);
  EXPECT_EQ(table.rows(), 8U);
  EXPECT_THROW(table.add_column("late", 8), std::logic_error);
}

TEST(Table, resize_keeps_rows) {
  Table table = numbered_table(40);
  table.resize(40, 1000);
  table.resize(30, 0);
  std::vector<std::uint32_t> ids(30);
  std::iota(ids.begin(), ids.end(), 0U);
  expect_rows(table, ids);
}

TEST(Table, reorder_moves_every_column_and_may_drop_rows) {
  Table table = numbered_table(97);
  table.resize(97, 11);
  std::vector<std::uint32_t> ids(97);
  std::iota(ids.begin(), ids.end(), 0U);
  for (std::uint64_t round = 0; round < 10; ++round) {
    std::vector<std::uint32_t> order(ids.size());
    std::iota(order.begin(), order.end(), 0U);
    std::sort(order.begin(), order.end(),
              [&](auto a, auto b) { return splitmix(a + 1000 * round) < splitmix(b + 1000 * round); });
    order.resize(order.size() - std::min<std::size_t>(order.size(), 9));
    std::vector<std::uint32_t> moved;
    for (const std::uint32_t r : order) moved.push_back(ids[r]);
    table.reorder(order);
    EXPECT_EQ(table.halo(), 0U);
    expect_rows(table, moved);
    ids = moved;
  }
}

TEST(Table, what_passes_stays_where_rows_move) {
  Table table;
  table.add_column("id", sizeof(Gid));
  table.add_column("sum", sizeof(Gid), decomp::Values::passing);
  table.resize(100, 0);
  EXPECT_EQ(table.kept_bytes(), sizeof(Gid));
  for (std::size_t r = 0; r < 100; ++r) table.as<Gid>(0)[r] = table.as<Gid>(1)[r] = r;
  std::vector<std::uint32_t> order(100);
  std::iota(order.rbegin(), order.rend(), 0U);
  table.reorder(order);
  for (std::size_t r = 0; r < 100; ++r) {
    EXPECT_EQ(table.as<Gid>(0)[r], 99 - r);
    EXPECT_EQ(table.as<Gid>(1)[r], decomp::poisons() ? ~Gid{0} : r);
  }
}

TEST(Table, reorder_keeps_room_for_the_halo_and_no_more) {
  Table table = numbered_table(200);
  table.resize(200, 30);
  const std::size_t room = table.column(0).capacity();
  std::vector<std::uint32_t> order(200);
  std::iota(order.rbegin(), order.rend(), 0U);
  for (int round = 0; round < 20; ++round) {
    table.reorder(order);
    for (int c = 0; c < table.columns(); ++c) {
      EXPECT_GE(table.column(c).capacity(), 230U);
      EXPECT_LE(table.column(c).capacity(), room);
    }
    table.resize(200, 30);
  }
}

TEST(Payload, reorder_moves_bytes_with_their_rows) {
  Payload payload;
  for (std::size_t r = 0; r < 6; ++r) {
    payload.bytes.insert(payload.bytes.end(), r % 4, static_cast<std::byte>(r));
    payload.offset.push_back(payload.bytes.size());
  }
  payload.reorder(std::vector<std::uint32_t>{5, 0, 3, 2});
  EXPECT_EQ(payload.rows(), 4U);
  EXPECT_EQ(payload.offset, (std::vector<std::uint64_t>{0, 1, 1, 4, 6}));
  const std::byte b5{5}, b3{3}, b2{2};
  EXPECT_EQ(payload.bytes, (std::vector<std::byte>{b5, b3, b3, b3, b2, b2}));
  payload.reorder({});
  EXPECT_EQ(payload.rows(), 0U);
  EXPECT_TRUE(payload.bytes.empty());
}

}  // namespace
