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
    std::vector<std::string> unknown;  ///< words that begin with a dash and are no options
};

/// Tells options, their values and file names apart. A value that begins with a dash must be a number, unless
/// an equals sign joins it to its option. @throws OptionError: a value is missing, or a switch has one
[[nodiscard]] Tokens split_tokens(std::vector<std::string> arguments);

/// Throws the OptionError for it, which names a replacement or the option that may be meant.
[[noreturn]] void refuse_unknown_option(const std::string& token);

}  // namespace d2b
