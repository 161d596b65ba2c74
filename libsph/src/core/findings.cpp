#include "sph/core/findings.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <limits>

#include "sph/core/error.hpp"

namespace sph {

std::string Findings::agree(const decomp::Comm& comm) const {
  constexpr std::uint64_t sign = std::uint64_t{1} << 63;
  // Descending, as signed numbers that a maximum can be taken of.
  const auto mine = any() ? static_cast<std::int64_t>(~id_ ^ sign) : std::numeric_limits<std::int64_t>::min();
  std::array<std::int64_t, 2> most{any() ? 1 : 0, mine};
  comm.max(std::span<std::int64_t>(most));
  if (most[0] == 0) return {};
  const std::int64_t nobody = -comm.size();
  const std::int64_t speaker = comm.max(any() && mine == most[1] ? std::int64_t{-comm.rank()} : nobody);
  return comm.broadcast(text_, static_cast<decomp::Rank>(-speaker));
}

void Findings::stop(const decomp::Comm& comm, const std::string& prefix) const {
  const std::string text = agree(comm);
  if (!text.empty()) throw GuardError(prefix + text);
}

std::string place_text(std::span<const double> metres) {
  return fmt::format("at ({:.9g}) m", fmt::join(metres, ", "));
}

std::string step_text(std::int64_t step) { return fmt::format("step {}: ", step); }

}  // namespace sph
