#include "options/provenance_text.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstddef>
#include <sstream>
#include <string_view>
#include <vector>

#include "core/text.hpp"
#include "options/option_table.hpp"

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
    const std::string lower = to_lower(text);
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

bool is_plain(char letter) {
    constexpr std::string_view plain = "_-+=./:,@%";
    return std::isalnum(static_cast<unsigned char>(letter)) != 0 ||
           plain.find(letter) != std::string_view::npos;
}

/// Quotes a word for a shell.
std::string quoted(const std::string& word) {
    if (!word.empty() && std::ranges::all_of(word, is_plain))
        return word;
    std::string text = "'";
    for (const char letter : word)
        text += letter == '\'' ? std::string(R"('\'')") : std::string(1, letter);
    return text + "'";
}

/// Joins option and value by an equals sign if the value begins with a dash and is not a number, because it
/// would otherwise be parsed as an option.
std::string with_value(const std::string& option, const std::string& value) {
    const bool joins = value.starts_with('-') && !looks_like_number(value);
    return joins ? quoted(option + "=" + value) : option + " " + quoted(value);
}

/// Returns the last component of a path, or of a URL without its query.
std::string base_name(std::string name) {
    if (name.find("://") != std::string::npos)
        name = name.substr(0, name.find('?'));
    while (name.size() > 1 && name.ends_with('/'))
        name.pop_back();
    return name.substr(name.find_last_of('/') + 1);
}

bool names_a_file(OptionKind kind) {
    return kind == OptionKind::raster || kind == OptionKind::polygons || kind == OptionKind::dataset ||
           kind == OptionKind::terrain || kind == OptionKind::surface;
}

/// Guesses if a text option, which usually is not a path, names a file.
bool is_path(const std::string& text) {
    const std::array<std::string_view, 4> beginnings{"/", "./", "../", "~"};
    return text.find('/') != std::string::npos &&
           (std::ranges::any_of(beginnings,
                                [&](std::string_view begin) { return text.starts_with(begin); }) ||
            text.ends_with(".prj") || text.ends_with(".wkt"));
}

/// Strips folders from the value of an option, or from VALUE in NAME=VALUE.
std::string without_folder(const OptionRow& row, const std::string& text) {
    if (names_a_file(row.kind))
        return base_name(text);
    if (row.kind != OptionKind::text && row.kind != OptionKind::crs)
        return text;
    const std::size_t value = row.kind == OptionKind::text ? text.find('=') + 1 : 0;  // 0: the whole text
    return is_path(text.substr(value)) ? text.substr(0, value) + base_name(text.substr(value)) : text;
}

std::string words_of(const OptionRow& row, const Request& request, bool with_folders) {
    std::string option = "-" + row.name;
    std::vector<std::string> texts = row.texts(request);
    if (!with_folders)
        for (std::string& text : texts)
            text = without_folder(row, text);
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

/// Returns true for options of surfaces with -write_problems, because its points depend on the surfaces.
bool affects_problems(const OptionRow& row, const Options& options) {
    return options.write.problems && row.name.starts_with("surface");
}

std::string words_of(const Options& options, bool with_folders) {
    const Request request{options, {}};
    std::string words;
    for (const OptionRow& row : option_table())
        if ((row.repeats || affects_problems(row, options)) && row.is_given(request))
            words += (words.empty() ? "" : " ") + words_of(row, request, with_folders);
    return words;
}

bool names_several(const ReadOptions& options) {
    return options.source.find('\n') != std::string::npos;
}

std::string source_words(const ReadOptions& options, bool with_folders) {
    std::string words;
    std::istringstream names(options.source);
    for (std::string name; std::getline(names, name);)
        words += (words.empty() ? "" : " ") + quoted(with_folders ? name : base_name(name));
    return words;
}

}  // namespace

std::string redacted_destination(const std::string& destination) {
    return without_addresses(without_words(destination));
}

std::string source_text(const std::string& name, const ReadOptions& options) {
    return names_several(options) && name != options.source ? source_words(options, true) : name;
}

std::string reproducing_arguments(const Options& options) {
    return words_of(options, true);
}

std::map<std::string, std::string> strip_folders(std::map<std::string, std::string> metadata,
                                                 const Options& options) {
    for (auto& [name, value] : metadata) {
        if (name == "D2B_SOURCE")
            value = value == utf8_text(source_words(options.read, true)) && names_several(options.read)
                        ? utf8_text(source_words(options.read, false))
                        : base_name(value);
        if (name == "D2B_OPTIONS")
            value = utf8_text(words_of(options, false));
        for (const OptionRow& row : option_table())
            if (!row.item.empty() && name == "D2B_" + row.item)
                value = without_folder(row, value);
    }
    return metadata;
}

}  // namespace d2b
