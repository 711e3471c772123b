#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

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
[[nodiscard]] int parse_integer(std::string_view name, const NumberRange& range, std::string_view text);

/// Returns "a", "a or b", "a, b or c".
[[nodiscard]] std::string alternatives(std::span<const std::string> words);

/// Joins the words with a separator.
[[nodiscard]] std::string joined(std::span<const std::string> words, std::string_view separator);

/// Option that a sweep varies, and its values as texts, from low to high.
struct SweptOption {
    std::string name;
    std::vector<std::string> values;

    friend bool operator==(const SweptOption&, const SweptOption&) = default;
};

/// Grid of trials: every value of each option with every value of the others.
struct SweepPlan {
    std::vector<SweptOption> options;

    friend bool operator==(const SweepPlan&, const SweepPlan&) = default;

    [[nodiscard]] std::size_t trials() const {
        std::size_t trials = 1;
        for (const SweptOption& option : options)
            trials *= option.values.size();
        return trials;
    }
};

/// Returns the value of each option of the plan in each trial; the last option varies fastest.
[[nodiscard]] std::vector<std::vector<std::string>> sweep_values(const SweepPlan& plan);

/// Smallest side of a trial on a contact sheet whose caption is legible.
inline constexpr int min_trial_px = 400;

/// @param longest side of the sheet, in pixels @throws OptionError if it has no room for that many trials
void require_legible(std::size_t trials, int longest);

/// Returns the side of a sheet on which that many trials are legible, in pixels.
[[nodiscard]] int legible_side(std::size_t trials);

/// Parses "lod=1..6,min_area=10..60": numbers from the first to the last. Whole numbers are all taken if they
/// are six or fewer, otherwise six are spread evenly, as are fractions. A third number is the step
/// ("nf=5..60..5"); a single number is one value. @throws OptionError if the text is anything else, if an
/// option cannot vary, or if there are more than 400 trials
[[nodiscard]] SweepPlan parse_sweep(const std::string& text);

}  // namespace d2b
