// U. Kulisch, W. L. Miranker, "Computer arithmetic in theory and practice" (1981): a register as wide as the
// whole range of the format makes the sum an integer sum.
#include "decomp/exact_sum.hpp"

#include <algorithm>
#include <bit>
#include <limits>
#include <vector>

namespace decomp {

namespace {

constexpr int digit_bits = 32;
constexpr std::uint64_t digit_mask = 0xffffffffU;
constexpr int fraction_bits = 52;
constexpr std::uint64_t hidden_bit = std::uint64_t{1} << fraction_bits;
constexpr std::uint64_t infinite_exponent = 0x7ff;

}  // namespace

void ExactSum::add(double x) {
  const auto bits = std::bit_cast<std::uint64_t>(x);
  const std::uint64_t exponent = bits >> fraction_bits & infinite_exponent;
  if (exponent == infinite_exponent) {
    ++non_finite_;
    return;
  }
  // x = +-fraction 2^(position - 1074); subnormals share the position of the smallest normal numbers
  const std::uint64_t fraction = (bits & (hidden_bit - 1)) | (exponent != 0 ? hidden_bit : 0);
  const std::uint64_t position = exponent - (exponent != 0 ? 1 : 0);
  const std::uint64_t shift = position % digit_bits;
  const std::uint64_t low = (fraction & digit_mask) << shift;  // < 2^63
  const std::uint64_t high = ((fraction >> digit_bits) << shift) + (low >> digit_bits);
  const std::int64_t sign = static_cast<std::int64_t>(bits) >> 63;  // 0 or -1: (d ^ sign) - sign = +-d
  std::int64_t* const d = digit_.data() + position / digit_bits;
  d[0] += (static_cast<std::int64_t>(low & digit_mask) ^ sign) - sign;
  d[1] += (static_cast<std::int64_t>(high & digit_mask) ^ sign) - sign;
  d[2] += (static_cast<std::int64_t>(high >> digit_bits) ^ sign) - sign;
  if (++pending_ == max_pending) propagate();
}

void ExactSum::add(const ExactSum& other) {
  if (pending_ + other.pending_ > max_pending) propagate();
  for (std::size_t i = 0; i < digits; ++i) digit_[i] += other.digit_[i];
  non_finite_ += other.non_finite_;
  pending_ += other.pending_;
}

void ExactSum::propagate() {
  std::int64_t carry = 0;
  for (std::size_t i = 0; i + 1 < digits; ++i) {
    const std::int64_t sum = digit_[i] + carry;
    digit_[i] = static_cast<std::int64_t>(static_cast<std::uint64_t>(sum) & digit_mask);
    carry = sum >> digit_bits;  // towards -infinity, which leaves the digit in [0, 2^32)
  }
  digit_.back() += carry;
  pending_ = 1;
}

double ExactSum::value() const {
  if (non_finite_ != 0) return std::numeric_limits<double>::quiet_NaN();
  ExactSum magnitude = *this;
  magnitude.propagate();
  const bool negative = magnitude.digit_.back() < 0;
  if (negative) {
    for (std::int64_t& d : magnitude.digit_) d = -d;
    magnitude.propagate();
  }
  const auto digit = [&](int i) {
    return i >= 0 && i < digits ? static_cast<std::uint64_t>(magnitude.digit_[static_cast<std::size_t>(i)])
                                : std::uint64_t{0};
  };
  int top = digits - 1;
  while (top > 0 && digit(top) == 0) --top;
  // Position of the last bit kept: 53 bits below the leading one, but never below 2^-1074.
  const int leading = top * digit_bits + static_cast<int>(std::bit_width(digit(top))) - 1;
  const int last = std::max(leading - fraction_bits, 0);
  const double infinity = std::numeric_limits<double>::infinity();
  if (last >= static_cast<int>(infinite_exponent) - 1) return negative ? -infinity : infinity;

  const int first = last / digit_bits;
  const int offset = last % digit_bits;
  const std::uint64_t middle = digit(first) | digit(first + 1) << digit_bits;
  std::uint64_t fraction = middle >> offset;
  if (offset != 0) fraction |= digit(first + 2) << (2 * digit_bits - offset);
  if (last > 0) {  // round to nearest, ties to even
    const auto bit_at = [&](int position) {
      return digit(position / digit_bits) >> (position % digit_bits) & 1;
    };
    const bool half = bit_at(last - 1) != 0;
    bool below =
        (digit((last - 1) / digit_bits) & ((std::uint64_t{1} << ((last - 1) % digit_bits)) - 1)) != 0;
    for (int i = (last - 1) / digit_bits - 1; !below && i >= 0; --i) below = digit(i) != 0;
    if (half && (below || (fraction & 1) != 0)) ++fraction;
  }
  // The hidden bit of `fraction` adds 1 to the exponent field, and a carry out of the rounding one more.
  const std::uint64_t bits = (static_cast<std::uint64_t>(last) << fraction_bits) + fraction;
  if (bits >> fraction_bits >= infinite_exponent) return negative ? -infinity : infinity;
  const double absolute = std::bit_cast<double>(bits);
  return negative ? -absolute : absolute;
}

void ExactSum::all_reduce(const Comm& comm, std::span<ExactSum> sums) {
  std::vector<std::int64_t> packed;
  packed.reserve(sums.size() * (digits + 1));
  for (ExactSum& s : sums) {
    s.propagate();  // digits below 2^32 leave room for 2^31 ranks
    packed.insert(packed.end(), s.digit_.begin(), s.digit_.end());
    packed.push_back(s.non_finite_);
  }
  comm.sum(std::span<std::int64_t>(packed));
  const std::int64_t* from = packed.data();
  for (ExactSum& s : sums) {
    for (std::int64_t& d : s.digit_) d = *from++;
    s.non_finite_ = *from++;
    s.propagate();
  }
}

}  // namespace decomp
