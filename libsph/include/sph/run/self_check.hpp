// Start-up check of the rules of the numbers (cmake/FpModel.cmake): a small pair loop in float and double,
// the exact functions and a few subnormal numbers are hashed and compared with the recorded hash, the same
// for every correct build. A contracted product, flushed subnormals or another rounding mode stop the program
// here rather than change a result quietly.
#pragma once

namespace sph {

/// Takes less than a millisecond. Throws InputError if this build or this process breaks a rule.
void self_check();

}  // namespace sph
