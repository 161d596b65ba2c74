// Tells damaged bytes from good ones: XXH3 of 64 bits, the same on every machine.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace sph {

[[nodiscard]] std::uint64_t content_hash(std::span<const std::byte> bytes);
[[nodiscard]] std::string to_hex(std::uint64_t value);            ///< 16 digits
[[nodiscard]] std::uint64_t from_hex(const std::string& digits);  ///< throws unless it is 16 digits

}  // namespace sph
