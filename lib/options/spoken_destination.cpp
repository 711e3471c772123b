#include "options/spoken_destination.hpp"

#include <algorithm>
#include <cctype>
#include <string_view>

namespace d2b {
namespace {

constexpr std::string_view blank = " \t\n\v\f\r";

/// Returns the end of a word: after its closing quote, otherwise before a blank.
std::size_t end_of_word(std::string_view text, std::size_t begin) {
    if (begin < text.size() && (text[begin] == '\'' || text[begin] == '"'))
        if (const std::size_t quote = text.find(text[begin], begin + 1); quote != std::string_view::npos)
            return quote + 1;
    return std::min(text.find_first_of(blank, begin), text.size());
}

std::string without_words(const std::string& text) {
    constexpr std::string_view key = "password=";
    std::string lower = text;
    std::ranges::transform(lower, lower.begin(),
                           [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    std::string result;
    std::size_t done = 0;
    for (std::size_t at = lower.find(key); at != std::string::npos; at = lower.find(key, done)) {
        result += text.substr(done, at + key.size() - done) + "...";
        done = end_of_word(text, at + key.size());
    }
    return result + text.substr(done);
}

/// Redacts passwords in URLs such as postgresql://user:password@host.
std::string without_addresses(const std::string& text) {
    std::string result;
    std::size_t done = 0;
    for (std::size_t at = text.find("://"); at != std::string::npos; at = text.find("://", at + 1)) {
        if (at < done)
            continue;
        const std::size_t colon = text.find_first_of(":@/ \t\n\v\f\r", at + 3);
        if (colon == std::string::npos || text[colon] != ':')
            continue;
        const std::size_t end = text.find_first_of("@ \t\n\v\f\r", colon + 1);
        if (end == std::string::npos || text[end] != '@')
            continue;
        result += text.substr(done, colon + 1 - done) + "...";
        done = end;
    }
    return result + text.substr(done);
}

}  // namespace

std::string spoken_destination(const std::string& destination) {
    return without_addresses(without_words(destination));
}

}  // namespace d2b
