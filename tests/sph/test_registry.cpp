// What a program may add laws and terms to.
#include <gtest/gtest.h>

#include <string_view>

#include "sph/registry.hpp"

namespace sph {
namespace {

struct Entry {
  std::string_view word;
};

TEST(Registry, IsFixedOnceItHasBeenLookedAt) {
  const Entry ours{"ours"}, theirs{"theirs"}, again{"ours"}, late{"late"};
  Registry<Entry> all({&ours});
  all.add(theirs);
  EXPECT_THROW(all.add(again), std::logic_error);
  ASSERT_EQ(all.look().size(), 2U);
  EXPECT_EQ(all.look()[1], &theirs);
  EXPECT_THROW(all.add(late), std::logic_error);
}

}  // namespace
}  // namespace sph
