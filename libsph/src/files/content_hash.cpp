#include "files/content_hash.hpp"

#include <fmt/format.h>
#include <xxhash.h>

#include <charconv>
#include <memory>
#include <stdexcept>
#include <vector>

namespace sph {

std::uint64_t content_hash(std::span<const std::byte> bytes, std::uint64_t seed) {
  return XXH3_64bits_withSeed(bytes.data(), bytes.size(), seed);
}

std::uint64_t content_hash(std::istream& in) {
  const std::unique_ptr<XXH3_state_t, XXH_errorcode (*)(XXH3_state_t*)> state(XXH3_createState(),
                                                                              XXH3_freeState);
  XXH3_64bits_reset(state.get());
  std::vector<char> part(std::size_t{1} << 20);
  do {
    in.read(part.data(), static_cast<std::streamsize>(part.size()));
    XXH3_64bits_update(state.get(), part.data(), static_cast<std::size_t>(in.gcount()));
  } while (in);
  return XXH3_64bits_digest(state.get());
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
