#pragma once

#include "write/new_layer.hpp"
#include "write/ogr_call.hpp"
#include "write/ogr_handles.hpp"

namespace d2b {

/// Rows beside a layer of a GeoPackage, in the transaction that is open: its default style in QGIS's table
/// layer_styles, title, abstract and lineage as metadata of QGIS's kind, and names, units and words of its
/// fields in gpkg_data_columns. Rows of others are left alone: a style that the user has made the default
/// stays it, and a table layer_styles of another shape gets no row.
/// @throws OutputError
void write_tables(GDALDatasetH dataset, const NewLayer& layer, const Provenance& provenance,
                  const WriteTarget& target);

}  // namespace d2b
