#pragma once

#include <string>
#include <vector>

#include "write/destination.hpp"
#include "write/ogr_handles.hpp"

namespace d2b {

/// For what would break where layers are replaced: relations and foreign keys, whose numbers would mean other
/// features; in PostgreSQL views and triggers, too, which it drops. @param names of the layers
/// @throws OptionError with the name of the first
void refuse_what_would_break(const Destination& destination, GDALDatasetH dataset, const VectorFormat& format,
                             const std::vector<std::string>& names);

}  // namespace d2b
