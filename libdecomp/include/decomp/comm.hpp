// A duplicated MPI communicator that frees itself, and the few collectives the library needs.
// Floating-point sums are not offered: they would depend on the number of ranks (use ExactSum).
#pragma once

#include <mpi.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "decomp/types.hpp"

namespace decomp {

class Comm {
 public:
  explicit Comm(MPI_Comm parent);  ///< duplicates `parent`; errors become exceptions that name the call
  ~Comm();
  Comm(const Comm&) = delete;
  Comm& operator=(const Comm&) = delete;

  [[nodiscard]] Rank rank() const { return rank_; }
  [[nodiscard]] int size() const { return size_; }
  [[nodiscard]] MPI_Comm get() const { return comm_; }

  /// In place, all ranks get the result. The double form is min/max only: exact in any order.
  void max(std::span<double> values) const;
  void min(std::span<double> values) const;
  void max(std::span<std::int64_t> values) const;
  void sum(std::span<std::int64_t> values) const;
  void sum(std::span<std::uint64_t> values) const;  ///< modulo 2^64
  void bit_xor(std::span<std::uint64_t> values) const;
  [[nodiscard]] std::int64_t max(std::int64_t value) const;
  [[nodiscard]] std::int64_t sum(std::int64_t value) const;
  [[nodiscard]] std::int64_t exclusive_sum(std::int64_t value) const;  ///< sum over lower ranks; 0 on rank 0

  void broadcast(std::span<std::byte> bytes, Rank root) const;
  [[nodiscard]] std::string broadcast(const std::string& text, Rank root) const;
  [[nodiscard]] std::vector<double> all_gather(double value) const;  ///< [size], by rank
  [[nodiscard]] std::vector<std::int64_t> all_gather(std::int64_t value) const;
  [[nodiscard]] std::vector<std::byte> gather(std::span<const std::byte> bytes,
                                              Rank root) const;  ///< concatenated by rank; empty elsewhere
  void barrier() const;

 private:
  MPI_Comm comm_ = MPI_COMM_NULL;
  Rank rank_ = 0;
  int size_ = 1;
};

/// Of all ranks, concatenated by rank, on each. For little: every rank holds all of it.
[[nodiscard]] std::vector<std::byte> gather_everywhere(const Comm& comm, std::span<const std::byte> bytes);

/// Throws std::runtime_error naming `call` and MPI's message unless `code` is MPI_SUCCESS.
void check_mpi(int code, const char* call);

}  // namespace decomp
