#include <gtest/gtest.h>

#include "diagnose/warnings.hpp"

namespace d2b {
namespace {

TEST(Words, NumbersForPeople) {
    EXPECT_EQ(rounded(42.9), "43");
    EXPECT_EQ(rounded(2.5), "2.5");
    EXPECT_EQ(rounded(-0.26), "-0.3");
    EXPECT_EQ(percent(0.123), "12 %");
    EXPECT_EQ(percent(0.0123), "1.2 %");
    EXPECT_EQ(percent(1), "100 %");
    EXPECT_EQ(percent(0), "0 %");
    EXPECT_EQ(percent(1e-7), "less than 0.1 %");
}

TEST(Words, ACauseByItself) {
    EXPECT_EQ(as_sentence("only few"), "Only few.");
    EXPECT_EQ(as_sentence("'a.tif' is one"), "'a.tif' is one.");
    EXPECT_EQ(as_sentence("-ground none"), "-ground none.");
}

}  // namespace
}  // namespace d2b
