#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

namespace d2b {

/// Loads a library on first use and returns one of its functions.
/// @param library name for the dynamic linker @param function C name
/// @throws OutputError if the library or function does not exist
[[nodiscard]] void* late_function(const char* library, const char* function);

/// String literal as a template argument.
template <std::size_t size>
struct FixedText {
    // NOLINTNEXTLINE(modernize-avoid-c-arrays): that is what a literal is
    constexpr FixedText(const char (&text)[size]) { std::copy_n(text, size, bytes.begin()); }
    std::array<char, size> bytes{};
};

/// Function of Cairo or Pango that is resolved by the first call.
/// Cairo and Pango are not linked because they pull in many libraries, which would delay the start of every
/// run although few runs draw. Loading pangocairo is enough, because it depends on all other libraries that
/// are called here.
template <FixedText name, class Function>
class LateCall;

template <FixedText name, class Result, class... Values>
class LateCall<name, Result(Values...)> {
  public:
    /// @throws OutputError if Cairo or Pango is missing
    Result operator()(Values... values) const {
        static const auto function = reinterpret_cast<Result (*)(Values...)>(
            late_function("libpangocairo-1.0.so.0", name.bytes.data()));
        return function(values...);
    }
};

}  // namespace d2b

/// Declares a lazily resolved wrapper of a C function in namespace d2b, under its own name.
// NOLINTNEXTLINE(cppcoreguidelines-macro-usage,bugprone-macro-parentheses): nothing else makes text of a name
#define D2B_LATE_CALL(function) inline constexpr LateCall<#function, decltype(::function)> function
