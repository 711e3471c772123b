#include "core/number_from_chars.hpp"

#include <cmath>
#include <limits>
#include <string>
#include <system_error>

#include <gtest/gtest.h>

namespace d2b {
namespace {

template <class Number>
struct Read {
    Number value = 7;
    std::size_t length = 0;
    std::errc error{};
};

template <class Number = double>
Read<Number> read(const std::string& text) {
    Read<Number> read;
    const auto [end, error] = number_from_chars(text.data(), text.data() + text.size(), read.value);
    read.length = static_cast<std::size_t>(end - text.data());
    read.error = error;
    return read;
}

TEST(NumberFromChars, readsUpToWhatIsNoPartOfTheNumber) {
    struct Case {
        const char* text;
        double value;
        std::size_t length;
    };
    for (const auto& [text, value, length] : {Case{"0", 0, 1},
                                              {"-12.5", -12.5, 5},
                                              {".5m", 0.5, 2},
                                              {"5.", 5, 2},
                                              {"1e3", 1000, 3},
                                              {"1E-3 ", 0.001, 4},
                                              {"1e", 1, 1},
                                              {"1e+", 1, 1},
                                              {"3,5", 3, 1},
                                              {"0x10", 0, 1},
                                              {"-0X1p3", 0, 2},
                                              {"00012", 12, 5},
                                              {"1_000", 1, 1},
                                              {"9007199254740993", 9007199254740992, 16},
                                              {"4.9406564584124654e-324", 5e-324, 23}}) {
        const Read<double> got = read(text);
        EXPECT_EQ(got.error, std::errc()) << text;
        EXPECT_EQ(got.value, value) << text;
        EXPECT_EQ(got.length, length) << text;
    }
    EXPECT_TRUE(std::signbit(read("-0").value));
    EXPECT_EQ(read("inf").value, std::numeric_limits<double>::infinity());
    EXPECT_EQ(read("-Infinity").value, -std::numeric_limits<double>::infinity());
    EXPECT_TRUE(std::isnan(read("nan").value));
    EXPECT_EQ(read<int>("42 m").value, 42);
}

TEST(NumberFromChars, leavesTheValueWhereThereIsNoNumber) {
    for (const char* text : {"", "-", "+1", "--1", " 1", "\t1", ".", "-.", "e5", "m", "x1", "- 1", "-+1"}) {
        const Read<double> got = read(text);
        EXPECT_EQ(got.error, std::errc::invalid_argument) << text;
        EXPECT_EQ(got.value, 7) << text;
        EXPECT_EQ(got.length, 0U) << text;
    }
}

TEST(NumberFromChars, tellsWhatIsOutOfRangeFromWhatIsNoNumber) {
    for (const std::string text : {"1e999", "-1e999", "1e-999"}) {
        const Read<double> got = read(text);
        EXPECT_EQ(got.error, std::errc::result_out_of_range) << text;
        EXPECT_EQ(got.value, 7) << text;
        EXPECT_EQ(got.length, text.size());
    }
    EXPECT_EQ(read<float>("1e39").error, std::errc::result_out_of_range);
    EXPECT_EQ(read<float>("1e38").value, 1e38F);
}

/// Reading a float by way of a double rounds twice: this is just above the middle of two floats.
TEST(NumberFromChars, roundsToSinglePrecisionOnce) {
    EXPECT_EQ(read<float>("1.000000059604644775390626").value, 1.00000011920928955078125F);
    EXPECT_EQ(read<float>("1.000000059604644775390624").value, 1.0F);
}

}  // namespace
}  // namespace d2b
