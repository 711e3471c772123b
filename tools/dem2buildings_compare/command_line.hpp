#pragma once

#include <functional>
#include <string>
#include <vector>

#include "common/tool_texts.hpp"
#include "dem2buildings/compare.hpp"

namespace d2b {

/// All that the command line can set.
struct CompareCommand : SurveyRequest, TextSwitches {
    bool json = false;
    bool quiet = false;
};

/// One option. Parser, help and man page are all made from these rows.
struct CompareOption : ToolOption {
    std::function<void(CompareCommand&, const std::string&)> apply;  ///< @throws OptionError
};

/// Options in the order in which help lists them.
[[nodiscard]] const std::vector<CompareOption>& compare_options();

/// Reads a command line; opens no file. Options may stand anywhere, with one dash or two, their values behind
/// a blank or an equals sign; "--" ends the options. Where help, the version or the man page is asked for,
/// file names are not looked at.
/// @param arguments without the program's name and without GDAL's own switches @throws OptionError
[[nodiscard]] CompareCommand parse_compare_command_line(const std::vector<std::string>& arguments);

}  // namespace d2b
