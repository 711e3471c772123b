#pragma once

#include <array>
#include <string>
#include <vector>

#include "common/help_text.hpp"
#include "common/tool_line.hpp"

namespace d2b {

/// Switches that ask for a text about a tool in place of its work.
struct TextSwitches {
    bool help = false;
    bool version = false;
    bool man_page = false;

    [[nodiscard]] bool asks_for_text() const { return help || version || man_page; }
};

/// All that the texts about a tool say. They are ASCII and end with a line feed.
struct ToolTexts {
    std::string program;                   ///< "dem2buildings_score"
    std::string arguments;                 ///< "[options] <found> <reference>"
    std::string title;                     ///< in the list of man pages
    std::vector<std::string> help;         ///< paragraphs of --help
    std::vector<std::string> description;  ///< paragraphs of the man page
    std::vector<ToolOption> options;
    std::array<std::string, 3> statuses;  ///< meaning of each exit status
    std::vector<std::string> examples;    ///< command lines
    std::string see_also;
    std::string license{};    ///< "" for that of the project
    std::string libraries{};  ///< ", CGAL 5.5.1": those that only this tool has
};

/// Sentence for ToolTexts::description, after options_anywhere.
inline constexpr const char* names_after_dashes = " After -- only file names follow.";

/// Two lines, for a command line without arguments.
[[nodiscard]] std::string tool_short_usage(const ToolTexts& texts);
/// The text of --help, in lines of at most 80 characters.
[[nodiscard]] std::string tool_help(const ToolTexts& texts);
/// The man page, as roff.
[[nodiscard]] std::string tool_man_page(const ToolTexts& texts);
/// The text that the switches ask for. @pre switches.asks_for_text()
[[nodiscard]] std::string asked_text(const TextSwitches& switches, const ToolTexts& texts);

}  // namespace d2b
