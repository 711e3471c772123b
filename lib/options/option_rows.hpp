#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/number_text.hpp"
#include "options/option_table.hpp"
#include "options/option_values.hpp"

/// How the rows of the option table are made; for the files option_rows_*.cpp alone.
namespace d2b::rows {

/// The rows of each group, in the order of the help.
[[nodiscard]] std::vector<OptionRow> input();
[[nodiscard]] std::vector<OptionRow> buildings();
[[nodiscard]] std::vector<OptionRow> levels();
[[nodiscard]] std::vector<OptionRow> contours();
[[nodiscard]] std::vector<OptionRow> output();
[[nodiscard]] std::vector<OptionRow> report();

/// What people read of an option.
struct Words {
    std::string help{};
    std::string details{};
    std::string unit{};
    std::vector<std::string> aliases{};
};

[[nodiscard]] OptionRow described(std::string name, std::string values, Words words);

// In all that follows `field` is a generic lambda from a Request, const or not, to a reference to the field
// that the option sets, so that a row cannot read one field and write another.

template <class Field>
OptionRow switch_row(std::string name, Field field, Words words) {
    OptionRow row = described(std::move(name), "", std::move(words));
    row.apply = [field](Request& request, OptionValues) { field(request) = true; };
    row.show = [field](const Request& request) { return std::string(field(request) ? "yes" : ""); };
    return row;
}

template <class Field>
OptionRow whole_row(std::string name, std::string values, NumberRange range, Field field, Words words) {
    OptionRow row = described(std::move(name), std::move(values), std::move(words));
    row.range = range.text("a whole number");
    row.numbers = range;
    row.apply = [field, range, name = row.name](Request& request, OptionValues texts) {
        field(request) = parse_whole(name, range, texts[0]);
    };
    row.show = [field](const Request& request) { return std::to_string(field(request)); };
    return row;
}

[[nodiscard]] inline std::string text_of(double value) {
    return number_text(value);
}
[[nodiscard]] inline std::string text_of(const std::optional<double>& value) {
    return value ? number_text(*value) : "";
}

template <class Field>
OptionRow number_row(std::string name, std::string values, NumberRange range, Field field, Words words) {
    OptionRow row = described(std::move(name), std::move(values), std::move(words));
    row.range = range.text("a number");
    row.numbers = range;
    row.apply = [field, range, name = row.name](Request& request, OptionValues texts) {
        field(request) = parse_number(name, range, texts[0]);
    };
    row.show = [field](const Request& request) { return text_of(field(request)); };
    return row;
}

using Two = std::array<double, 2>;
using Four = std::array<double, 4>;

/// Some numbers. @param range what they must be, as text @param fits the same as a function
template <std::size_t n, class Field>
OptionRow several_row(std::string name, std::string values, std::string range,
                      bool (*fits)(const std::array<double, n>&), Field field, Words words) {
    OptionRow row = described(std::move(name), std::move(values), std::move(words));
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
    row.show = [field](const Request& request) {
        const std::optional<std::array<double, n>>& numbers = field(request);
        return numbers ? numbers_text(*numbers, " ") : std::string();
    };
    return row;
}

template <class Field>
OptionRow text_row(std::string name, std::string values, Field field, Words words) {
    OptionRow row = described(std::move(name), std::move(values), std::move(words));
    row.apply = [field](Request& request, OptionValues texts) { field(request) = texts[0]; };
    row.show = [field](const Request& request) { return field(request); };
    return row;
}

/// The words of a choice and what they stand for.
template <class Value>
using Choices = std::vector<std::pair<std::string, Value>>;

/// One word out of a few.
template <class Value, class Field>
OptionRow choice_row(std::string name, std::string values, const Choices<Value>& choices, Field field,
                     Words words) {
    OptionRow row = described(std::move(name), std::move(values), std::move(words));
    std::vector<std::string_view> names;
    for (const auto& [word, value] : choices)
        names.push_back(word);
    row.range = alternatives(names);
    row.apply = [field, choices, name = row.name, range = row.range](Request& request, OptionValues texts) {
        for (const auto& [word, value] : choices) {
            if (word == texts[0]) {
                field(request) = value;
                return;
            }
        }
        refuse_value(name, range, texts[0]);
    };
    row.show = [field, choices](const Request& request) {
        for (const auto& [word, value] : choices)
            if (field(request) == value)
                return word;
        return std::string();
    };
    return row;
}

/// Texts that add up over repeated options. @param range "NAME=VALUE", or "" where any text will do
template <class Field>
OptionRow texts_row(std::string name, std::string values, std::string range, Field field, Words words) {
    OptionRow row = described(std::move(name), std::move(values), std::move(words));
    row.repeatable = true;
    row.range = std::move(range);
    row.apply = [field, name = row.name, text = row.range](Request& request, OptionValues texts) {
        const auto equals = texts[0].find('=');
        if (!text.empty() && (equals == 0 || equals == std::string::npos))
            refuse_value(name, text, texts[0]);
        field(request).push_back(texts[0]);
    };
    row.show = [field](const Request& request) {
        std::string all;
        for (const std::string& text : field(request))
            all += (all.empty() ? "" : " ") + text;
        return all;
    };
    return row;
}

}  // namespace d2b::rows
