#pragma once

#include <optional>
#include <string>
#include <vector>

#include "write/destination.hpp"

namespace d2b {

/// What stands at the destination already.
struct ExistingDataset {
    std::vector<std::string> files;  ///< all that it consists of; the folder alone for a folder
    std::vector<std::string> layers;
    std::string stamp;  ///< changes when the files do
};

/// @param names layers that the run writes @throws OptionError where the flag cannot be obeyed: not a dataset
/// of the format, layers or files of others that would be lost, a format that takes no further features.
/// @throws OutputError where it cannot be opened for writing
[[nodiscard]] ExistingDataset inspect_existing(const Destination& destination, const VectorFormat& format,
                                               const WriteOptions& options,
                                               const std::vector<std::string>& names);

/// As inspect_existing for the name of a database or service; empty where it does not open, and is to be
/// created. A database is there before its layers are: only layers of the same names stand in the way.
/// @param format told whether the database has transactions @throws OptionError where a layer is there, and
/// neither -overwrite nor -append is given
[[nodiscard]] std::optional<ExistingDataset> inspect_database(const Destination& destination,
                                                              VectorFormat& format,
                                                              const WriteOptions& options,
                                                              const std::vector<std::string>& names);

/// Sizes and times of the files; what it says changes when they do.
[[nodiscard]] std::string stamp_of(const std::vector<std::string>& files);

}  // namespace d2b
