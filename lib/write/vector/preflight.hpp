#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include <gdal.h>

#include "dem2buildings/sinks.hpp"
#include "write/destination.hpp"
#include "write/ogr_util.hpp"

namespace d2b::writing {

/// Everything that is known about the output before the work.
struct PlannedOutput {
    const Destination& destination;
    const VectorFormat& format;
    const WriteOptions& options;
    std::span<const LayerSpec> layers;
    const Provenance& provenance;
    Position place;  ///< position inside the data
};

/// Dataset that was created on trial.
struct TrialDataset {
    bool in_memory = true;           ///< false if the driver only writes to disk
    std::vector<std::string> names;  ///< names of its files: the one of the destination, and those next to it
};

/// Creates a dataset of these layers with one feature each, reads it back and deletes it, so that unsupported
/// fields, geometries, names and options are reported before the work. Does so in memory; if that fails, next
/// to the destination, because some drivers only write to disk.
/// @throws OptionError for reserved names and for standard field names that the format would change
/// @throws OutputError with the reason of the driver
[[nodiscard]] TrialDataset preflight_create(const PlannedOutput& draft);

/// Checks that the layers can be written to a pipe, a device or stdout. @throws OutputError with the reason
/// of the driver
void preflight_stream(const PlannedOutput& draft);

/// Checks that features can be appended to the existing layers. @throws OutputError naming the mismatch
void preflight_append(const PlannedOutput& draft);

/// Checks that views and triggers of the user on layers of a SQLite database fit the new layers.
/// @throws OutputError naming the one that does not fit
void preflight_replace(const PlannedOutput& draft);

/// Reasons why a format does not preserve a CRS.
struct CrsMismatch {
    std::string lost{};     ///< reason why a layer loses its CRS or cannot be created; "" if it keeps it
    std::string read_as{};  ///< name of the CRS that programs will assume instead; "" if there is none
};

/// Tests in /vsimem/ if a layer of the format preserves a CRS, because some drivers reject a projection that
/// they have no name for, and others drop it or write the coordinates as if they were in the CRS of the
/// format. @param wkt "" for none @param place position in that CRS @return empty if the CRS is kept or the
/// coordinates are transformed to the CRS of the format
[[nodiscard]] CrsMismatch find_crs_mismatch(const VectorFormat& format, const std::string& destination,
                                            const std::string& wkt, const Position& place);

/// Finds out how a format rounds coordinates with the options and configuration of a run: writes polygons in
/// memory, reads them back and compares, because each driver and GDAL version has its own rules.
/// @return nothing if the format stores coordinates in another CRS or on a grid that is not decimal
[[nodiscard]] std::optional<CoordinateRounding> coordinate_rounding(const PlannedOutput& draft, bool appends);

/// Reads the result back and warns of polygons that are invalid after rounding.
void warn_of_invalid(const WriteTarget& target, const VectorFormat& format, const std::string& path);

}  // namespace d2b::writing
