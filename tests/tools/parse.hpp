#pragma once

#include <string>
#include <vector>

#include "dem2buildings/command_line.hpp"
#include "support/error_of.hpp"

namespace d2b::test {

/// The arguments and, behind them, a source and, but for a sweep, a destination.
inline Request parse(std::vector<std::string> arguments) {
    const bool sweep = !arguments.empty() && arguments[0] == "-sweep";
    arguments.emplace_back("in.tif");
    if (!sweep)
        arguments.emplace_back("out.gpkg");
    return parse_command_line(arguments);
}

/// The message that exactly these arguments are refused with.
inline std::string refusal_of_all(const std::vector<std::string>& arguments) {
    return error_of([&] { static_cast<void>(parse_command_line(arguments)); });
}

/// The same with a source and a destination behind them.
inline std::string refusal(std::vector<std::string> arguments) {
    arguments.insert(arguments.end(), {"in.tif", "out.gpkg"});
    return refusal_of_all(arguments);
}

}  // namespace d2b::test
