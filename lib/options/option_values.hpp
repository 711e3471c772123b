#pragma once

#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace d2b {

/// Range of a numeric option, with the wording shared by help and messages.
struct NumberRange {
    double lowest = -std::numeric_limits<double>::infinity();
    double highest = std::numeric_limits<double>::infinity();
    bool above_lowest = false;  ///< excludes the lowest value itself

    [[nodiscard]] bool holds(double value) const;
    /// Returns "a whole number from 1 to 10000", "a number above 0", ... @param noun "a number" or "a whole
    /// number"
    [[nodiscard]] std::string text(std::string_view noun) const;
};

/// Throws the OptionError "-name must be <range>, not 'text'."
[[noreturn]] void refuse_value(std::string_view name, std::string_view range, std::string_view text);

/// Returns true if the text is a number, including NaN and infinities, so that a parser takes it for a value
/// even if it begins with a dash. The decimal separator is a point, independent of the locale.
[[nodiscard]] bool looks_like_number(std::string_view text);

/// Returns the number if the text is a finite number in the range, otherwise nothing.
[[nodiscard]] std::optional<double> read_number(const NumberRange& range, std::string_view text);

/// @throws OptionError unless the whole text is a finite number in the range
[[nodiscard]] double parse_number(std::string_view name, const NumberRange& range, std::string_view text);

/// @throws OptionError unless the whole text is an integer in the range, without a decimal point
[[nodiscard]] int parse_whole(std::string_view name, const NumberRange& range, std::string_view text);

/// Returns "a", "a or b", "a, b or c".
[[nodiscard]] std::string alternatives(std::span<const std::string> words);

/// Joins the words with a separator.
[[nodiscard]] std::string joined(std::span<const std::string> words, std::string_view separator);

}  // namespace d2b
