#pragma once

namespace d2b::system {

/// strtod() with a decimal point in any locale.
[[nodiscard]] double text_to_double(const char* text, char** end);
/// strtof() with a decimal point in any locale.
[[nodiscard]] float text_to_float(const char* text, char** end);

}  // namespace d2b::system
