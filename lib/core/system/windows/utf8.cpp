#include <cerrno>
#include <cstddef>
#include <cwchar>

// Makes std::filesystem::path convert from and to UTF-8. It asks mbrtowc() and wcrtomb() of the C library,
// whose locale "C" takes bytes for letters of Latin-1, and which has no locale with UTF-8 in older systems.
// The linker puts these functions in their place (--wrap). Letters that take two units of UTF-16 are refused,
// because these functions convert one at a time.

namespace {

constexpr std::size_t invalid = static_cast<std::size_t>(-1);
constexpr std::size_t incomplete = static_cast<std::size_t>(-2);

std::size_t refuse() {
    errno = EILSEQ;
    return invalid;
}

/// @return bytes of the letter that begins with this one, at most three; 0 if none does
std::size_t length_of(unsigned char first) {
    if (first < 0x80)
        return 1;
    if (first >= 0xC2 && first < 0xE0)
        return 2;
    return first >= 0xE0 && first < 0xF0 ? 3 : 0;
}

}  // namespace

// NOLINTBEGIN(bugprone-reserved-identifier,cert-dcl37-c,cert-dcl51-cpp): the linker makes the names
extern "C" std::size_t __wrap_mbrtowc(wchar_t* to, const char* from, std::size_t count,
                                      std::mbstate_t* /*state*/) {
    if (from == nullptr)
        return 0;
    if (count == 0)
        return incomplete;
    const auto first = static_cast<unsigned char>(*from);
    const std::size_t length = length_of(first);
    if (length == 0)
        return refuse();
    if (count < length)
        return incomplete;
    unsigned letter = length == 1 ? first : first & (0xFFU >> (length + 1));
    for (std::size_t i = 1; i < length; ++i) {
        const auto next = static_cast<unsigned char>(from[i]);
        if ((next & 0xC0U) != 0x80U)
            return refuse();
        letter = letter << 6U | (next & 0x3FU);
    }
    const bool surrogate = letter >= 0xD800U && letter < 0xE000U;
    if (surrogate || (length == 3 && letter < 0x800U))
        return refuse();
    if (to != nullptr)
        *to = static_cast<wchar_t>(letter);
    return letter == 0 ? 0 : length;
}

extern "C" std::size_t __wrap_wcrtomb(char* to, wchar_t letter, std::mbstate_t* /*state*/) {
    if (to == nullptr)
        return 1;
    const unsigned code = letter;
    if (code >= 0xD800U && code < 0xE000U)
        return refuse();
    if (code < 0x80U) {
        to[0] = static_cast<char>(code);
        return 1;
    }
    if (code < 0x800U) {
        to[0] = static_cast<char>(0xC0U | code >> 6U);
        to[1] = static_cast<char>(0x80U | (code & 0x3FU));
        return 2;
    }
    to[0] = static_cast<char>(0xE0U | code >> 12U);
    to[1] = static_cast<char>(0x80U | (code >> 6U & 0x3FU));
    to[2] = static_cast<char>(0x80U | (code & 0x3FU));
    return 3;
}
// NOLINTEND(bugprone-reserved-identifier,cert-dcl37-c,cert-dcl51-cpp)
