#pragma once

#include "write/ogr_util.hpp"
#include "write/qgis/qgis_style.hpp"

namespace d2b::writing {

/// Adds rows about a layer to a GeoPackage in the open transaction: its default style in the table
/// layer_styles of QGIS, title, abstract and lineage as QGIS metadata, and names, units and descriptions of
/// its fields in gpkg_data_columns. Leaves rows of others alone: a default style chosen by the user stays the
/// default, and a table layer_styles with other columns gets no row. @throws OutputError
void write_geopackage_tables(GDALDatasetH dataset, const NewLayer& layer, const Provenance& provenance,
                             const WriteTarget& target);

}  // namespace d2b::writing
