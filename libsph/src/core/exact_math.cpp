// The `purec` entry points are plain symbols, not resolved at load time by the CPU; each has been compiled
// once, without FMA (the fused variants are the separate `purecfma`). All are within 1 ulp.
#include "sph/core/exact_math.hpp"

#include <sleef.h>

namespace sph {

double exact_pow(double x, double y) { return Sleef_powd1_u10purec(x, y); }
double exact_exp(double x) { return Sleef_expd1_u10purec(x); }
double exact_log(double x) { return Sleef_logd1_u10purec(x); }
double exact_sin(double x) { return Sleef_sind1_u10purec(x); }
double exact_cos(double x) { return Sleef_cosd1_u10purec(x); }

}  // namespace sph
