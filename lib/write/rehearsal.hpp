#pragma once

#include <span>

#include "dem2buildings/sinks.hpp"
#include "write/destination.hpp"

namespace d2b {

/// Everything that is known about the output before the work.
struct Draft {
    const Destination& destination;
    const VectorFormat& format;
    const WriteOptions& options;
    std::span<const LayerSpec> layers;
    const Provenance& provenance;
    Position place;  ///< position inside the data
};

/// Creates a dataset of these layers with one feature each, reads it back and deletes it, so that unsupported
/// fields, geometries, names and options are reported before the work. Does so in memory; if that fails, next
/// to the destination, because some drivers only write to disk. @return true if it worked in memory
/// @throws OptionError for reserved names and for standard field names that the format would change
/// @throws OutputError with the reason of the driver
bool rehearse_creating(const Draft& draft);

/// Checks that features can be appended to the existing layers. @throws OutputError naming the mismatch
void rehearse_adding(const Draft& draft);

/// Checks that views and triggers of the user on layers of a SQLite database fit the new layers.
/// @throws OutputError naming the one that does not fit
void rehearse_replacing(const Draft& draft);

}  // namespace d2b
