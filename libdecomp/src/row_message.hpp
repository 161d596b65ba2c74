// A set of rows as one block of bytes: number of bytes, number of rows, the columns one after another, then
// (where a payload travels) the payload's length for each row and its bytes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "decomp/table.hpp"

namespace decomp {

struct RowMessageHead {
  std::uint64_t bytes;  ///< of the whole message, this head included
  std::uint64_t rows;
};

[[nodiscard]] std::vector<std::byte> pack_rows(const Table& table, const Payload* payload,
                                               std::span<const std::uint32_t> rows);
[[nodiscard]] RowMessageHead head_of(std::span<const std::byte> message);

/// Appends the rows of all messages, in order, to the owned rows of a table without halo.
void append_rows(std::span<const std::vector<std::byte>> messages, Table& table, Payload* payload);

}  // namespace decomp
