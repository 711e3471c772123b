#include "dem2buildings/command_line.hpp"

#include <algorithm>
#include <iterator>

#include "dem2buildings/error.hpp"
#include "dem2buildings/tokens.hpp"
#include "options/option_checks.hpp"
#include "options/run_plan.hpp"

namespace d2b {
namespace {

constexpr std::string_view usage = "usage: dem2buildings [options] <src_raster>... <dst_vector>";

/// Returns true if a text is requested in place of a run; the first such option counts.
bool asks_for_text(const std::vector<GivenOption>& given, Request& request) {
    for (const GivenOption& option : given) {
        Request asked;
        if (option.row->arity == Arity::none)
            option.row->apply(asked, {});
        if (asked.tool.prints_text()) {
            request = asked;
            return true;
        }
    }
    return false;
}

void apply_all(const std::vector<GivenOption>& given, Request& request) {
    for (const GivenOption& option : given) {
        const OptionRow& row = *option.row;
        if (request.options.given.contains(row.name) && row.arity != Arity::none && !row.repeatable)
            throw OptionError("-" + row.name + " is given twice; give it once.");
        apply_option(row, request, option.values);
    }
}

/// A sweep has no destination.
void take_source(const std::vector<std::string>& names, Options& options) {
    if (names.size() != 1 || names[0].empty())
        throw OptionError("-sweep takes one file name, that of the source, and writes no layers.");
    options.read.source = names[0];
}

void take_file_names(const std::vector<std::string>& names, Options& options) {
    if (names.empty())
        throw OptionError("The source and the destination are missing; " + std::string(usage) + ".");
    if (names.size() == 1)
        throw OptionError("The destination is missing, there is only '" + names[0] + "'; " +
                          std::string(usage) + ".");
    for (const std::string& name : names) {
        if (name.empty())
            throw OptionError("A file name is empty; " + std::string(usage) + ".");
        if (name == "-")
            throw OptionError("'-' is not a file name here; write /vsistdin/ or /vsistdout/.");
    }
    const std::string& destination = names.back();
    const std::vector<std::string> sources(names.begin(), names.end() - 1);
    for (const std::string& source : sources)
        require_other_file(source, destination);
    if (destination.starts_with("/vsimem/"))
        throw OptionError("The destination '" + destination +
                          "' is in memory and lost when the program ends; give a file.");
    options.read.source = source_of(sources);
    options.write.destination = destination;
}

/// Rasters, surfaces and pictures that are written beside the layers.
void check_side_files(const WriteOptions& write) {
    std::vector<std::string> names = auxiliary_file_names(write);
    names.push_back(write.preview);
    for (const std::string& name : names)
        if (name.starts_with("/vsimem/"))
            throw OptionError("'" + name + "' is in memory and lost when the program ends; give a file.");
}

}  // namespace

std::string source_of(const std::vector<std::string>& names) {
    std::string source = names.front();
    for (std::size_t i = 1; i < names.size(); ++i)
        source += "\n" + names[i];
    if (names.size() > 1 && std::ranges::count(source, '\n') >= std::ssize(names))
        throw OptionError(
            "The name of one of several sources has a line break; rename it, or join them with gdalbuildvrt "
            "and give its mosaic.");
    return source;
}

void require_other_file(const std::string& source, const std::string& destination) {
    if (source == destination)
        throw OptionError("The destination '" + destination + "' is the source; give another name.");
}

bool writes_to_stdout(const Request& request) {
    return request.options.write.destination.find("/vsistdout") != std::string::npos;
}

Request parse_command_line(const std::vector<std::string>& arguments) {
    Tokens tokens = split_tokens(arguments);
    Request request;
    if (asks_for_text(tokens.options, request))
        return request;
    if (!tokens.unknown.empty())
        refuse_unknown_option(tokens.unknown.front());
    apply_all(tokens.options, request);
    check_options(request);
    if (request.tool.sweep.empty())
        take_file_names(tokens.file_names, request.options);
    else
        take_source(tokens.file_names, request.options);
    check_side_files(request.options.write);
    if (request.tool.json && writes_to_stdout(request))
        throw OptionError(
            "-json cannot be used with a destination in /vsistdout/; both would write to stdout.");
    request.tool.quiet = request.tool.quiet || request.tool.json || writes_to_stdout(request);
    return request;
}

}  // namespace d2b
