#include "dem2buildings_score/command_line.hpp"

#include <algorithm>
#include <optional>
#include <set>
#include <string_view>

#include <boost/make_shared.hpp>
#include <boost/program_options.hpp>

#include "dem2buildings/error.hpp"
#include "options/option_checks.hpp"
#include "options/option_values.hpp"

namespace d2b {
namespace {

namespace po = boost::program_options;

constexpr std::string_view usage = "usage: dem2buildings_score [options] <found> <reference>";

/// "--dem=x" to "dem".
std::string name_of(const std::string& token) {
    const std::size_t first = token.starts_with("--") ? 2 : 1;
    return token.substr(first, std::min(token.find('='), token.size()) - first);
}

const ScoreOption* find(const std::string& name) {
    const auto& options = score_options();
    const auto found = std::ranges::find(options, name, &ScoreOption::name);
    return found == options.end() ? nullptr : &*found;
}

[[noreturn]] void refuse_unknown(const std::string& token) {
    std::vector<std::string> names{"-config", "-debug", "-formats", "-format", "-optfile", "-help-general"};
    for (const ScoreOption& option : score_options())
        names.push_back(option.name);
    const std::string near = nearest_name(name_of(token), names);
    throw OptionError(
        "There is no option " + token.substr(0, token.find('=')) +
        (near.empty() ? "; dem2buildings_score --help lists all." : "; did you mean -" + near + "?"));
}

/// Boost refuses a switch with a value and an option without one.
[[noreturn]] void refuse_syntax(const std::string& token) {
    const ScoreOption* const option = find(name_of(token));
    if (option == nullptr)
        refuse_unknown(token);
    if (option->value.empty())
        throw OptionError("-" + option->name + " is a switch and takes no value.");
    throw OptionError("-" + option->name + " needs a value: -" + option->name + " " + option->value + ".");
}

std::vector<po::option> parse(const std::vector<std::string>& arguments) {
    // Boost takes "-=x" for the beginning of every name there is.
    for (const std::string& argument : arguments)
        if (argument.starts_with("-=") || argument.starts_with("--="))
            throw OptionError("An option has no name before its =; dem2buildings_score --help lists all.");
    namespace style = po::command_line_style;
    po::options_description description;
    for (const ScoreOption& option : score_options()) {
        const po::value_semantic* semantic = nullptr;  // owned by the description
        if (option.value.empty())
            semantic = new po::untyped_value(true);
        else
            semantic = po::value<std::string>();
        description.add(boost::make_shared<po::option_description>(option.name.c_str(), semantic, ""));
    }
    po::command_line_parser parser(arguments);
    parser.options(description).allow_unregistered();
    parser.style(style::allow_long | style::long_allow_adjacent | style::long_allow_next |
                 style::allow_long_disguise);
    try {
        return parser.run().options;
    } catch (const po::invalid_command_line_syntax& error) {
        refuse_syntax(error.get_option_name());
    }
}

/// A dash followed by more, but not a negative number.
bool looks_like_option(const std::string& token) {
    return token.size() > 1 && token[0] == '-' && !looks_like_number(token);
}

void apply(const po::option& parsed, std::set<std::string>& given, ScoreCommand& request) {
    const ScoreOption& option = *find(parsed.string_key);
    if (option.value.empty())
        return option.apply(request, {});
    const bool separate = parsed.original_tokens.size() > 1;
    if (parsed.value.empty() || parsed.value.front().empty() ||
        (separate && looks_like_option(parsed.value.front())))
        refuse_syntax("-" + option.name);
    if (!given.insert(option.name).second)
        throw OptionError("-" + option.name + " is given twice; give it once.");
    option.apply(request, parsed.value.front());
}

void take_file_names(const std::vector<std::string>& names, ScoreCommand& request) {
    if (names.empty())
        throw OptionError("The found and the reference footprints are missing; " + std::string(usage) + ".");
    if (names.size() == 1)
        throw OptionError("The reference is missing, there is only '" + names[0] + "'; " +
                          std::string(usage) + ".");
    if (names.size() > 2)
        throw OptionError("There are too many file names, from '" + names[2] +
                          "' on; give the found footprints and one reference.");
    if (names[0].empty() || names[1].empty())
        throw OptionError("A file name is empty; " + std::string(usage) + ".");
    request.found = names[0];
    request.reference = names[1];
}

}  // namespace

const std::vector<ScoreOption>& score_options() {
    using Text = const std::string&;
    static const std::vector<ScoreOption> options{
        {"layer", "<name>", "text",
         "Layer of the found footprints. Default: buildings where there is one, else the first.",
         [](ScoreCommand& r, Text value) { r.layer = value; }},
        {"reference_layer", "<name>", "text",
         "Layer of the reference. Default: blocks_dissolved, else buildings, else the first.",
         [](ScoreCommand& r, Text value) { r.reference_layer = value; }},
        {"height_field", "<name>", "text",
         "Field of the reference with heights above ground in m. Default: height, else Height, else roof_h.",
         [](ScoreCommand& r, Text value) { r.height_field = value; }},
        {"aoi", "<dataset or layer>", "dataset",
         "Polygons in which the reference is complete: a layer of the reference, or else a dataset, of which "
         "the first layer counts. Default: the layer aoi of the reference where there is one, else no limit.",
         [](ScoreCommand& r, Text value) { r.area_of_interest = value; }},
        {"dem", "<raster>", "raster",
         "The raster that the footprints were found in. Areas beyond it or without data are left out, and "
         "everything is measured in its CRS. Default: no limit, and the CRS of the reference.",
         [](ScoreCommand& r, Text value) { r.dem = value; }},
        {"min_object", "<m2>", "number",
         "The smallest object that is counted. At least 0. Unit: m2. Default: 50.",
         [](ScoreCommand& r, Text value) {
             NumberRange range;
             range.lowest = 0;
             r.min_object_m2 = parse_number("min_object", range, value);
         }},
        {"json", "", "switch", "Print the result as JSON.", [](ScoreCommand& r, Text) { r.json = true; }},
        {"q", "", "switch", "Print the figures alone, without names of files and numbers behind them.",
         [](ScoreCommand& r, Text) { r.quiet = true; }},
        {"help", "", "switch", "Print this help.", [](ScoreCommand& r, Text) { r.help = true; }},
        {"version", "", "switch", "Print the versions of the program and of its libraries.",
         [](ScoreCommand& r, Text) { r.version = true; }},
        {"man", "", "switch", "Print the man page as roff.",
         [](ScoreCommand& r, Text) { r.man_page = true; }},
    };
    return options;
}

ScoreCommand parse_score_command_line(const std::vector<std::string>& arguments) {
    const auto end = std::ranges::find(arguments, "--");
    const std::vector<std::string> before(arguments.begin(), end);
    std::vector<std::string> names;
    std::optional<std::string> unknown;
    std::set<std::string> given;
    ScoreCommand request;
    for (const po::option& parsed : parse(before)) {
        const std::string& token = parsed.original_tokens.front();
        if (parsed.unregistered || (parsed.string_key.empty() && token.size() > 1 && token[0] == '-'))
            unknown = unknown.value_or(token);
        else if (parsed.string_key.empty())
            names.push_back(parsed.value.front());
        else
            apply(parsed, given, request);
    }
    if (request.help || request.version || request.man_page)
        return request;
    if (unknown)
        refuse_unknown(*unknown);
    names.insert(names.end(), end == arguments.end() ? end : end + 1, arguments.end());
    take_file_names(names, request);
    return request;
}

}  // namespace d2b
