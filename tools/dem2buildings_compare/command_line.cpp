#include "dem2buildings_compare/command_line.hpp"

#include <string_view>

#include "dem2buildings/error.hpp"

namespace d2b {
namespace {

constexpr std::string_view program = "dem2buildings_compare";
constexpr std::string_view usage = "usage: dem2buildings_compare [options] <old> <new> [<changes>]";

void take_file_names(const std::vector<std::string>& names, CompareCommand& request) {
    if (names.empty())
        throw OptionError("The old and the new survey are missing; " + std::string(usage) + ".");
    if (names.size() == 1)
        throw OptionError("The new survey is missing, there is only '" + names[0] + "'; " +
                          std::string(usage) + ".");
    if (names.size() > 3)
        throw OptionError("There are too many file names, from '" + names[3] +
                          "' on; give two surveys and one destination.");
    for (const std::string& name : names)
        if (name.empty())
            throw OptionError("A file name is empty; " + std::string(usage) + ".");
    request.old_survey = names[0];
    request.new_survey = names[1];
    if (names.size() > 2)
        request.destination = names[2];
}

void check_destination(const CompareCommand& request) {
    if (request.destination.empty() &&
        (!request.format.empty() || (request.overwrite && request.page.empty())))
        throw OptionError(std::string(request.format.empty() ? "-overwrite" : "-f") +
                          " has no effect without a destination; give one, or leave it out.");
    if (request.page.empty() && !(request.title.empty() && request.credit.empty()))
        throw OptionError(request.title.empty()
                              ? "-credit needs -page <file.html>; it is written on the page."
                              : "-title needs -page <file.html>; it is the title of the page.");
    if (request.destination.starts_with("/vsimem/"))
        throw OptionError("The destination '" + request.destination +
                          "' is in memory and lost when the program ends; give a file.");
    if (request.json && request.destination.find("/vsistdout") != std::string::npos)
        throw OptionError(
            "-json cannot be used with a destination in /vsistdout/; both would write to stdout.");
}

}  // namespace

const std::vector<CompareOption>& compare_options() {
    using Text = const std::string&;
    static const std::vector<CompareOption> options{
        {{"f", "<format>", "text", "Format of the changes, by its GDAL name. Default: by the extension."},
         [](CompareCommand& r, Text value) { r.format = value; }},
        {{"overwrite", "", "switch",
          "Replace the layer of changes if it exists; in a format of a single layer, the file. Also the "
          "page."},
         [](CompareCommand& r, Text) { r.overwrite = true; }},
        {{"page", "<file.html>", "path",
          "Write a page for browsers that shows the buildings of both surveys, in turns, in the colours of "
          "their changes."},
         [](CompareCommand& r, Text value) { r.page = value; }},
        {{"title", "<text>", "text", "Title of the page. Default: the name of its file."},
         [](CompareCommand& r, Text value) { r.title = value; }},
        {{"credit", "<text>", "text", "Source and licence of the data, for the page."},
         [](CompareCommand& r, Text value) { r.credit = value; }},
        {{"json", "", "switch", "Print the summary as JSON."},
         [](CompareCommand& r, Text) { r.json = true; }},
        {{"q", "", "switch", "Print only the numbers of changes, and no progress."},
         [](CompareCommand& r, Text) { r.quiet = true; }},
        {{"help", "", "switch", "Print this help."}, [](CompareCommand& r, Text) { r.help = true; }},
        {{"version", "", "switch", "Print the versions of the program and of its libraries."},
         [](CompareCommand& r, Text) { r.version = true; }},
        {{"man", "", "switch", "Print the man page as roff."},
         [](CompareCommand& r, Text) { r.man_page = true; }},
    };
    return options;
}

CompareCommand parse_compare_command_line(const std::vector<std::string>& arguments) {
    const std::vector<ToolOption> table(compare_options().begin(), compare_options().end());
    const ToolLine line = take_apart(arguments, table, program);
    CompareCommand request;
    for (const auto& [option, value] : line.given)
        compare_options()[option].apply(request, value);
    if (request.asks_for_text())
        return request;
    if (line.unknown)
        refuse_unknown_option(*line.unknown, table, program);
    take_file_names(line.names, request);
    check_destination(request);
    return request;
}

}  // namespace d2b
