#pragma once

#include <optional>
#include <string>
#include <vector>

#include "write/destination.hpp"

namespace d2b {

/// Dataset that exists at the destination.
struct ExistingDataset {
    std::vector<std::string> files;  ///< all files of the dataset; the folder alone if it is a folder
    std::vector<std::string> layers;
    std::string stamp;  ///< changes when the files change
};

/// @param names layers that the run writes @throws OptionError if the flag cannot be obeyed, because it is
/// not a dataset of the format, layers or files of others would be lost, or the format cannot append
/// @throws OutputError if it cannot be opened for writing
[[nodiscard]] ExistingDataset inspect_existing(const Destination& destination, const VectorFormat& format,
                                               const WriteOptions& options,
                                               const std::vector<std::string>& names);

/// Like inspect_existing(), but for a database or service; empty if it cannot be opened and is to be created.
/// A database exists before its layers, so only layers of the same names conflict. @param format its
/// transactions are set @throws OptionError if a layer exists and neither -overwrite nor -append is given
[[nodiscard]] std::optional<ExistingDataset> inspect_database(const Destination& destination,
                                                              VectorFormat& format,
                                                              const WriteOptions& options,
                                                              const std::vector<std::string>& names);

/// Returns sizes and times of the files; differs after a change.
[[nodiscard]] std::string stamp_of(const std::vector<std::string>& files);

}  // namespace d2b
