#include "row_message.hpp"

#include <cstring>
#include <stdexcept>

#include "row_copy.hpp"

namespace decomp {

std::vector<std::byte> pack_rows(const Table& table, const Payload* payload,
                                 std::span<const std::uint32_t> rows) {
  std::size_t bytes = sizeof(RowMessageHead) + rows.size() * table.kept_bytes();
  if (payload != nullptr) {
    bytes += rows.size() * sizeof(std::uint64_t);
    for (const std::uint32_t r : rows) bytes += payload->offset[r + 1] - payload->offset[r];
  }
  std::vector<std::byte> message(bytes);
  std::byte* to = message.data();
  const auto put = [&](const void* from, std::size_t n) {
    if (n > 0) std::memcpy(to, from, n);
    to += n;
  };

  const RowMessageHead head{bytes, rows.size()};
  put(&head, sizeof head);
  for (int c = 0; c < table.columns(); ++c) {
    if (!table.column(c).kept()) continue;
    const std::size_t width = table.column(c).width();
    gather_rows(to, table.column(c).data(), rows, width);
    to += rows.size() * width;
  }
  if (payload != nullptr) {
    for (const std::uint32_t r : rows) {
      const std::uint64_t length = payload->offset[r + 1] - payload->offset[r];
      put(&length, sizeof length);
    }
    for (const std::uint32_t r : rows)
      put(payload->bytes.data() + payload->offset[r], payload->offset[r + 1] - payload->offset[r]);
  }
  return message;
}

RowMessageHead head_of(std::span<const std::byte> message) {
  RowMessageHead head{};
  if (message.size() < sizeof head) throw std::runtime_error("message of rows is cut short");
  std::memcpy(&head, message.data(), sizeof head);
  return head;
}

void append_rows(std::span<const std::vector<std::byte>> messages, Table& table, Payload* payload) {
  std::size_t row = table.owned(), rows = row, payload_bytes = 0;
  for (const auto& m : messages) {
    const std::size_t n = head_of(m).rows;
    rows += n;
    if (payload != nullptr)
      payload_bytes += m.size() - sizeof(RowMessageHead) - n * (table.kept_bytes() + sizeof(std::uint64_t));
  }
  table.resize(rows, 0);
  if (payload != nullptr) {
    payload->offset.reserve(rows + 1);
    payload->bytes.reserve(payload->bytes.size() + payload_bytes);
  }

  for (const auto& m : messages) {
    const std::size_t n = head_of(m).rows;
    const std::byte* from = m.data() + sizeof(RowMessageHead);
    for (int c = 0; c < table.columns(); ++c) {
      if (!table.column(c).kept()) continue;
      const std::size_t width = table.column(c).width();
      if (n > 0) std::memcpy(table.column(c).data() + row * width, from, n * width);
      from += n * width;
    }
    row += n;
    if (payload == nullptr) continue;
    for (std::size_t k = 0; k < n; ++k, from += sizeof(std::uint64_t)) {
      std::uint64_t length = 0;
      std::memcpy(&length, from, sizeof length);
      payload->offset.push_back(payload->offset.back() + length);
    }
    payload->bytes.insert(payload->bytes.end(), from, m.data() + m.size());
  }
}

}  // namespace decomp
