#include "options/option_table.hpp"

#include <algorithm>
#include <iterator>

#include "dem2buildings/error.hpp"
#include "options/option_rows.hpp"

namespace d2b {
namespace {

void append(std::vector<OptionRow>& table, OptionGroup group, std::vector<OptionRow> rows) {
    const Request standard;
    for (OptionRow& row : rows) {
        row.group = group;
        row.standard = row.show(standard);
    }
    table.insert(table.end(), std::make_move_iterator(rows.begin()), std::make_move_iterator(rows.end()));
}

std::vector<OptionRow> make_table() {
    std::vector<OptionRow> table;
    append(table, OptionGroup::input, rows::input());
    append(table, OptionGroup::buildings, rows::buildings());
    append(table, OptionGroup::levels, rows::levels());
    append(table, OptionGroup::contours, rows::contours());
    append(table, OptionGroup::output, rows::output());
    append(table, OptionGroup::report, rows::report());
    return table;
}

[[noreturn]] void refuse_count(const OptionRow& row) {
    std::string needed = "a value";
    if (row.arity == Arity::list)
        needed = "at least one value";
    else if (row.arity == Arity::several)
        needed = std::to_string(row.count) + " values";
    throw OptionError("-" + row.name + " needs " + needed + ": " + option_synopsis(row) + ".");
}

}  // namespace

namespace rows {

OptionRow described(std::string name, std::string values, Words words) {
    OptionRow row;
    row.name = std::move(name);
    row.values = std::move(values);
    row.arity = row.values.empty() ? Arity::none : Arity::one;
    row.count = row.values.empty() ? 0 : 1;
    row.help = std::move(words.help);
    row.details = std::move(words.details);
    row.unit = std::move(words.unit);
    row.aliases = std::move(words.aliases);
    return row;
}

}  // namespace rows

const std::vector<OptionRow>& option_table() {
    static const std::vector<OptionRow> table = make_table();
    return table;
}

const OptionRow* find_option(std::string_view name) {
    for (int dash = 0; dash < 2 && name.starts_with('-'); ++dash)
        name.remove_prefix(1);
    const auto& table = option_table();
    const auto row = std::ranges::find_if(table, [name](const OptionRow& candidate) {
        return candidate.name == name ||
               std::ranges::find(candidate.aliases, name) != candidate.aliases.end();
    });
    return row == table.end() ? nullptr : &*row;
}

std::string option_synopsis(const OptionRow& row) {
    return "-" + row.name + (row.values.empty() ? "" : " ") + row.values;
}

void apply_option(const OptionRow& row, Request& request, OptionValues values) {
    if (row.arity == Arity::none && !values.empty())
        throw OptionError("-" + row.name + " takes no value.");
    const bool enough = row.arity == Arity::list ? values.size() >= row.count : values.size() == row.count;
    if (!enough || std::ranges::any_of(values, &std::string::empty))
        refuse_count(row);
    row.apply(request, values);
}

}  // namespace d2b
