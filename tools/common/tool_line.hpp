#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace d2b {

/// Description of an option for the parser and for all texts about it.
struct ToolOption {
    std::string name;   ///< without dash
    std::string value;  ///< "<name>"; "" for a switch; of several values: "<x> <y>"
    std::string kind;   ///< one of option_kind_names
    std::string help;
};

/// A command line in pieces.
struct ToolLine {
    /// Options in their order, by their places in the table, with their values; several values have a blank
    /// between them.
    std::vector<std::pair<std::size_t, std::string>> given;
    std::vector<std::string> names;      ///< of files
    std::optional<std::string> unknown;  ///< the first option that is none
};

/// True for a dash followed by more, but not for a negative number.
[[nodiscard]] bool looks_like_option(const std::string& token);

/// Splits "--te=1" into "te" and "=1".
[[nodiscard]] std::pair<std::string, std::string> split_name(const std::string& token);

/// Returns "-help" for -h, -help_all and -help-all, which mean the same where -help lists all options; other
/// tokens stay.
[[nodiscard]] std::string with_one_help(const std::string& token);

/// Takes a command line apart. Options may stand anywhere, with one dash or two, their values behind a blank
/// or an equals sign; "--" ends the options.
/// @param program for messages @throws OptionError: given twice, without its value, a switch with one
[[nodiscard]] ToolLine take_apart(const std::vector<std::string>& arguments,
                                  const std::vector<ToolOption>& options, std::string_view program);

/// @param token "-min_angel=3" @throws OptionError always, with the name that is nearest
[[noreturn]] void refuse_unknown_option(const std::string& token, const std::vector<ToolOption>& options,
                                        std::string_view program);

/// "-dem <raster>"
[[nodiscard]] std::string option_heading(const ToolOption& option);

}  // namespace d2b
