#pragma once

#include <charconv>
#include <concepts>
#include <optional>
#include <string_view>
#include <system_error>

namespace d2b {

/// Like std::from_chars, independent of the locale. Needed because libc++ before LLVM 20 has it only for
/// integers.
std::from_chars_result number_from_chars(const char* first, const char* last, double& value);
std::from_chars_result number_from_chars(const char* first, const char* last, float& value);
template <std::integral Whole>
std::from_chars_result number_from_chars(const char* first, const char* last, Whole& value) {
    return std::from_chars(first, last, value);
}

/// Returns the number that a text is; nothing if it is more than a number, or one that is out of range.
template <typename Number>
[[nodiscard]] std::optional<Number> parse_number(std::string_view text) {
    Number value{};
    const char* const end = text.data() + text.size();
    const auto [stop, error] = number_from_chars(text.data(), end, value);
    return error == std::errc() && stop == end ? std::optional(value) : std::nullopt;
}

}  // namespace d2b
