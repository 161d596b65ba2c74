// Values that a test measures, kept: the bits are fixed, so what a change of the code does to them shows, far
// within the bounds that theory or others' results set. They lie in tests/accuracy/pinned/SUITE.json; after a
// change that is meant:  PEPERITE_PIN=1 ctest -R accuracy  writes them anew, and git diff shows what became of them.
#pragma once

namespace measure {

/// The value, which must be the one kept for the running test under this name.
double pinned(const char* what, double value);

}  // namespace measure

/// The value, which must be the one kept for it.
#define PINNED(value) measure::pinned(#value, value)
