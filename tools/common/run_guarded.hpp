#pragma once

#include <functional>
#include <string>
#include <vector>

namespace d2b {

/// A line on stderr, whatever a file name in the text may hold.
void print_line(const char* kind, std::string text);

/// Parts in which tools differ when they begin.
struct Tool {
    std::string (*short_usage)();  ///< for those who give no words
    std::string memory_advice;     ///< advice if memory is short, for example "use a part of the input"
    /// @param words of the command line without GDAL's own switches @return the exit status
    std::function<int(const std::vector<std::string>& words)> run;
};

/// Runs a tool with every exception as a line on stderr and an exit status; failing to write to stdout
/// is an error, too. @return the exit status, of exit_codes.hpp
[[nodiscard]] int run_guarded(int argc, const char* const* argv, const Tool& tool);

}  // namespace d2b
