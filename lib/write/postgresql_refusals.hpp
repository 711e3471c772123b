#pragma once

#include <string>
#include <vector>

#include "write/destination.hpp"
#include "write/ogr_handles.hpp"

namespace d2b {

/// Reports errors that would otherwise occur after all the work: no PostGIS, no such schema, a user without
/// the rights to create, replace or append to the layers. @param names of the layers @throws OptionError,
/// OutputError
void refuse_unfit_postgresql(const Destination& destination, GDALDatasetH database,
                             const WriteOptions& options, const std::vector<std::string>& names);

/// @param reason why it cannot be opened @throws OutputError always
[[noreturn]] void refuse_unreached_postgresql(const Destination& destination, const std::string& reason);

}  // namespace d2b
