#pragma once

#include <map>
#include <string>

#include "dem2buildings/options.hpp"

namespace d2b {

/// Returns the destination for messages and reports, with passwords redacted: the name of a database may
/// contain one.
[[nodiscard]] std::string redacted_destination(const std::string& destination);

/// Returns the options needed to reproduce a result, quoted for a POSIX shell, in the order of the table:
/// "-preset thesis -fl 10 12 -nln 'my roofs'". Without source and destination; "" if there are none.
[[nodiscard]] std::string reproducing_arguments(const Options& options);

/// Returns the source for the metadata of a result: several rasters as words for a POSIX shell, else the
/// name.
/// @param name of the source in messages
[[nodiscard]] std::string source_text(const std::string& name, const ReadOptions& options);

/// Strips folders from the metadata of a run, for files that are handed to others, because folders reveal who
/// works where. The options then cannot be executed as they are. @param metadata from make_provenance()
[[nodiscard]] std::map<std::string, std::string> strip_folders(std::map<std::string, std::string> metadata,
                                                               const Options& options);

}  // namespace d2b
