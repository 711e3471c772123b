#pragma once

#include "write/new_layer.hpp"
#include "write/ogr_call.hpp"
#include "write/ogr_handles.hpp"

namespace d2b {

/// Completes the table of a new layer in PostgreSQL in the open transaction: a comment per column, which QGIS
/// shows, a unique index of ids and an index by which the parts of a building are found. The driver creates
/// the spatial index. @throws OutputError
void furnish_postgresql_table(GDALDatasetH dataset, const NewLayer& layer, const WriteTarget& target);

}  // namespace d2b
