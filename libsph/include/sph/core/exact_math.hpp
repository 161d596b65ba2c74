// Transcendental functions whose bits do not depend on the CPU: glibc picks variants at run time, the fixed
// `purec` variants of SLEEF do not. The only file of the library that calls any. sqrt is exact: use
// std::sqrt.
#pragma once

namespace sph {

[[nodiscard]] double exact_pow(double x, double y);
[[nodiscard]] double exact_exp(double x);
[[nodiscard]] double exact_log(double x);
[[nodiscard]] double exact_sin(double x);
[[nodiscard]] double exact_cos(double x);

}  // namespace sph
