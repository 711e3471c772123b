#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "dem2buildings/options.hpp"
#include "write/staging.hpp"
#include "write/vector/vector_format.hpp"

namespace d2b::writing {

/// Resolves symbolic links and removes trailing slashes, because renaming a file onto a link would replace
/// the link.
[[nodiscard]] std::filesystem::path resolved_path(const std::string& name);

/// Checks by trial that files can be created next to a path. @param name for messages @throws OutputError if
/// the folder does not exist, is not a folder or is not writable
void check_parent_folder(const std::string& name, const std::filesystem::path& path);

/// Destination of the result.
struct Destination {
    std::string name;     ///< user input without a password; for messages
    std::string path;     ///< without symbolic links and trailing slash
    bool local = false;   ///< local file or folder: staged, then renamed
    bool exists = false;  ///< false for an empty folder if the format creates a folder
};

/// Also used for rasters. @throws OptionError for names in archives and in read-only file systems
void reject_archive(const std::string& name);

/// Finds out if the destination exists and can be written. @throws OptionError if -overwrite and -append are
/// both given, it exists and neither is given, it is a folder instead of a file, or other files are in the
/// way @throws OutputError if its folder does not exist or it is not writable
[[nodiscard]] Destination locate(const WriteOptions& options, const VectorFormat& format);

/// Dataset that exists at the destination.
struct ExistingDataset {
    ReplacedFiles old;  ///< all files of the dataset; the folder alone if it is a folder
    std::vector<std::string> layers;
};

/// @param names layers that the run writes @throws OptionError if the flag cannot be obeyed, because it is
/// not a dataset of the format, layers or files of others would be lost, or the format cannot append
/// @throws OutputError if it cannot be opened for writing
[[nodiscard]] ExistingDataset inspect_existing(const Destination& destination, const VectorFormat& format,
                                               const WriteOptions& options,
                                               const std::vector<std::string>& names);

/// Adds files next to the destination that the new dataset consists of, too, to those that it replaces,
/// because GDAL does not list all files of a dataset, such as the schema of a GML. @param names of the files
/// of the new dataset @throws OptionError if such a file exists without a dataset, or is one of another
/// dataset
void claim_files(const Destination& destination, const VectorFormat& format,
                 std::optional<ExistingDataset>& existing, std::vector<std::string> names);

/// Like inspect_existing(), but for a database or service; empty if it cannot be opened and is to be created.
/// A database exists before its layers, so only layers of the same names conflict. @param format its
/// transactions are set @throws OptionError if a layer exists and neither -overwrite nor -append is given
[[nodiscard]] std::optional<ExistingDataset> inspect_database(const Destination& destination,
                                                              VectorFormat& format,
                                                              const WriteOptions& options,
                                                              const std::vector<std::string>& names);

}  // namespace d2b::writing
