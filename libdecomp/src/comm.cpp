#include "decomp/comm.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <stdexcept>

#include "ordered_key.hpp"
#include "transfer.hpp"

namespace decomp {
namespace {

constexpr int gather_tag = 101;

template <class T>
void all_reduce(std::span<T> values, MPI_Datatype type, MPI_Op op, MPI_Comm comm) {
  for_each_chunk(values.size(), max_message_bytes / sizeof(T), [&](std::size_t first, int count) {
    check_mpi(MPI_Allreduce(MPI_IN_PLACE, values.data() + first, count, type, op, comm), "MPI_Allreduce");
  });
}

void extremum(std::span<double> values, std::int64_t key_of_nan, MPI_Op op, MPI_Comm comm) {
  std::vector<std::int64_t> keys(values.size());
  std::transform(values.begin(), values.end(), keys.begin(),
                 [&](double x) { return std::isnan(x) ? key_of_nan : ordered_key(x); });
  all_reduce(std::span(keys), MPI_INT64_T, op, comm);
  std::transform(keys.begin(), keys.end(), values.begin(), from_ordered_key);
}

}  // namespace

void check_mpi(int code, const char* call) {
  if (code == MPI_SUCCESS) return;
  std::array<char, MPI_MAX_ERROR_STRING> text{};
  int length = 0;
  if (MPI_Error_string(code, text.data(), &length) != MPI_SUCCESS) length = 0;
  throw std::runtime_error(std::string(call) + ": " +
                           (length > 0 ? std::string(text.data(), static_cast<std::size_t>(length))
                                       : "MPI error " + std::to_string(code)));
}

Comm::Comm(MPI_Comm parent) {
  check_mpi(MPI_Comm_dup(parent, &comm_), "MPI_Comm_dup");
  check_mpi(MPI_Comm_set_errhandler(comm_, MPI_ERRORS_RETURN), "MPI_Comm_set_errhandler");
  check_mpi(MPI_Comm_rank(comm_, &rank_), "MPI_Comm_rank");
  check_mpi(MPI_Comm_size(comm_, &size_), "MPI_Comm_size");
}

Comm::~Comm() {
  int finalized = 0;
  if (MPI_Finalized(&finalized) == MPI_SUCCESS && finalized == 0) MPI_Comm_free(&comm_);
}

void Comm::max(std::span<double> values) const {
  extremum(values, std::numeric_limits<std::int64_t>::max(), MPI_MAX, comm_);
}
void Comm::min(std::span<double> values) const {
  extremum(values, std::numeric_limits<std::int64_t>::min(), MPI_MIN, comm_);
}
void Comm::max(std::span<std::int64_t> values) const { all_reduce(values, MPI_INT64_T, MPI_MAX, comm_); }
void Comm::sum(std::span<std::int64_t> values) const { all_reduce(values, MPI_INT64_T, MPI_SUM, comm_); }
void Comm::sum(std::span<std::uint64_t> values) const { all_reduce(values, MPI_UINT64_T, MPI_SUM, comm_); }
void Comm::bit_xor(std::span<std::uint64_t> values) const {
  all_reduce(values, MPI_UINT64_T, MPI_BXOR, comm_);
}

std::int64_t Comm::max(std::int64_t value) const {
  max(std::span(&value, 1));
  return value;
}

std::int64_t Comm::sum(std::int64_t value) const {
  sum(std::span(&value, 1));
  return value;
}

std::int64_t Comm::exclusive_sum(std::int64_t value) const {
  std::int64_t below = 0;
  check_mpi(MPI_Exscan(&value, &below, 1, MPI_INT64_T, MPI_SUM, comm_), "MPI_Exscan");
  return rank_ == 0 ? 0 : below;  // MPI leaves rank 0's result undefined
}

void Comm::broadcast(std::span<std::byte> bytes, Rank root) const {
  for_each_chunk(bytes.size(), max_message_bytes, [&](std::size_t first, int count) {
    check_mpi(MPI_Bcast(bytes.data() + first, count, MPI_BYTE, root, comm_), "MPI_Bcast");
  });
}

std::string Comm::broadcast(const std::string& text, Rank root) const {
  std::uint64_t length = text.size();
  broadcast(std::as_writable_bytes(std::span(&length, 1)), root);
  std::string result = rank_ == root ? text : std::string(length, '\0');
  broadcast(std::as_writable_bytes(std::span(result)), root);
  return result;
}

std::vector<double> Comm::all_gather(double value) const {
  std::vector<double> all(static_cast<std::size_t>(size_));
  check_mpi(MPI_Allgather(&value, 1, MPI_DOUBLE, all.data(), 1, MPI_DOUBLE, comm_), "MPI_Allgather");
  return all;
}

std::vector<std::int64_t> Comm::all_gather(std::int64_t value) const {
  std::vector<std::int64_t> all(static_cast<std::size_t>(size_));
  check_mpi(MPI_Allgather(&value, 1, MPI_INT64_T, all.data(), 1, MPI_INT64_T, comm_), "MPI_Allgather");
  return all;
}

std::vector<std::byte> Comm::gather(std::span<const std::byte> bytes, Rank root) const {
  const auto mine = static_cast<std::int64_t>(bytes.size());
  std::vector<std::int64_t> sizes(rank_ == root ? static_cast<std::size_t>(size_) : 0);
  check_mpi(MPI_Gather(&mine, 1, MPI_INT64_T, sizes.data(), 1, MPI_INT64_T, root, comm_), "MPI_Gather");

  std::vector<std::byte> all;
  std::vector<MPI_Request> requests;
  if (rank_ != root) {
    start_send(*this, bytes, root, gather_tag, requests);
  } else {
    std::size_t total = 0;
    for (const std::int64_t n : sizes) total += static_cast<std::size_t>(n);
    all.resize(total);
    std::size_t first = 0;
    for (Rank r = 0; r < size_; ++r) {
      const auto n = static_cast<std::size_t>(sizes[static_cast<std::size_t>(r)]);
      const std::span<std::byte> place(all.data() + first, n);
      if (r != root)
        start_receive(*this, place, r, gather_tag, requests);
      else
        std::copy(bytes.begin(), bytes.end(), place.begin());
      first += n;
    }
  }
  wait_all(requests);
  return all;
}

void Comm::barrier() const { check_mpi(MPI_Barrier(comm_), "MPI_Barrier"); }

std::vector<std::byte> gather_everywhere(const Comm& comm, std::span<const std::byte> bytes) {
  const std::int64_t total = comm.sum(static_cast<std::int64_t>(bytes.size()));
  if (total == 0) return {};
  std::vector<std::byte> all = comm.gather(bytes, 0);
  all.resize(static_cast<std::size_t>(total));
  comm.broadcast(std::span<std::byte>(all), 0);
  return all;
}

}  // namespace decomp
