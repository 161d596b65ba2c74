#include "files/agree.hpp"

namespace sph {

std::string agree(const decomp::Comm& comm, const std::string& failure) {
  const std::int64_t nobody = -comm.size();
  const std::int64_t lowest = comm.max(failure.empty() ? nobody : std::int64_t{-comm.rank()});
  if (lowest == nobody) return {};
  return comm.broadcast(failure, static_cast<decomp::Rank>(-lowest));
}

}  // namespace sph
