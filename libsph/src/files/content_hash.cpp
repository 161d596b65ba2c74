#include "files/content_hash.hpp"

#include <fmt/format.h>
#include <xxhash.h>

#include <charconv>
#include <stdexcept>

namespace sph {

std::uint64_t content_hash(std::span<const std::byte> bytes, std::uint64_t seed) {
  return XXH3_64bits_withSeed(bytes.data(), bytes.size(), seed);
}

std::string to_hex(std::uint64_t value) { return fmt::format("{:016x}", value); }

std::uint64_t from_hex(const std::string& digits) {
  std::uint64_t value = 0;
  const char* end = digits.data() + digits.size();
  const auto [stop, error] = std::from_chars(digits.data(), end, value, 16);
  if (error != std::errc() || stop != end || digits.size() != 16)
    throw std::runtime_error("'" + digits + "' is not a number of 16 hexadecimal digits");
  return value;
}

}  // namespace sph
