#include "dem2buildings_tiles/command_line.hpp"

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <optional>
#include <utility>

#include "common/tool_line.hpp"
#include "dem2buildings/command_line.hpp"
#include "dem2buildings/error.hpp"
#include "dem2buildings/tokens.hpp"
#include "dem2buildings_tiles/plan_file.hpp"
#include "options/option_values.hpp"

namespace d2b {
namespace {

using Strings = std::vector<std::string>;
using tiles::TileStep;

const TileStepName& step_of(const std::string& name) {
    const auto& steps = tile_step_names();
    const auto found = std::ranges::find(steps, name, &TileStepName::name);
    if (found != steps.end())
        return *found;
    Strings names;
    for (const TileStepName& step : steps)
        names.emplace_back(step.name);
    throw OptionError("The first argument names a step, " + alternatives(names) + ", not '" + name +
                      "'; dem2buildings_tiles --help says what they do.");
}

std::string usage_of(const TileStepName& step) {
    return "usage: dem2buildings_tiles " + std::string(step.name) + " " + std::string(step.arguments);
}

bool takes(const TileStepName& step, const TileOption& option) {
    return (" " + std::string(option.steps) + " ").find(" " + std::string(step.name) + " ") !=
           std::string::npos;
}

/// The option of the program's own that a token is, if the step takes it.
const TileOption* own_option(const TileStepName& step, const std::string& token) {
    if (!looks_like_option(token))
        return nullptr;
    const auto& options = tile_options();
    const auto found = std::ranges::find(options, split_name(token).first, &TileOption::name);
    return found == options.end() || !takes(step, *found) ? nullptr : &*found;
}

void apply(const TileOption& option, const std::string& value, TileCommand& command) {
    if (option.name == "tile")
        command.side = parse_integer("tile", {1, TilePlan::most_side}, value);
    else if (option.name == "threads")
        command.threads = parse_integer("threads", {1, 1024}, value);
    else if (option.name == "input_file_list")
        command.list = value;
    else if (option.name == "json")
        command.json = command.quiet = true;
    else
        command.quiet = true;
}

/// Takes the program's own options out of the arguments. @return the remaining ones
Strings take_own(const TileStepName& step, const Strings& arguments, TileCommand& command) {
    Strings left;
    Strings given;
    for (std::size_t i = 0; i < arguments.size(); ++i) {
        if (arguments[i] == "--") {
            left.insert(left.end(), arguments.begin() + static_cast<std::ptrdiff_t>(i), arguments.end());
            break;
        }
        const TileOption* const option = own_option(step, arguments[i]);
        if (option == nullptr) {
            left.push_back(arguments[i]);
            continue;
        }
        const std::string name(option->name);
        if (std::ranges::find(given, name) != given.end())
            throw OptionError("-" + name + " is given twice; give it once.");
        given.push_back(name);
        std::string value = split_name(arguments[i]).second;
        if (option->value.empty()) {
            if (!value.empty())
                throw OptionError("-" + name + " is a switch and takes no value.");
        } else if (!value.empty()) {
            value.erase(0, 1);
        } else if (i + 1 < arguments.size() && !looks_like_option(arguments[i + 1])) {
            value = arguments[++i];
        } else {
            throw OptionError("-" + name + " needs a value: -" + name + " " + std::string(option->value) +
                              ".");
        }
        apply(*option, value, command);
    }
    return left;
}

/// The arguments without the last file name, which may also be the value of an option.
Strings without_last_name(const Strings& arguments, const Tokens& tokens) {
    for (std::size_t i = arguments.size(); i-- > 0;) {
        if (arguments[i] != tokens.file_names.back())
            continue;
        Strings left = arguments;
        left.erase(left.begin() + static_cast<std::ptrdiff_t>(i));
        try {
            const Tokens rest = split_tokens(left);
            if (rest.options.size() == tokens.options.size() &&
                std::ranges::equal(rest.file_names,
                                   std::span(tokens.file_names).first(tokens.file_names.size() - 1)) &&
                std::ranges::equal(rest.options, tokens.options,
                                   [](const GivenOption& a, const GivenOption& b) {
                                       return a.row == b.row && a.values == b.values;
                                   }))
                return left;
        } catch (const OptionError&) {
            continue;  // it was the value of an option
        }
    }
    return arguments;
}

/// @param listed a list is in the place of the source
void require_names(const TileStepName& step, const Tokens& tokens, bool listed) {
    if (listed)
        for (const GivenOption& option : tokens.options)
            if (option.row->name == "if" || option.row->name == "oo")
                throw OptionError(
                    "-" + option.row->name +
                    " applies to one source, and -input_file_list names many; join them with gdalbuildvrt.");
    if (tokens.file_names.size() == (listed ? 2 : 3))
        return;
    const std::string given = ", not " + std::to_string(tokens.file_names.size());
    if (listed)
        throw OptionError("plan takes two names with -input_file_list, the destination and the work folder" +
                          given + ".");
    throw OptionError("plan takes three names, the source, the destination and the work folder" + given +
                      "; " + usage_of(step) + ".");
}

void parse_plan(const TileStepName& step, const Strings& arguments, TileCommand& command) {
    const Tokens tokens = split_tokens(arguments);
    if (!tokens.unknown.empty())
        refuse_unknown_option(tokens.unknown.front());
    for (const GivenOption& option : tokens.options)
        if (option.row->name == "sweep")
            throw OptionError(
                "-sweep does not work in tiles, because it runs the whole area several times; run "
                "dem2buildings.");
    require_names(step, tokens, !command.list.empty());
    command.work = tokens.file_names.back();
    if (command.work.empty())
        throw OptionError("A file name is empty; " + usage_of(step) + ".");
    command.words = without_last_name(arguments, tokens);
    if (!command.list.empty())
        command.words.insert(command.words.begin(), mosaic_of_list(command.work));
    command.request = parse_command_line(command.words);
    command.quiet = command.request.tool.quiet;
    if (command.request.options.read.source == "/vsistdin/")
        throw OptionError(
            "The source is read by several processes, so it cannot be /vsistdin/; give a file.");
}

std::int64_t tile_number(const std::string& text) {
    std::int64_t number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc() || end != text.data() + text.size() || number < 0)
        throw OptionError("A tile is a whole number from 0 on, not '" + text + "'.");
    return number;
}

void take_tiles(const TileStepName& step, const Strings& names, TileCommand& command) {
    if (names.size() < 2)
        throw OptionError("There is no tile to " + std::string(step.name) + "; " + usage_of(step) + ".");
    for (std::size_t i = 1; i < names.size(); ++i)
        command.tiles.push_back(tile_number(names[i]));
    std::ranges::sort(command.tiles);
    const auto twice = std::ranges::adjacent_find(command.tiles);
    if (twice != command.tiles.end())
        throw OptionError("Tile " + std::to_string(*twice) + " is named twice; name it once.");
}

void parse_step(const TileStepName& step, const Strings& arguments, TileCommand& command) {
    Strings names;
    bool options_end = false;
    for (const std::string& argument : arguments) {
        if (!options_end && argument == "--")
            options_end = true;
        else if (!options_end && looks_like_option(argument))
            throw OptionError(std::string(step.name) + " has no option " +
                              argument.substr(0, argument.find('=')) +
                              "; only plan takes the options of dem2buildings.");
        else
            names.push_back(argument);
    }
    if (names.empty() || names[0].empty())
        throw OptionError("The work folder is missing; " + usage_of(step) + ".");
    command.work = names[0];
    if (step.kind == TileStep::find || step.kind == TileStep::draw || step.kind == TileStep::write)
        take_tiles(step, names, command);
    else if (names.size() > 1)
        throw OptionError(std::string(step.name) + " only takes the work folder, not '" + names[1] +
                          "' as well; " + usage_of(step) + ".");
}

}  // namespace

const std::vector<TileStepName>& tile_step_names() {
    static const std::vector<TileStepName> steps{
        {"plan", TileStep::plan, "[options] <src_raster> <dst_vector> <work>",
         "Divides the source into tiles, checks the options and the destination, and writes "
         "<work>/plan.json. Takes "
         "the options of dem2buildings."},
        {"find", TileStep::find, "<work> <tile>...",
         "Finds the ground and the buildings of tiles, which are numbered from 0."},
        {"join", TileStep::join, "<work>",
         "Joins buildings at the borders of tiles, after find of all tiles."},
        {"draw", TileStep::draw, "<work> <tile>...", "Draws the buildings of tiles."},
        {"merge", TileStep::merge, "<work>",
         "Writes the destination after draw of all tiles, and prints the counts. If the destination is a "
         "folder of FlatGeobuf files, it only numbers the features."},
        {"write", TileStep::write, "<work> <tile>...",
         "Writes one file per tile, if the destination is a folder of FlatGeobuf files."},
    };
    return steps;
}

const std::vector<TileOption>& tile_options() {
    static const std::vector<TileOption> options{
        {"tile", "<units>",
         "Units per row and per column of a tile; the result does not depend on it. A whole number from 1 to "
         "1000. Default: 1.",
         "plan"},
        {"input_file_list", "<file>",
         "Rasters on one grid, one name per line, instead of the source; plan joins them in "
         "<work>/source.vrt.",
         "plan"},
        {"threads", "<n>", "Threads of this process, instead of those given to plan.",
         "find join draw merge write"},
        {"json", "", "The report to stdout as JSON.", "merge"},
        {"q", "", "Print only errors and warnings.", "find join draw merge write"},
        {"help", "", "Print this help.", ""},
        {"version", "", "Print the version of the program.", ""},
        {"man", "", "Print the man page as roff.", ""},
        {"bash_completion", "", "Print a script that completes command lines in Bash.", ""},
    };
    return options;
}

std::string mosaic_of_list(const std::string& work) {
    const std::string path = (std::filesystem::path(work) / "source.vrt").string();
    return path.starts_with('-') ? "./" + path : path;
}

TileCommand parse_tile_command_line(const Strings& arguments) {
    TileCommand command;
    for (const std::string& argument : arguments) {
        if (argument == "--")
            break;
        for (const TileOption& option : tile_options())
            if (option.steps.empty() && looks_like_option(argument) &&
                split_name(with_one_help(argument)).first == option.name) {
                command.text = option.name;
                return command;
            }
    }
    const TileStepName& step = step_of(arguments.front());
    command.kind = step.kind;
    const Strings left = take_own(step, {arguments.begin() + 1, arguments.end()}, command);
    if (step.kind == TileStep::plan)
        parse_plan(step, left, command);
    else
        parse_step(step, left, command);
    return command;
}

}  // namespace d2b
