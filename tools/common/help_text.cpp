#include "common/help_text.hpp"

#include <algorithm>

#include "common/roff.hpp"

namespace d2b {
namespace {

constexpr std::size_t indent_of_help = 26;

}  // namespace

const std::vector<GdalSwitch>& gdal_switches() {
    static const std::vector<GdalSwitch> switches{
        {"--config <KEY>=<VALUE>", "Set a configuration option of GDAL's; also --config <KEY> <VALUE>."},
        {"--debug <on|off|topic>", "Print GDAL's debug messages to stderr."},
        {"--formats", "List the formats of this GDAL."},
        {"--format <format>", "Describe one format and its options."},
        {"--optfile <file>", "Read further arguments from a file."},
        {"--help-general", "List all switches that the programs of GDAL share."},
    };
    return switches;
}

std::string gdal_help() {
    std::string text = "\nGDAL:\n";
    for (const auto& [synopsis, help] : gdal_switches())
        text += help_entry(std::string(synopsis), std::string(help));
    return text;
}

std::string gdal_man_section() {
    std::string text = ".SS GDAL\n";
    for (const auto& [synopsis, help] : gdal_switches())
        text += roff_item(synopsis, help);
    return text;
}

std::string wrap(std::string_view text, std::size_t indent, std::size_t width) {
    std::string lines;
    std::string line;
    while (!text.empty()) {
        const std::string_view word = text.substr(0, text.find(' '));
        text.remove_prefix(std::min(word.size() + 1, text.size()));
        if (word.empty())
            continue;
        if (!line.empty() && indent + line.size() + 1 + word.size() > width) {
            lines += std::string(indent, ' ') + line + "\n";
            line.clear();
        }
        line += (line.empty() ? "" : " ") + std::string(word);
    }
    return lines + std::string(indent, ' ') + line + "\n";
}

std::string help_entry(const std::string& option, const std::string& help) {
    const std::string head = "  " + option;
    const std::string text = wrap(help, indent_of_help);
    if (head.size() + 2 > indent_of_help)
        return head + "\n" + text;
    return head + text.substr(head.size());
}

}  // namespace d2b
