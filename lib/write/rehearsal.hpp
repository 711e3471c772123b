#pragma once

#include <span>

#include "dem2buildings/sinks.hpp"
#include "write/destination.hpp"

namespace d2b {

/// What is going to be written, as far as it is known before the work.
struct Draft {
    const Destination& destination;
    const VectorFormat& format;
    const WriteOptions& options;
    std::span<const LayerSpec> layers;
    const Provenance& provenance;
    Position place;  ///< among the positions
};

/// Makes a new dataset of these layers with a feature in each, reads it back and removes it: what the driver
/// refuses (fields, geometries, names, options), or writes as nobody can read it, is known before the work.
/// In memory; where that fails, beside the destination, since some drivers write to the disk alone.
/// @return whether it went in memory @throws OptionError: names that the format keeps for itself, names of
/// fields that other programs look for and would not find. @throws OutputError with the driver's reason
bool rehearse_creating(const Draft& draft);

/// Whether features can be added to the layers that are there. @throws OutputError with what does not fit
void rehearse_adding(const Draft& draft);

/// Whether what a user has made on layers of a SQLite database (views, triggers) fits those that take their
/// place. @throws OutputError with the name of what does not
void rehearse_replacing(const Draft& draft);

}  // namespace d2b
