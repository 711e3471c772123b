#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

namespace d2b {

/// A function of a library that is loaded when one of its functions is called for the first time.
/// @param library as the dynamic linker looks for it @param function its name in C
/// @throws OutputError where there is no such library or function
[[nodiscard]] void* late_function(const char* library, const char* function);

/// Text as an argument of a template.
template <std::size_t size>
struct FixedText {
    // NOLINTNEXTLINE(modernize-avoid-c-arrays): that is what a literal is
    constexpr FixedText(const char (&text)[size]) { std::copy_n(text, size, bytes.begin()); }
    std::array<char, size> bytes{};
};

/// Cairo and Pango bring many libraries along, for which every program would wait when it starts; few runs
/// draw. So they are not linked, but loaded by the first call. Pango's library for Cairo
/// needs all others that are called here, so that it finds their functions, too.
template <FixedText name, class Function>
class LateCall;

template <FixedText name, class Result, class... Values>
class LateCall<name, Result(Values...)> {
  public:
    /// @throws OutputError where Cairo or Pango are missing
    Result operator()(Values... values) const {
        static const auto function = reinterpret_cast<Result (*)(Values...)>(
            late_function("libpangocairo-1.0.so.0", name.bytes.data()));
        return function(values...);
    }
};

}  // namespace d2b

/// In the namespace d2b: calls of a function of C there, under its own name, are late ones.
// NOLINTNEXTLINE(cppcoreguidelines-macro-usage,bugprone-macro-parentheses): nothing else makes text of a name
#define D2B_LATE_CALL(function) inline constexpr LateCall<#function, decltype(::function)> function
