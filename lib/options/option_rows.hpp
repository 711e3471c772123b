#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/text.hpp"
#include "options/option_table.hpp"
#include "options/option_values.hpp"

/// Builders for the rows of the option table. Only for option_rows_*.cpp.
namespace d2b::rows {

using Texts = std::vector<std::string>;

/// Rows of each group, in the order of the help.
[[nodiscard]] std::vector<OptionRow> input();
[[nodiscard]] std::vector<OptionRow> buildings();
[[nodiscard]] std::vector<OptionRow> levels();
[[nodiscard]] std::vector<OptionRow> contours();
[[nodiscard]] std::vector<OptionRow> output();
[[nodiscard]] std::vector<OptionRow> report();

enum class Python { none, extract_file, everywhere };

/// Properties of a row apart from its name, its values and the field that they set.
struct RowProperties {
    std::string title{};
    DialogSection section = DialogSection::advanced;
    bool everyday = false;
    std::string help{};
    std::string details{};
    std::string unit{};
    std::vector<std::string> aliases{};
    Texts choice_titles{};  ///< one per word of a choice; the words if empty
    PresetScope scope{};
    Python python = Python::everywhere;
    std::string python_name{};  ///< if Python cannot spell the name, or has a better one
    bool repeats = true;
    std::string item{};
};

[[nodiscard]] OptionRow make_row(std::string name, OptionKind kind, std::string values,
                                 RowProperties columns);

/// Scope of options that need building detection. @param elsewhere value that switches the option off; "" if
/// there is none
[[nodiscard]] PresetScope detection_scope(std::string elsewhere = "");

// Below, `field` is a generic lambda from a (const) Request to a reference to the field that the option sets,
// so that a row cannot read one field and write another.

template <class Field>
OptionRow switch_row(std::string name, Field field, RowProperties columns) {
    OptionRow row = make_row(std::move(name), OptionKind::toggle, "", std::move(columns));
    row.apply = [field](Request& request, OptionValues) { field(request) = true; };
    row.texts = [field](const Request& request) { return field(request) ? Texts{"yes"} : Texts{}; };
    return row;
}

template <class Field>
OptionRow integer_row(std::string name, std::string values, NumberRange range, Field field,
                      RowProperties columns) {
    OptionRow row = make_row(std::move(name), OptionKind::whole, std::move(values), std::move(columns));
    row.range = range.text("a whole number");
    row.numbers = range;
    row.apply = [field, range, name = row.name](Request& request, OptionValues texts) {
        field(request) = parse_integer(name, range, texts[0]);
    };
    row.texts = [field](const Request& request) { return Texts{std::to_string(field(request))}; };
    return row;
}

[[nodiscard]] inline Texts texts_of(double value) {
    return {number_text(value)};
}
[[nodiscard]] inline Texts texts_of(const std::optional<double>& value) {
    return value ? texts_of(*value) : Texts{};
}

template <class Field>
OptionRow number_row(std::string name, std::string values, NumberRange range, Field field,
                     RowProperties columns) {
    OptionRow row = make_row(std::move(name), OptionKind::number, std::move(values), std::move(columns));
    row.range = range.text("a number");
    row.numbers = range;
    row.apply = [field, range, name = row.name](Request& request, OptionValues texts) {
        field(request) = parse_number(name, range, texts[0]);
    };
    row.texts = [field](const Request& request) { return texts_of(field(request)); };
    return row;
}

using Two = std::array<double, 2>;
using Three = std::array<double, 3>;
using Four = std::array<double, 4>;

/// Row of an option with several numbers. @param range constraint as text @param fits the constraint as a
/// function
template <std::size_t n, class Field>
OptionRow several_row(std::string name, OptionKind kind, std::string values, std::string range,
                      bool (*fits)(const std::array<double, n>&), Field field, RowProperties columns) {
    OptionRow row = make_row(std::move(name), kind, std::move(values), std::move(columns));
    row.arity = Arity::several;
    row.count = n;
    row.range = std::move(range);
    row.apply = [field, fits, name = row.name, text = row.range](Request& request, OptionValues texts) {
        std::array<double, n> numbers{};
        std::string all;
        for (std::size_t i = 0; i < n; ++i) {
            numbers[i] = read_number({}, texts[i]).value_or(std::numeric_limits<double>::quiet_NaN());
            all += (i == 0 ? "" : " ") + texts[i];
        }
        if (std::ranges::any_of(numbers, [](double value) { return std::isnan(value); }) || !fits(numbers))
            refuse_value(name, text, all);
        field(request) = numbers;
    };
    row.texts = [field](const Request& request) {
        const std::optional<std::array<double, n>>& numbers = field(request);
        Texts texts;
        if (numbers)
            std::ranges::transform(*numbers, std::back_inserter(texts), number_text);
        return texts;
    };
    return row;
}

template <class Field>
OptionRow text_row(std::string name, OptionKind kind, std::string values, Field field,
                   RowProperties columns) {
    OptionRow row = make_row(std::move(name), kind, std::move(values), std::move(columns));
    row.apply = [field](Request& request, OptionValues texts) { field(request) = texts[0]; };
    row.texts = [field](const Request& request) {
        return field(request).empty() ? Texts{} : Texts{field(request)};
    };
    return row;
}

/// Words of a choice and their values.
template <class Value>
using Choices = std::vector<std::pair<std::string, Value>>;

template <class Value>
[[nodiscard]] Texts words_of(const Choices<Value>& choices) {
    Texts words;
    for (const auto& [word, value] : choices)
        words.push_back(word);
    return words;
}

/// Returns the value of a word, or nothing if it is not a choice.
template <class Value>
[[nodiscard]] std::optional<Value> choice_of(const Choices<Value>& choices, const std::string& text) {
    for (const auto& [word, value] : choices)
        if (word == text)
            return value;
    return std::nullopt;
}

/// Returns the word for a value, or nothing if there is none. @param chosen a value, which may be optional
template <class Value, class Chosen>
[[nodiscard]] Texts word_for(const Choices<Value>& choices, const Chosen& chosen) {
    for (const auto& [word, value] : choices)
        if (chosen == value)
            return {word};
    return {};
}

/// Row of an option that takes one of a few words, in capital or small letters.
template <class Value, class Field>
OptionRow choice_row(std::string name, const Choices<Value>& choices, Field field, RowProperties columns) {
    const Texts words = words_of(choices);
    OptionRow row = make_row(std::move(name), OptionKind::choice, joined(words, "|"), std::move(columns));
    row.choices = words;
    row.range = alternatives(words);
    row.apply = [field, choices, name = row.name, range = row.range](Request& request, OptionValues texts) {
        const auto found = std::ranges::find_if(
            choices, [&](const auto& choice) { return to_lower(choice.first) == to_lower(texts[0]); });
        if (found == choices.end())
            refuse_value(name, range, texts[0]);
        field(request) = found->second;
    };
    row.texts = [field, choices](const Request& request) { return word_for(choices, field(request)); };
    return row;
}

/// Row of a repeatable option whose texts accumulate. @param range "NAME=VALUE", or "" if any text is valid
template <class Field>
OptionRow list_row(std::string name, std::string values, std::string range, Field field,
                   RowProperties columns) {
    OptionRow row = make_row(std::move(name), OptionKind::text, std::move(values), std::move(columns));
    row.repeatable = true;
    row.range = std::move(range);
    row.apply = [field, name = row.name, text = row.range](Request& request, OptionValues texts) {
        const auto equals = texts[0].find('=');
        if (!text.empty() && (equals == 0 || equals == std::string::npos))
            refuse_value(name, text, texts[0]);
        field(request).push_back(texts[0]);
    };
    row.texts = [field](const Request& request) { return field(request); };
    return row;
}

}  // namespace d2b::rows
