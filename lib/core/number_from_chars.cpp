#include "core/number_from_chars.hpp"

#include <cerrno>
#include <cmath>
#include <string>
#include <system_error>

#include "core/system/text_number.hpp"

namespace d2b {
namespace {

bool is_digit(char c) {
    return c >= '0' && c <= '9';
}

/// Returns the part to pass to strtod, which unlike std::from_chars also accepts white space, a plus sign and
/// hexadecimal digits.
std::string decimal_text(const char* first, const char* last) {
    const char* const sign_end = first != last && *first == '-' ? first + 1 : first;
    if (sign_end == last)
        return {};
    const auto letter = static_cast<char>(*sign_end | 0x20);
    if (!is_digit(*sign_end) && *sign_end != '.' && letter != 'i' && letter != 'n')
        return {};
    const bool hexadecimal = *sign_end == '0' && last - sign_end > 1 && (sign_end[1] | 0x20) == 'x';
    return {first, hexadecimal ? sign_end + 1 : last};
}

template <class Number, class Read>
std::from_chars_result parse(const char* first, const char* last, Number& value, Read read) {
    const std::string text = decimal_text(first, last);
    char* end = nullptr;
    errno = 0;
    const Number number = read(text.c_str(), &end);
    if (end == text.c_str())
        return {first, std::errc::invalid_argument};
    const char* const stop = first + (end - text.c_str());
    // strtod also sets ERANGE for subnormal numbers, although it reads them.
    if (errno == ERANGE && (number == 0 || std::isinf(number)))
        return {stop, std::errc::result_out_of_range};
    value = number;
    return {stop, std::errc()};
}

}  // namespace

std::from_chars_result number_from_chars(const char* first, const char* last, double& value) {
    return parse(first, last, value, system::text_to_double);
}

std::from_chars_result number_from_chars(const char* first, const char* last, float& value) {
    return parse(first, last, value, system::text_to_float);
}

}  // namespace d2b
