#pragma once

#include <string>
#include <vector>

#include "options/option_table.hpp"

namespace d2b {

struct GivenOption {
    const OptionRow* row = nullptr;   ///< never null
    std::vector<std::string> values;  ///< not checked yet
};

/// A command line in its parts, each in the order in which they stood.
struct Tokens {
    std::vector<GivenOption> options;
    std::vector<std::string> file_names;
    std::vector<std::string> unknown;  ///< what begins with a dash and is no option
};

/// Tells options, their values and file names apart. A value that begins with a dash must be a number, unless
/// an equals sign joins it to its option. @throws OptionError: a value is missing, or a switch has one
[[nodiscard]] Tokens split_tokens(std::vector<std::string> arguments);

/// Throws the OptionError for it: what to use instead, or which option may be meant.
[[noreturn]] void refuse_unknown_option(const std::string& token);

}  // namespace d2b
