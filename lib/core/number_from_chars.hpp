#pragma once

#include <charconv>
#include <concepts>

namespace d2b {

/// Like std::from_chars, independent of the locale. Needed because libc++ before LLVM 20 has it only for
/// integers.
std::from_chars_result number_from_chars(const char* first, const char* last, double& value);
std::from_chars_result number_from_chars(const char* first, const char* last, float& value);
template <std::integral Whole>
std::from_chars_result number_from_chars(const char* first, const char* last, Whole& value) {
    return std::from_chars(first, last, value);
}

}  // namespace d2b
