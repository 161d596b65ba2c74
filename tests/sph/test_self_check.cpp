// The start-up check passes here, and notices what a program around the library may have set. A contracted
// build is the test self_check.contraction; other compilers and CPUs, the test compilers.
#include <gtest/gtest.h>
#include <xmmintrin.h>

#include <cfenv>

#include "sph/core/error.hpp"
#include "sph/run/self_check.hpp"

namespace {

TEST(SelfCheck, PassesInThisBuild) { EXPECT_NO_THROW(sph::self_check()); }

TEST(SelfCheck, NoticesAnotherRoundingMode) {
  std::fesetround(FE_UPWARD);
  EXPECT_THROW(sph::self_check(), sph::InputError);
  std::fesetround(FE_TONEAREST);
}

TEST(SelfCheck, NoticesFlushedSubnormals) {
  const unsigned before = _mm_getcsr();
  _mm_setcsr(before | 0x8040);  // flush to zero, denormals are zero: what linking with -ffast-math does
  EXPECT_THROW(sph::self_check(), sph::InputError);
  _mm_setcsr(before);
}

}  // namespace
