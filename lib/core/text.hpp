#pragma once

#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <string>
#include <string_view>

namespace d2b {

/// Rounds a length, area or volume to hundredths, because the data carry no more: a centimetre in a metre.
/// NaN stays NaN.
[[nodiscard]] inline double round_to_hundredths(double value) {
    return std::round(value * 100) / 100;
}

/// Rounds a share down to two digits, so that a share below a bound of two digits stays below it.
[[nodiscard]] inline double floor_to_hundredths(double share) {
    constexpr double slack = 1e-9;  // 0.29 * 100 is less than 29
    return std::floor(share * 100 + slack) / 100;
}

/// Returns the shortest decimal text that reads back as the same number, independent of the locale; integers
/// below 1e15 without an exponent.
[[nodiscard]] inline std::string number_text(double value) {
    if (value == std::floor(value) && std::abs(value) < 1e15)
        return std::to_string(static_cast<long long>(value));
    std::array<char, 32> buffer{};
    const auto [end, error] = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value);
    return {buffer.data(), end};
}

/// Formats with a fixed number of digits after the point, independent of the locale.
[[nodiscard]] inline std::string fixed_text(double value, int digits) {
    std::array<char, 400> buffer{};  // the longest double has some 310 digits before the point
    const auto [end, error] =
        std::to_chars(buffer.data(), buffer.data() + buffer.size(), value, std::chars_format::fixed, digits);
    return {buffer.data(), end};
}

/// Joins numbers with `separator`.
template <std::size_t n>
[[nodiscard]] std::string numbers_text(const std::array<double, n>& values, const char* separator) {
    std::string text;
    for (const double value : values)
        text += (text.empty() ? "" : separator) + number_text(value);
    return text;
}

/// Converts ASCII letters to lower case, independent of the locale.
[[nodiscard]] inline std::string to_lower(std::string_view text) {
    std::string result(text);
    for (char& letter : result)
        if (letter >= 'A' && letter <= 'Z')
            letter = static_cast<char>(letter - 'A' + 'a');
    return result;
}

/// Converts to valid UTF-8, because file names may be any bytes while tables, XML and JSON hold only
/// characters. Each maximal truncated sequence, and each other invalid byte, becomes U+FFFD, as Unicode
/// recommends.
[[nodiscard]] std::string utf8_text(std::string_view bytes);

}  // namespace d2b
