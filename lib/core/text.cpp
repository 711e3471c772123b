#include "core/text.hpp"

namespace d2b {
namespace {

unsigned byte_at(std::string_view bytes, std::size_t i) {
    return static_cast<unsigned char>(bytes[i]);
}

/// Bytes allowed after the first byte of a character.
struct Continuation {
    std::size_t bytes = 0;  ///< number of them; 0 if the first byte does not begin a multi-byte character
    // Range of the second byte, narrowed to exclude overlong forms, surrogates and code points beyond
    // U+10FFFF.
    unsigned lowest = 0x80;
    unsigned highest = 0xBF;
};

Continuation continuation_of(unsigned first) {
    if (first >= 0xC2 && first <= 0xDF)
        return {1};
    if (first >= 0xE0 && first <= 0xEF)
        return {2, first == 0xE0 ? 0xA0U : 0x80U, first == 0xED ? 0x9FU : 0xBFU};
    if (first >= 0xF0 && first <= 0xF4)
        return {3, first == 0xF0 ? 0x90U : 0x80U, first == 0xF4 ? 0x8FU : 0xBFU};
    return {};
}

}  // namespace

std::string utf8_text(std::string_view bytes) {
    constexpr std::string_view replacement = "\xEF\xBF\xBD";
    std::string text;
    text.reserve(bytes.size());
    for (std::size_t i = 0; i < bytes.size();) {
        const unsigned first = byte_at(bytes, i);
        auto [more, lowest, highest] = continuation_of(first);
        std::size_t end = i + 1;
        for (; more > 0 && end < bytes.size(); --more, ++end) {
            const unsigned next = byte_at(bytes, end);
            if (next < lowest || next > highest)
                break;
            lowest = 0x80;
            highest = 0xBF;
        }
        const bool whole = first < 0x80 || (end > i + 1 && more == 0);
        text += whole ? bytes.substr(i, end - i) : replacement;
        i = end;
    }
    return text;
}

}  // namespace d2b
