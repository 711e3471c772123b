#include "preview/letters.hpp"

#include <algorithm>

namespace d2b {
namespace {

struct Letter {
    char name;
    std::array<std::uint8_t, letter_height> rows;
};

// clang-format off
constexpr std::array letters{
    Letter{'0', {7, 5, 5, 5, 7}},
    Letter{'1', {2, 6, 2, 2, 7}},
    Letter{'2', {7, 1, 7, 4, 7}},
    Letter{'3', {7, 1, 7, 1, 7}},
    Letter{'4', {5, 5, 7, 1, 1}},
    Letter{'5', {7, 4, 7, 1, 7}},
    Letter{'6', {7, 4, 7, 5, 7}},
    Letter{'7', {7, 1, 2, 2, 2}},
    Letter{'8', {7, 5, 7, 5, 7}},
    Letter{'9', {7, 5, 7, 1, 7}},
    Letter{'A', {2, 5, 7, 5, 5}},
    Letter{'B', {6, 5, 6, 5, 6}},
    Letter{'C', {3, 4, 4, 4, 3}},
    Letter{'D', {6, 5, 5, 5, 6}},
    Letter{'E', {7, 4, 6, 4, 7}},
    Letter{'F', {7, 4, 6, 4, 4}},
    Letter{'G', {3, 4, 5, 5, 3}},
    Letter{'H', {5, 5, 7, 5, 5}},
    Letter{'I', {7, 2, 2, 2, 7}},
    Letter{'J', {1, 1, 1, 5, 2}},
    Letter{'K', {5, 5, 6, 5, 5}},
    Letter{'L', {4, 4, 4, 4, 7}},
    Letter{'M', {5, 7, 7, 5, 5}},
    Letter{'N', {7, 5, 5, 5, 5}},
    Letter{'O', {2, 5, 5, 5, 2}},
    Letter{'P', {6, 5, 6, 4, 4}},
    Letter{'Q', {2, 5, 5, 6, 3}},
    Letter{'R', {6, 5, 6, 5, 5}},
    Letter{'S', {3, 4, 2, 1, 6}},
    Letter{'T', {7, 2, 2, 2, 2}},
    Letter{'U', {5, 5, 5, 5, 7}},
    Letter{'V', {5, 5, 5, 5, 2}},
    Letter{'W', {5, 5, 7, 7, 5}},
    Letter{'X', {5, 5, 2, 5, 5}},
    Letter{'Y', {5, 5, 2, 2, 2}},
    Letter{'Z', {7, 1, 2, 4, 7}},
    Letter{'.', {0, 0, 0, 0, 2}},
    Letter{',', {0, 0, 0, 2, 4}},
    Letter{'=', {0, 7, 0, 7, 0}},
    Letter{':', {0, 2, 0, 2, 0}},
    Letter{'-', {0, 0, 7, 0, 0}},
    Letter{'_', {0, 0, 0, 0, 7}},
    Letter{'/', {1, 1, 2, 4, 4}},
};
// clang-format on

}  // namespace

std::array<std::uint8_t, letter_height> letter_rows(char letter) {
    const char capital = letter >= 'a' && letter <= 'z' ? static_cast<char>(letter - 'a' + 'A') : letter;
    const auto found = std::ranges::find(letters, capital, &Letter::name);
    return found == letters.end() ? std::array<std::uint8_t, letter_height>{} : found->rows;
}

}  // namespace d2b
