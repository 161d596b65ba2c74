#include "decomp/combined_reduction.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "ordered_key.hpp"

namespace decomp {
namespace {

/// Words are { their number, the number of maxima, keys of maxima..., integers to add... }.
void combine(void* in, void* in_out, int* records, MPI_Datatype*) {
  const auto* from = static_cast<const std::int64_t*>(in);
  auto* to = static_cast<std::int64_t*>(in_out);
  for (int r = 0; r < *records; ++r, from += from[0], to += to[0]) {
    const std::int64_t sums_begin = 2 + from[1];
    for (std::int64_t k = 2; k < sums_begin; ++k) to[k] = std::max(to[k], from[k]);
    for (std::int64_t k = sums_begin; k < from[0]; ++k) to[k] += from[k];
  }
}

}  // namespace

void max_and_sum(const Comm& comm, std::span<double> maxima, std::span<std::int64_t> sums) {
  std::vector<std::int64_t> words{static_cast<std::int64_t>(2 + maxima.size() + sums.size()),
                                  static_cast<std::int64_t>(maxima.size())};
  for (double x : maxima)
    words.push_back(std::isnan(x) ? std::numeric_limits<std::int64_t>::max() : ordered_key(x));
  words.insert(words.end(), sums.begin(), sums.end());
  MPI_Datatype record = MPI_DATATYPE_NULL;
  MPI_Op op = MPI_OP_NULL;
  check_mpi(MPI_Type_contiguous(static_cast<int>(words.size()), MPI_INT64_T, &record), "MPI_Type_contiguous");
  check_mpi(MPI_Type_commit(&record), "MPI_Type_commit");
  check_mpi(MPI_Op_create(combine, 1, &op), "MPI_Op_create");
  check_mpi(MPI_Allreduce(MPI_IN_PLACE, words.data(), 1, record, op, comm.get()), "MPI_Allreduce");
  check_mpi(MPI_Op_free(&op), "MPI_Op_free");
  check_mpi(MPI_Type_free(&record), "MPI_Type_free");
  for (std::size_t k = 0; k < maxima.size(); ++k) maxima[k] = from_ordered_key(words[2 + k]);
  std::copy(words.begin() + 2 + static_cast<std::ptrdiff_t>(maxima.size()), words.end(), sums.begin());
}

}  // namespace decomp
