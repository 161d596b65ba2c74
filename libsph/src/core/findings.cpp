#include "sph/core/findings.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <limits>

#include "sph/core/error.hpp"

namespace sph {

std::string Findings::agree(const decomp::Comm& comm) const {
  constexpr std::uint64_t sign = std::uint64_t{1} << 63;
  constexpr std::int64_t none = std::numeric_limits<std::int64_t>::min();
  const std::int64_t earliest = comm.max(any() ? -found_in_ : none);
  if (earliest == none) return {};
  const bool speaks = any() && found_in_ == -earliest;
  // Descending, as signed numbers that a maximum can be taken of: they may be `none` too.
  const auto mine = speaks ? static_cast<std::int64_t>(~id_ ^ sign) : none;
  const std::int64_t most = comm.max(mine);
  const std::int64_t nobody = -comm.size();
  const std::int64_t speaker = comm.max(speaks && mine == most ? std::int64_t{-comm.rank()} : nobody);
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
