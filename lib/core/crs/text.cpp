#include "core/crs/text.hpp"

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <locale>
#include <sstream>

namespace d2b {

std::string quoted(std::string_view text) {
    constexpr std::size_t longest = 60;
    std::string result(text.substr(0, longest));
    std::replace_if(
        result.begin(), result.end(), [](unsigned char c) { return std::iscntrl(c) != 0; }, ' ');
    return "'" + result + (text.size() > longest ? "...'" : "'");
}

std::string position_text(const Position& p) {
    std::ostringstream text;
    text.imbue(std::locale::classic());
    text.precision(12);
    text << "(" << p.x << ", " << p.y << ")";
    return text.str();
}

std::string letters_and_digits(std::string_view text) {
    std::string result;
    for (const char c : text)
        if (std::isalnum(static_cast<unsigned char>(c)))
            result += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return result;
}

}  // namespace d2b
