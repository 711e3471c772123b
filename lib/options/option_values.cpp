#include "options/option_values.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <system_error>

#include "core/number_from_chars.hpp"
#include "core/number_text.hpp"
#include "dem2buildings/error.hpp"

namespace d2b {
namespace {

/// number_from_chars() rejects a plus sign, which atof, and therefore every GDAL tool, accepts.
std::string_view without_plus(std::string_view text) {
    if (text.size() > 1 && text[0] == '+' && text[1] != '-')
        text.remove_prefix(1);
    return text;
}

template <class Number>
std::optional<Number> parse_all(std::string_view text) {
    text = without_plus(text);
    Number value{};
    const char* const end = text.data() + text.size();
    const auto [stop, error] = number_from_chars(text.data(), end, value);
    if (error != std::errc() || stop != end)
        return std::nullopt;
    return value;
}

}  // namespace

bool NumberRange::holds(double value) const {
    return std::isfinite(value) && (above_lowest ? value > lowest : value >= lowest) && value <= highest;
}

std::string NumberRange::text(std::string_view noun) const {
    std::string text(noun);
    if (std::isinf(lowest))
        return text;
    if (!std::isinf(highest) && above_lowest)
        return text + " above " + number_text(lowest) + " and at most " + number_text(highest);
    if (!std::isinf(highest))
        return text + " from " + number_text(lowest) + " to " + number_text(highest);
    return text + (above_lowest ? " above " : " of at least ") + number_text(lowest);
}

void refuse_value(std::string_view name, std::string_view range, std::string_view text) {
    throw OptionError("-" + std::string(name) + " must be " + std::string(range) + ", not '" +
                      std::string(text) + "'.");
}

bool looks_like_number(std::string_view text) {
    text = without_plus(text);
    double value = 0;
    const char* const end = text.data() + text.size();
    const auto [stop, error] = number_from_chars(text.data(), end, value);
    return error != std::errc::invalid_argument && stop == end;
}

std::optional<double> read_number(const NumberRange& range, std::string_view text) {
    const auto value = parse_all<double>(text);
    return value && range.holds(*value) ? value : std::nullopt;
}

double parse_number(std::string_view name, const NumberRange& range, std::string_view text) {
    const auto value = read_number(range, text);
    if (!value)
        refuse_value(name, range.text("a number"), text);
    return *value;
}

int parse_whole(std::string_view name, const NumberRange& range, std::string_view text) {
    const auto value = parse_all<int>(text);
    if (!value || !range.holds(*value))
        refuse_value(name, range.text("a whole number"), text);
    return *value;
}

std::string alternatives(std::span<const std::string> words) {
    std::string text;
    for (std::size_t i = 0; i < words.size(); ++i) {
        if (i > 0)
            text += i + 1 == words.size() ? " or " : ", ";
        text += words[i];
    }
    return text;
}

std::string joined(std::span<const std::string> words, std::string_view separator) {
    std::string text;
    for (std::size_t i = 0; i < words.size(); ++i)
        text += (i == 0 ? std::string() : std::string(separator)) + words[i];
    return text;
}

}  // namespace d2b
