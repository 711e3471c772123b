#pragma once

#include <string>

#include "dem2buildings/options.hpp"

namespace d2b {

/// The options without which a result cannot be made again, as they stand on a command line of a POSIX shell,
/// in the order of the table: "-preset thesis -fl 10 12 -nln 'my roofs'". "" where there are none. Source and
/// destination are not among them.
[[nodiscard]] std::string given_words(const Options& options);

}  // namespace d2b
