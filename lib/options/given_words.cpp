#include "options/given_words.hpp"

#include <algorithm>
#include <cctype>
#include <string_view>

#include "options/option_table.hpp"

namespace d2b {
namespace {

bool is_plain(char letter) {
    constexpr std::string_view plain = "_-+=./:,@%";
    return std::isalnum(static_cast<unsigned char>(letter)) != 0 ||
           plain.find(letter) != std::string_view::npos;
}

/// A word of a shell.
std::string quoted(const std::string& word) {
    if (!word.empty() && std::ranges::all_of(word, is_plain))
        return word;
    std::string text = "'";
    for (const char letter : word)
        text += letter == '\'' ? std::string(R"('\'')") : std::string(1, letter);
    return text + "'";
}

/// What begins with a dash and is no number is a value only where an equals sign joins it to its option.
std::string with_value(const std::string& option, const std::string& value) {
    const bool joins = value.starts_with('-') && !looks_like_number(value);
    return joins ? quoted(option + "=" + value) : option + " " + quoted(value);
}

std::string words_of(const OptionRow& row, const Request& request) {
    std::string option = "-" + row.name;
    const std::vector<std::string> texts = row.texts(request);
    switch (row.arity) {
        case Arity::none:
            return option;
        case Arity::several:
        case Arity::list:
            return option + " " + joined(texts, " ");
        case Arity::one:
            break;
    }
    std::string words;
    for (const std::string& text : texts)
        words += (words.empty() ? "" : " ") + with_value(option, text);
    return words;
}

}  // namespace

std::string given_words(const Options& options) {
    const Request request{options, {}};
    std::string words;
    for (const OptionRow& row : option_table())
        if (row.repeats && row.is_given(request))
            words += (words.empty() ? "" : " ") + words_of(row, request);
    return words;
}

}  // namespace d2b
