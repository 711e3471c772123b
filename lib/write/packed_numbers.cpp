#include "write/packed_numbers.hpp"

#include <array>
#include <charconv>
#include <cstddef>
#include <memory>

#include <cpl_conv.h>
#include <cpl_string.h>

#include "dem2buildings/error.hpp"

namespace d2b {

void PackedNumbers::put(std::uint64_t number) {
    for (; number >= 0x80; number >>= 7U)
        bytes_ += static_cast<char>((number & 0x7FU) | 0x80U);
    bytes_ += static_cast<char>(number);
}

void PackedNumbers::put_signed(std::int64_t number) {
    const auto bits = static_cast<std::uint64_t>(number);
    put(number < 0 ? ~(bits << 1U) : bits << 1U);
}

std::string deflated(std::string_view bytes) {
    constexpr int smallest = 9;
    std::size_t size = 0;
    const std::unique_ptr<void, decltype(&VSIFree)> packed(
        CPLZLibDeflate(bytes.data(), bytes.size(), smallest, nullptr, 0, &size), &VSIFree);
    if (!packed)
        throw OutputError("There is no memory to pack the page; use a smaller window (-te).");
    return {static_cast<const char*>(packed.get()), size};
}

std::string base64(std::string_view bytes) {
    constexpr std::string_view letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    text.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        std::uint32_t three = 0;
        for (std::size_t k = i; k < i + 3; ++k)
            three = three << 8U | (k < bytes.size() ? static_cast<unsigned char>(bytes[k]) : 0U);
        for (std::size_t k = 0; k < 4; ++k)
            text += i + k > bytes.size() ? '=' : letters[three >> (18 - 6 * k) & 0x3FU];
    }
    return text;
}

std::string bytes_of_hex(std::string_view digits) {
    std::string bytes;
    for (std::size_t i = 0; i + 1 < digits.size(); i += 2) {
        unsigned byte = 0;
        std::from_chars(digits.data() + i, digits.data() + i + 2, byte, 16);
        bytes += static_cast<char>(byte);
    }
    return bytes;
}

}  // namespace d2b
