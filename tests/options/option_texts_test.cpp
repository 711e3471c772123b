#include <clocale>
#include <cmath>
#include <cstdlib>
#include <regex>
#include <sstream>

#include "options/option_scene.hpp"

namespace d2b::test {
namespace {

/// Texts that people and programs write for a number that is none, or not one of ours.
const Texts texts = [] {
    std::istringstream list(
        "nan|NaN|-nan|inf|-inf|Infinity|1e999|-1e999|1,5|1.000,5|1'000|1 5| 5|5 "
        "|0x10|1e|--5|+-5|5m|\xEF\xBC\x95|1e308|-1e308|-1|-0|0|1e-320|1e-9|0.5|+2|2.|.5|1E3|1e5|1e300|1e17|"
        "65537|1e9|1000000000|2147483648|-2147483649|9223372036854775808|99999999999999999999");
    Texts all;
    for (std::string text; std::getline(list, text, '|');)
        all.push_back(text);
    return all;
}();

/// True as the documentation has it: digits with a point, an exponent or a sign. Found without our parser.
bool is_number(const std::string& text, bool whole) {
    static const std::regex real(R"([+-]?([0-9]+\.?[0-9]*|\.[0-9]+)([eE][+-]?[0-9]+)?)");
    static const std::regex integer(R"([+-]?[0-9]+)");
    return std::regex_match(text, whole ? integer : real);
}

bool is_whole(const OptionRow& row) {
    return row.range.starts_with("a whole number");
}

bool should_take(const OptionRow& row, const std::string& text) {
    if (!is_number(text, is_whole(row)))
        return false;
    std::setlocale(LC_NUMERIC, "C");
    const double value = std::strtod(text.c_str(), nullptr);
    const NumberRange& range = *row.numbers;
    const bool underflow = std::abs(value) < 2.3e-308 && value != 0;  // a parser may refuse these, or not
    return !underflow && std::isfinite(value) && value <= range.highest &&
           (range.above_lowest ? value > range.lowest : value >= range.lowest);
}

Texts with_value(const OptionRow& row, const std::string& text) {
    Texts words{"-" + row.name + "=" + text};
    if (row.name == "off")
        words.insert(words.begin(), {"-i", "1e300"});  // that can be counted from anywhere
    if (row.name == "split_width")
        words.insert(words.begin(), {"-split_by", "parcels.gpkg"});
    if (row.name == "exclude_buffer")
        words.insert(words.begin(), {"-exclude", "/vsimem/scene/exclusions.gpkg"});
    if (row.name == "roof_min_area")
        words.insert(words.begin(), "-roofs");
    if (row.name == "preview_scale")
        words.insert(words.begin(), {"-preview", "p.png", "-preview_paper", "A4"});
    return words;
}

class OptionTexts : public OptionScene {
  protected:
    void TearDown() override { std::setlocale(LC_ALL, "C"); }
};

void expect_taken_or_refused() {
    for (const OptionRow& row : option_table()) {
        if (!row.numbers)
            continue;
        for (const std::string& text : texts) {
            if (text == "1e-320")
                continue;
            const std::string message = refusal_of(with_value(row, text));
            if (should_take(row, text))
                EXPECT_EQ(message, "") << row.name << " " << text;
            else
                EXPECT_EQ(message, "-" + row.name + " must be " + row.range + ", not '" + text + "'.");
        }
        EXPECT_EQ(refusal_of({"-" + row.name, ""}),
                  "-" + row.name + " needs a value: -" + row.name + " " + row.values + ".");
    }
}

TEST_F(OptionTexts, numbersAreTakenInTheirRangeAlone) {
    expect_taken_or_refused();
}

TEST_F(OptionTexts, aLocaleWithACommaChangesNothing) {
    if (std::setlocale(LC_ALL, "de_DE.UTF-8") == nullptr && std::setlocale(LC_ALL, "fr_FR.UTF-8") == nullptr)
        GTEST_SKIP() << "there is no locale with a decimal comma here";
    expect_taken_or_refused();
}

TEST_F(OptionTexts, listsAndWindowsHoldNumbersAlone) {
    for (const OptionRow& row : option_table()) {
        if (row.arity != Arity::several && row.arity != Arity::list)
            continue;
        const std::size_t count = row.arity == Arity::list ? 2 : row.count;
        for (std::size_t place = 0; place < count; ++place)
            for (const std::string& text : texts) {
                Texts values(count, "1");
                values[place] = text;
                Request request;
                std::string message;
                try {
                    apply_option(row, request, values);
                } catch (const std::exception& error) {
                    message = error.what();
                }
                const bool number =
                    is_number(text, false) && std::isfinite(std::strtod(text.c_str(), nullptr));
                const bool taken = row.arity == Arity::list && number;
                EXPECT_TRUE(number || message.starts_with("-" + row.name + " must be "))
                    << text << ": " << message;
                EXPECT_TRUE(!taken || message.empty() || text == "1e-320") << text << ": " << message;
            }
    }
}

/// Accepted values are worked with: a sentence, or numbers that are some.
TEST_F(OptionTexts, extremeNumbersAreRefusedOrGiveFiniteResults) {
    const auto check = [](const Texts& words) {
        if (!refusal_of(words).empty())
            return;
        const Outcome outcome = outcome_of(words);
        EXPECT_TRUE(outcome.finite) << words.back();
        EXPECT_TRUE(outcome.error.empty() || outcome.error.ends_with('.')) << outcome.error;
        EXPECT_EQ(outcome.error.find('\n'), std::string::npos);
    };
    for (const OptionRow& row : option_table())
        if (row.numbers && shapes_the_result(row.name))
            for (const char* text : {"1e308", "-1e308", "1e-300", "1e17", "0", "1000000000", "65536", "100"})
                check(with_value(row, text));
    for (const char* text : {"1e308", "-1e308", "1e-300", "1e17"}) {
        check({"-fl", text});
        check({"-fl", "105", text});
        check({"-zunit", text});
        check({"-i", text});
        check({"-i", "1e-9", "-off", text});
        check({"-te", "-1e308", "-1e308", text, "1e308"});
        check({"-projwin", "-1e308", "1e308", text, "-1e308"});
        check({"-srcwin", "0", "0", text, text});
        check({"-srcwin", text, text, "5", "5"});
    }
}

}  // namespace
}  // namespace d2b::test
