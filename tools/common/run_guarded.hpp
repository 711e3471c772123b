#pragma once

#include <functional>
#include <string>
#include <vector>

namespace d2b {

/// A line on stderr, whatever a file name in the text may hold.
void print_line(const char* kind, std::string text);

/// What tools differ in when they begin.
struct Tool {
    std::string (*short_usage)();  ///< for those who give no words
    std::string memory_advice;     ///< what to do where memory is short, e.g. "use a part of the input"
    /// @param words of the command line without GDAL's own switches @return the exit status
    std::function<int(const std::vector<std::string>& words)> run;
};

/// Runs a tool with every exception as a line on stderr and an exit status; what cannot be written to stdout
/// is an error, too. @return the exit status, of exit_codes.hpp
[[nodiscard]] int run_guarded(int argc, const char* const* argv, const Tool& tool);

}  // namespace d2b
