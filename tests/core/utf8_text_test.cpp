#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/text.hpp"

namespace d2b::test {
namespace {

/// As a report in JSON has it.
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
