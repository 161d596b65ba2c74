// Tells damaged bytes from good ones: XXH3 of 64 bits, the same on every machine.
#pragma once

#include <cstddef>
#include <cstdint>
#include <istream>
#include <span>
#include <string>

namespace sph {

/// `seed`: the hash of what is before, of a text that grows.
[[nodiscard]] std::uint64_t content_hash(std::span<const std::byte> bytes, std::uint64_t seed = 0);
/// Of all that is left of a stream, which need not fit into memory.
[[nodiscard]] std::uint64_t content_hash(std::istream& in);
[[nodiscard]] std::string to_hex(std::uint64_t value);            ///< 16 digits
[[nodiscard]] std::uint64_t from_hex(const std::string& digits);  ///< throws unless it is 16 digits

}  // namespace sph
