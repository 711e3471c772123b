#pragma once

#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace d2b {

/// The numbers that an option takes, in the words that help and messages share.
struct NumberRange {
    double lowest = -std::numeric_limits<double>::infinity();
    double highest = std::numeric_limits<double>::infinity();
    bool above_lowest = false;  ///< the lowest itself is refused

    [[nodiscard]] bool holds(double value) const;
    /// "a whole number from 1 to 10000", "a number above 0", ... @param noun "a number" or "a whole number"
    [[nodiscard]] std::string text(std::string_view noun) const;
};

/// Throws the OptionError "-name must be <range>, not 'text'."
[[noreturn]] void refuse_value(std::string_view name, std::string_view range, std::string_view text);

/// Whether the text is a number, NaN and infinities included: what a parser takes for a number even where it
/// begins with a dash. The decimal separator is a point, whatever the locale.
[[nodiscard]] bool looks_like_number(std::string_view text);

/// A finite number of the range; nothing where the text is anything else.
[[nodiscard]] std::optional<double> read_number(const NumberRange& range, std::string_view text);

/// @throws OptionError unless all of the text is a finite number of the range
[[nodiscard]] double parse_number(std::string_view name, const NumberRange& range, std::string_view text);

/// @throws OptionError unless all of the text is a whole number of the range, written without a decimal point
[[nodiscard]] int parse_whole(std::string_view name, const NumberRange& range, std::string_view text);

/// "a", "a or b", "a, b or c".
[[nodiscard]] std::string alternatives(std::span<const std::string> words);

/// All of them, separated.
[[nodiscard]] std::string joined(std::span<const std::string> words, std::string_view separator);

}  // namespace d2b
