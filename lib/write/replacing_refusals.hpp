#pragma once

#include <string>
#include <vector>

#include "write/destination.hpp"
#include "write/ogr_handles.hpp"

namespace d2b {

/// Rejects -overwrite if it would break relations and foreign keys, whose ids would then refer to other
/// features, or views and triggers of PostgreSQL, which drops them with the table. @param names of the layers
/// @throws OptionError naming the first one
void refuse_what_would_break(const Destination& destination, GDALDatasetH dataset, const VectorFormat& format,
                             const std::vector<std::string>& names);

}  // namespace d2b
