// The start-up check passes here, and notices what a program around the library may have set. A contracted
// build is the test self_check.contraction; other compilers and CPUs, the test compilers.
#include <gtest/gtest.h>

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
  std::fenv_t before;
  std::fegetenv(&before);
  std::fenv_t flushing = before;  // to zero, what linking with -ffast-math does
#if defined(__aarch64__)
  flushing.__fpcr |= 1u << 24;
#else
  flushing.__mxcsr |= 0x8040;
#endif
  std::fesetenv(&flushing);
  EXPECT_THROW(sph::self_check(), sph::InputError);
  std::fesetenv(&before);
}

}  // namespace
