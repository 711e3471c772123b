#include "core/system/text_number.hpp"

#include <cerrno>
#include <charconv>
#include <cstring>
#include <limits>
#include <system_error>

namespace d2b::system {
namespace {

/// Reads with std::from_chars(), which rounds correctly: strtod() of older systems does not.
template <class Number>
Number from_text(const char* text, char** end) {
    Number value = 0;
    const std::from_chars_result result = std::from_chars(text, text + std::strlen(text), value);
    *end = const_cast<char*>(result.ptr);  // NOLINT(cppcoreguidelines-pro-type-const-cast): as strtod() does
    if (result.ec == std::errc::result_out_of_range) {
        errno = ERANGE;
        return std::numeric_limits<Number>::infinity();
    }
    return value;
}

}  // namespace

double text_to_double(const char* text, char** end) {
    return from_text<double>(text, end);
}

float text_to_float(const char* text, char** end) {
    return from_text<float>(text, end);
}

}  // namespace d2b::system
