#pragma once

#include <map>
#include <string>

#include "dem2buildings/options.hpp"

namespace d2b {

/// The options without which a result cannot be made again, as they stand on a command line of a POSIX shell,
/// in the order of the table: "-preset thesis -fl 10 12 -nln 'my roofs'". "" where there are none. Source and
/// destination are not among them.
[[nodiscard]] std::string given_words(const Options& options);

/// The metadata of a run as they stand in files that are handed to others: sources are called by their names
/// alone, because folders say who works where. The words of the options cannot be run as they are then.
/// @param metadata as make_provenance() has them
[[nodiscard]] std::map<std::string, std::string> without_folders(std::map<std::string, std::string> metadata,
                                                                 const Options& options);

}  // namespace d2b
