#include "options/option_table.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

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

OptionRow make_row(std::string name, OptionKind kind, std::string values, RowProperties columns) {
    OptionRow row;
    row.name = std::move(name);
    row.kind = kind;
    row.values = std::move(values);
    row.arity = row.values.empty() ? Arity::none : Arity::one;
    row.count = row.values.empty() ? 0 : 1;
    row.title = std::move(columns.title);
    row.section = columns.section;
    row.everyday = columns.everyday;
    row.help = std::move(columns.help);
    row.details = std::move(columns.details);
    row.unit = std::move(columns.unit);
    row.aliases = std::move(columns.aliases);
    row.choice_titles = std::move(columns.choice_titles);
    row.scope = std::move(columns.scope);
    if (columns.python != Python::none)
        row.python = {columns.python_name.empty() ? row.name : std::move(columns.python_name),
                      columns.python == Python::everywhere, true};
    row.repeats = columns.repeats;
    row.item = std::move(columns.item);
    return row;
}

PresetScope detection_scope(std::string elsewhere) {
    return {{Preset::buildings}, std::move(elsewhere), "it detects no buildings, so leave one of them out"};
}

}  // namespace rows

std::string OptionRow::show(const Request& request) const {
    return joined(texts(request), " ");
}

bool OptionRow::is_given(const Request& request) const {
    return request.options.given.contains(name) || show(request) != standard;
}

bool OptionRow::has_meaning(Preset preset) const {
    return std::ranges::find(scope.presets, preset) != scope.presets.end();
}

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
    request.options.given.insert(row.name);
}

void set_option(Options& options, std::string_view name, const std::vector<std::string>& values) {
    const OptionRow* const row = find_option(name);
    if (row == nullptr)
        throw OptionError("There is no option '" + std::string(name) +
                          "'; docs/reference/options.md lists all.");
    Request request{options, {}};
    apply_option(*row, request, values);
    if (request.tool != ToolOptions{})
        throw OptionError("-" + row->name + " is of the program alone; leave it out.");
    options = std::move(request.options);
}

}  // namespace d2b
