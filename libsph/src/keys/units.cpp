#include "keys/units.hpp"

#include <fmt/format.h>

#include <array>
#include <cctype>
#include <charconv>
#include <cstddef>
#include <system_error>

namespace sph {
namespace {

/// One unit is factor * 10^exponent SI units.
struct Unit {
  std::string_view name;
  Dimension dim;
  int exponent = 0;
  double factor = 1;
};

constexpr Dimension mass{1, 0, 0};
constexpr Dimension energy{1, 2, -2};
constexpr Dimension heat_rate{1, 2, -3};

constexpr std::array units{
    Unit{"1", dimension::none},
    Unit{"%", dimension::none, -2},
    Unit{"m", dimension::length},
    Unit{"km", dimension::length, 3},
    Unit{"cm", dimension::length, -2},
    Unit{"mm", dimension::length, -3},
    Unit{"um", dimension::length, -6},
    Unit{"s", dimension::time},
    Unit{"ms", dimension::time, -3},
    Unit{"us", dimension::time, -6},
    Unit{"min", dimension::time, 0, 60},
    Unit{"h", dimension::time, 0, 3600},
    Unit{"d", dimension::time, 0, 86400},
    Unit{"Hz", dimension::rate},
    Unit{"rpm", dimension::rate, 0, 0.10471975511965977},  // 2 pi / 60
    Unit{"kg", mass},
    Unit{"g", mass, -3},
    Unit{"t", mass, 3},
    Unit{"N", dimension::force},
    Unit{"mN", dimension::force, -3},
    Unit{"kN", dimension::force, 3},
    Unit{"MN", dimension::force, 6},
    Unit{"Pa", dimension::pressure},
    Unit{"hPa", dimension::pressure, 2},
    Unit{"kPa", dimension::pressure, 3},
    Unit{"MPa", dimension::pressure, 6},
    Unit{"GPa", dimension::pressure, 9},
    Unit{"mPa", dimension::pressure, -3},
    Unit{"bar", dimension::pressure, 5},
    Unit{"mbar", dimension::pressure, 2},
    Unit{"kbar", dimension::pressure, 8},
    Unit{"atm", dimension::pressure, 0, 101325},
    Unit{"J", energy},
    Unit{"kJ", energy, 3},
    Unit{"MJ", energy, 6},
    Unit{"W", heat_rate},
    Unit{"mW", heat_rate, -3},
    Unit{"kW", heat_rate, 3},
    Unit{"MW", heat_rate, 6},
    Unit{"K", dimension::temperature},
};

struct NamedDimension {
  Dimension dim;
  std::string_view name;
  std::string_view unit;
};
constexpr std::array named{
    NamedDimension{dimension::none, "a number without unit", "1"},
    NamedDimension{dimension::length, "a length", "m"},
    NamedDimension{dimension::time, "a time", "s"},
    NamedDimension{dimension::speed, "a speed", "m/s"},
    NamedDimension{dimension::acceleration, "an acceleration", "m/s2"},
    NamedDimension{dimension::density, "a density", "kg/m3"},
    NamedDimension{dimension::pressure, "a pressure", "Pa"},
    NamedDimension{dimension::viscosity, "a viscosity", "Pa s"},
    NamedDimension{dimension::specific_energy, "an energy per mass", "m2/s2"},
    NamedDimension{mass, "a mass", "kg"},
    NamedDimension{dimension::mass_rate, "a mass per time", "kg/s"},
    NamedDimension{dimension::force, "a force", "N"},
    NamedDimension{dimension::stiffness, "a stiffness", "N/m"},
    NamedDimension{dimension::speed_per_force, "a speed per force", "m/s/N"},
    NamedDimension{energy, "an energy", "J"},
    NamedDimension{dimension::rate, "a rate", "1/s"},
    NamedDimension{dimension::rate_squared, "a rate squared", "1/s2"},
    NamedDimension{dimension::diffusivity, "a diffusivity", "m2/s"},
    NamedDimension{dimension::temperature, "a temperature", "K"},
    NamedDimension{dimension::per_temperature, "a share per kelvin", "1/K"},
    NamedDimension{dimension::temperature_flux, "a heat flux over a heat capacity", "K m/s"},
    NamedDimension{dimension::area, "an area", "m2"},
    NamedDimension{dimension::specific_heat, "a heat capacity per mass", "J/kg/K"},
    NamedDimension{dimension::conductivity, "a thermal conductivity", "W/m/K"},
    NamedDimension{dimension::heat_flux, "a heat flux", "W/m2"},
    NamedDimension{dimension::heat_transfer, "a heat transfer coefficient", "W/m2/K"},
};

constexpr int max_power = 9;
constexpr int max_exponent = 9999;  // beyond the range of doubles, within that of int

bool is_digit(char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; }

class Cursor {
 public:
  explicit Cursor(std::string_view text) : text_(text) {}
  [[nodiscard]] bool done() const { return at_ >= text_.size(); }
  [[nodiscard]] char peek(std::size_t ahead = 0) const {
    return at_ + ahead < text_.size() ? text_[at_ + ahead] : '\0';
  }
  void skip_spaces() {
    while (peek() == ' ' || peek() == '\t') ++at_;
  }
  bool take(char c) {
    if (peek() != c || done()) return false;
    ++at_;
    return true;
  }
  template <class Test>
  std::string_view take_while(Test&& test) {
    const std::size_t begin = at_;
    while (!done() && test(text_[at_])) ++at_;
    return text_.substr(begin, at_ - begin);
  }

 private:
  std::string_view text_;
  std::size_t at_ = 0;
};

struct Number {
  std::string digits;  ///< sign, digits and point
  int exponent = 0;
};

bool read_number(Cursor& in, Number& out) {
  if (in.take('-'))
    out.digits = "-";
  else
    in.take('+');
  const std::string_view whole = in.take_while(is_digit);
  out.digits += whole.empty() ? "0" : std::string(whole);
  std::string_view fraction;
  if (in.take('.')) {
    fraction = in.take_while(is_digit);
    if (!fraction.empty()) out.digits += fmt::format(".{}", fraction);
  }
  if (whole.empty() && fraction.empty()) return false;
  const char sign = in.peek(1);
  const bool signed_exponent = (sign == '-' || sign == '+') && is_digit(in.peek(2));
  if ((in.peek() == 'e' || in.peek() == 'E') && (is_digit(sign) || signed_exponent)) {
    in.take(in.peek());
    in.take('+');
    const bool negative = in.take('-');
    const std::string_view power = in.take_while(is_digit);
    const auto [end, error] = std::from_chars(power.data(), power.data() + power.size(), out.exponent);
    if (error != std::errc{} || out.exponent > max_exponent) out.exponent = max_exponent;
    if (negative) out.exponent = -out.exponent;
  }
  return true;
}

/// The product of units read so far.
struct Product {
  Dimension dim;
  int exponent = 0;
  double multiply = 1;
  double divide = 1;
  void times(const Unit& unit, int power) {
    dim.kg += power * unit.dim.kg;
    dim.m += power * unit.dim.m;
    dim.s += power * unit.dim.s;
    dim.kelvin += power * unit.dim.kelvin;
    exponent += power * unit.exponent;
    for (int k = 0; k < power; ++k) multiply *= unit.factor;
    for (int k = 0; k > power; --k) divide *= unit.factor;
  }
};

/// One factor, "m3", "m^-3", "Pa"; empty when read, otherwise what is wrong.
std::string read_factor(Cursor& in, int sign, Product& product) {
  std::string name;
  if (in.take('1'))
    name = "1";
  else
    name = in.take_while([](char c) {
      const auto code = static_cast<unsigned char>(c);
      return std::isalpha(code) != 0 || c == '%' || code >= 0x80;
    });
  if (name.empty()) return fmt::format("has '{}' where a unit should be", in.done() ? ' ' : in.peek());
  const Unit* found = nullptr;
  for (const Unit& u : units)
    if (u.name == name) found = &u;
  if (found == nullptr) return fmt::format("has the unknown unit \"{}\"", name);
  const bool caret = in.take('^');
  const bool negative = caret && in.take('-');
  const std::string_view text = in.take_while(is_digit);
  int power = 1;
  if (!text.empty()) std::from_chars(text.data(), text.data() + text.size(), power);
  if (text.size() > 1 || power < 1 || power > max_power || (caret && text.empty()))
    return fmt::format("has a bad power of the unit \"{}\"", name);
  product.times(*found, (negative ? -power : power) * sign);
  return {};
}

std::string read_units(Cursor& in, Product& product) {
  std::string problem = read_factor(in, 1, product);
  while (problem.empty()) {
    in.skip_spaces();
    if (in.done()) break;
    const int sign = in.take('/') ? -1 : 1;
    if (sign > 0) in.take('*');
    in.skip_spaces();
    problem = read_factor(in, sign, product);
  }
  return problem;
}

}  // namespace

Quantity parse_quantity(std::string_view text) {
  Quantity out;
  Cursor in(text);
  Number number;
  in.skip_spaces();
  if (!read_number(in, number)) {
    out.problem = "does not begin with a number";
    return out;
  }
  in.skip_spaces();
  Product product;
  out.has_unit = !in.done();
  if (out.has_unit) out.problem = read_units(in, product);
  if (!out.problem.empty()) return out;
  const std::string shifted = fmt::format("{}e{}", number.digits, number.exponent + product.exponent);
  const auto [end, error] = std::from_chars(shifted.data(), shifted.data() + shifted.size(), out.value);
  if (error != std::errc{}) {
    out.problem = "is outside the range of numbers";
    return out;
  }
  out.value = out.value * product.multiply / product.divide;
  out.dim = product.dim;
  return out;
}

std::string si_unit(Dimension dim) {
  for (const NamedDimension& n : named)
    if (n.dim == dim) return std::string(n.unit);
  return fmt::format("kg^{} m^{} s^{} K^{}", dim.kg, dim.m, dim.s, dim.kelvin);
}

std::string describe(Dimension dim) {
  for (const NamedDimension& n : named)
    if (n.dim == dim)
      return dim == dimension::none ? std::string(n.name) : fmt::format("{} ({})", n.name, n.unit);
  return fmt::format("a quantity in {}", si_unit(dim));
}

}  // namespace sph
