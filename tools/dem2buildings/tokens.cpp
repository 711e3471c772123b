#include "dem2buildings/tokens.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

#include <boost/make_shared.hpp>
#include <boost/program_options.hpp>

#include "common/tool_line.hpp"
#include "dem2buildings/error.hpp"
#include "options/gdal_contour_options.hpp"
#include "options/option_checks.hpp"
#include "options/option_values.hpp"

namespace d2b {
namespace {

namespace po = boost::program_options;
using Strings = std::vector<std::string>;

/// Recognises values of -fl. MIN and MAX, which gdal_contour knows, count because they are refused by name.
bool looks_like_level(const std::string& token) {
    return looks_like_number(token) || token == "MIN" || token == "MAX";
}

po::options_description describe_options() {
    po::options_description description;
    for (const OptionRow& row : option_table()) {
        Strings names = row.aliases;
        names.push_back(row.name);
        // An entry for every name: as the last of several, a single letter would become a short option.
        for (const std::string& name : names) {
            // One value is the least of every option that has any; take_several() sees to the others. Told of
            // more, Boost would let an option take the file names behind it.
            const po::value_semantic* semantic = nullptr;  // owned by the description
            if (row.arity == Arity::none)
                semantic = new po::untyped_value(true);
            else
                semantic = po::value<std::string>();
            description.add(
                boost::make_shared<po::option_description>(name.c_str(), semantic, row.help.c_str()));
        }
    }
    return description;
}

/// Takes an option of several values, and these, off the front of the arguments. Boost's own rule, to take
/// all that comes, would take the file names too.
std::vector<po::option> take_several(Strings& arguments) {
    if (!looks_like_option(arguments[0]))
        return {};
    const auto [name, joined] = split_name(arguments[0]);
    const OptionRow* const row = find_option(name);
    if (row == nullptr || (row->arity != Arity::several && row->arity != Arity::list))
        return {};
    po::option option;
    option.string_key = name;
    if (!joined.empty())
        option.value.push_back(joined.substr(1));
    std::size_t taken = 1;
    const auto fits = [&](const std::string& token) {
        return row->arity == Arity::list ? looks_like_level(token)
                                         : option.value.size() < row->count && !looks_like_option(token);
    };
    for (; taken < arguments.size() && fits(arguments[taken]); ++taken)
        option.value.push_back(arguments[taken]);
    option.original_tokens.assign(arguments.begin(), arguments.begin() + static_cast<std::ptrdiff_t>(taken));
    arguments.erase(arguments.begin(), arguments.begin() + static_cast<std::ptrdiff_t>(taken));
    return {option};
}

/// An error of Boost's in our words. It comes where a switch has a value or an option has none.
[[noreturn]] void refuse_syntax(const po::invalid_command_line_syntax& error) {
    const std::string token = error.get_option_name();  // "--nln" or "--nln="
    const OptionRow* const row = find_option(split_name(token).first);
    if (row == nullptr)
        refuse_unknown_option(token);
    Request unused;
    const Strings joined(row->arity == Arity::none ? 1 : 0);
    apply_option(*row, unused, joined);
    throw OptionError(error.what());
}

std::vector<po::option> parse(const Strings& arguments) {
    // Boost takes "-=x" for the beginning of every name there is.
    for (const std::string& argument : arguments)
        if (argument.starts_with("-=") || argument.starts_with("--="))
            throw OptionError("An option has no name before its =; dem2buildings --help_all lists all.");
    namespace style = po::command_line_style;
    const po::options_description description = describe_options();
    po::command_line_parser parser(arguments);
    parser.options(description).extra_style_parser(take_several).allow_unregistered();
    parser.style(style::allow_long | style::long_allow_adjacent | style::long_allow_next |
                 style::allow_long_disguise);
    try {
        return parser.run().options;
    } catch (const po::invalid_command_line_syntax& error) {
        refuse_syntax(error);
    }
}

void sort_out(const po::option& parsed, Tokens& tokens) {
    if (parsed.unregistered) {
        tokens.unknown.push_back(parsed.original_tokens.front());
    } else if (!parsed.string_key.empty()) {
        GivenOption given{find_option(parsed.string_key), parsed.value};
        const bool separate = parsed.original_tokens.size() > 1;
        if (separate && looks_like_option(given.values.front()))
            given.values.clear();  // the next option is no value
        tokens.options.push_back(std::move(given));
    } else {
        const std::string& token = parsed.value.front();
        const bool option = token.size() > 1 && token[0] == '-';
        (option ? tokens.unknown : tokens.file_names).push_back(token);
    }
}

}  // namespace

Tokens split_tokens(std::vector<std::string> arguments) {
    const auto end = std::ranges::find(arguments, "--");
    const Strings behind(end == arguments.end() ? end : end + 1, arguments.end());
    arguments.erase(end, arguments.end());
    Tokens tokens;
    for (const po::option& parsed : parse(arguments))
        sort_out(parsed, tokens);
    tokens.file_names.insert(tokens.file_names.end(), behind.begin(), behind.end());
    return tokens;
}

void refuse_unknown_option(const std::string& token) {
    const std::string name = split_name(token).first;
    if (const std::string refusal = gdal_contour_refusal(name); !refusal.empty())
        throw OptionError(refusal);
    // GDAL's own switches were taken before; they need two dashes.
    Strings candidates{"-config", "-debug", "-formats", "-format", "-optfile", "-help-general"};
    for (const OptionRow& row : option_table()) {
        if (row.hidden)
            continue;
        candidates.push_back(row.name);
        candidates.insert(candidates.end(), row.aliases.begin(), row.aliases.end());
    }
    const std::string near = nearest_name(name, candidates);
    throw OptionError(
        "There is no option " + token.substr(0, token.find('=')) +
        (near.empty() ? "; dem2buildings --help_all lists all." : "; did you mean -" + near + "?"));
}

}  // namespace d2b
