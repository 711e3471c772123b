#include "diagnose/words.hpp"

#include <cmath>

#include "core/number_text.hpp"

namespace d2b {

std::string rounded(double value) {
    constexpr double whole_from = 10;
    return number_text(std::abs(value) < whole_from ? std::round(value * 10) / 10 : std::round(value));
}

std::string percent(double share) {
    constexpr double whole_from = 0.02;
    constexpr double least = 0.001;
    if (share > 0 && share < least)
        return "less than 0.1 %";
    return (share < whole_from ? rounded(share * 100) : number_text(std::round(share * 100))) + " %";
}

std::string as_sentence(std::string cause) {
    if (!cause.empty() && cause.front() >= 'a' && cause.front() <= 'z')
        cause.front() = static_cast<char>(cause.front() - 'a' + 'A');
    return cause + ".";
}

}  // namespace d2b
