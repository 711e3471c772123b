#include "core/system/text_number.hpp"

#include <clocale>
#include <cstdlib>

#if __has_include(<xlocale.h>)
#include <xlocale.h>  // declares strtod_l on macOS and FreeBSD
#endif

namespace d2b::system {
namespace {

locale_t c_locale() {
    static const locale_t locale = ::newlocale(LC_ALL_MASK, "C", nullptr);
    return locale;
}

}  // namespace

double text_to_double(const char* text, char** end) {
    return ::strtod_l(text, end, c_locale());
}

float text_to_float(const char* text, char** end) {
    return ::strtof_l(text, end, c_locale());
}

}  // namespace d2b::system
