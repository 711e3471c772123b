#include "core/text.hpp"

#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <system_error>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/number_from_chars.hpp"

namespace d2b {
namespace {

TEST(Hundredths, AreTheNumbersOfTwoDigits) {
    EXPECT_EQ(round_to_hundredths(36.98765), 36.99);
    EXPECT_EQ(round_to_hundredths(9.994999), 9.99);
    EXPECT_EQ(round_to_hundredths(-0.126), -0.13);
    EXPECT_EQ(round_to_hundredths(123456789.123), 123456789.12);
    EXPECT_TRUE(std::isnan(round_to_hundredths(std::numeric_limits<double>::quiet_NaN())));
}

/// Values that a bound of two digits leaves out look left out when they are written.
TEST(Hundredths, OfAShareAreNotRoundedUp) {
    EXPECT_EQ(floor_to_hundredths(0.4999), 0.49);
    EXPECT_EQ(floor_to_hundredths(0.8999999), 0.89);
    for (int i = 0; i <= 100; ++i)
        EXPECT_EQ(floor_to_hundredths(i / 100.0), i / 100.0);
    EXPECT_TRUE(std::isnan(floor_to_hundredths(std::numeric_limits<double>::quiet_NaN())));
}

}  // namespace
}  // namespace d2b

namespace d2b::test {
namespace {

/// Text as a report in JSON has it.
std::string in_json(const std::string& bytes) {
    const std::string quoted =
        nlohmann::json(bytes).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
    return nlohmann::json::parse(quoted).get<std::string>();
}

TEST(Utf8Text, keepsWhatIsUtf8) {
    for (const std::string& text :
         std::vector<std::string>{"", "plain", "Geb\xC3\xA4ude", "\xE2\x82\xAC 5", "\xF0\x9F\x8F\xA0",
                                  "\xEF\xBF\xBD", "\xED\x9F\xBF\xEE\x80\x80", "\xF4\x8F\xBF\xBF"})
        EXPECT_EQ(utf8_text(text), text);
    const std::string with_null("a\0b", 3);
    EXPECT_EQ(utf8_text(with_null), with_null);
}

/// The examples of section 3.9 of the Unicode Standard (tables 3-8 to 3-11), which say how often U+FFFD is to
/// stand.
TEST(Utf8Text, replacesAsUnicodeAdvises) {
    const std::string r = "\xEF\xBF\xBD";
    EXPECT_EQ(utf8_text("Geb\xE4ude"), "Geb" + r + "ude");
    EXPECT_EQ(utf8_text("\xC0\xAF\xE0\x80\xBF\xF0\x81\x82\x41"), r + r + r + r + r + r + r + r + "A");
    EXPECT_EQ(utf8_text("\xED\xA0\x80\xED\xBF\xBF\xED\xAF\x41"), r + r + r + r + r + r + r + r + "A");
    EXPECT_EQ(utf8_text("\xF4\x91\x92\x93\xFF\x41\x80\xBF\x42"), r + r + r + r + r + "A" + r + r + "B");
    EXPECT_EQ(utf8_text("\xE1\x80\xE2\xF0\x91\x92\xF1\xBF\x41"), r + r + r + r + "A");
    EXPECT_EQ(utf8_text("\xE2\x82"), r);  // the end of the text is the end of the character
}

TEST(Utf8Text, isWhatReportsInJsonHold) {
    std::mt19937 random(36);
    // Bytes at which something changes, so that many texts are nearly right.
    const std::string bytes("a\x7F\x80\x8F\x90\x9F\xA0\xBF\xC1\xC2\xDF\xE0\xE1\xED\xEF\xF0\xF1\xF4\xF5\xFF");
    for (int i = 0; i < 20000; ++i) {
        std::string text;
        for (std::size_t n = random() % 7; n > 0; --n)
            text += bytes[random() % bytes.size()];
        ASSERT_EQ(utf8_text(text), in_json(text)) << testing::PrintToString(text);
    }
}

}  // namespace
}  // namespace d2b::test

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
