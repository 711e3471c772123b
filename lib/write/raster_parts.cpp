#include "write/raster_parts.hpp"

#include <array>

#include <cpl_string.h>

#include "core/number_text.hpp"
#include "dem2buildings/error.hpp"
#include "read/gdal_handles.hpp"
#include "read/gdal_messages.hpp"
#include "read/start_gdal.hpp"
#include "write/geotiff_file.hpp"
#include "write/small_file.hpp"
#include "write/xml_text.hpp"

namespace d2b {
namespace {

std::string element_if_any(const std::string& name, const std::string& text) {
    return text.empty() ? "" : "  <" + name + ">" + xml_text(text) + "</" + name + ">\n";
}

std::string crs_text(GDALDatasetH dataset) {
    OGRSpatialReferenceH crs = GDALGetSpatialRef(dataset);
    char* wkt = nullptr;
    const std::array<const char*, 2> options{"FORMAT=WKT2_2018", nullptr};
    if (crs == nullptr || OSRExportToWktEx(crs, &wkt, options.data()) != OGRERR_NONE)
        return "";
    std::string axes;
    int count = 0;
    const int* const mapping = OSRGetDataAxisToSRSAxisMapping(crs, &count);
    for (int i = 0; i < count; ++i)
        axes += (i == 0 ? "" : ",") + std::to_string(mapping[i]);
    std::string text = "  <SRS dataAxisToSRSAxisMapping=\"" + axes + "\">" + xml_text(wkt) + "</SRS>\n";
    CPLFree(wkt);
    return text;
}

std::string metadata_text(GDALDatasetH dataset) {
    std::string items;
    const CPLStringList metadata(CSLDuplicate(GDALGetMetadata(dataset, nullptr)));
    for (int i = 0; i < metadata.size(); ++i) {
        char* key = nullptr;
        const char* const value = CPLParseNameValue(metadata[i], &key);
        if (key != nullptr && value != nullptr)
            items += "    <MDI key=\"" + xml_text(key) + "\">" + xml_text(value) + "</MDI>\n";
        CPLFree(key);
    }
    return items.empty() ? "" : "  <Metadata>\n" + items + "  </Metadata>\n";
}

/// Returns the VRT up to its first source.
std::string head_text(const std::string& first, std::int32_t rows, std::int32_t cols) {
    register_formats();
    const GdalMessages messages(first, first);
    const DatasetOwner dataset(GDALOpenEx(first.c_str(), GDAL_OF_RASTER, nullptr, nullptr, nullptr));
    if (!dataset)
        throw InputError("'" + first + "' cannot be read: " + messages.reason_for(first) +
                         "; delete it and run 'find' of tile 0 again.");
    std::string text = "<VRTDataset rasterXSize=\"" + std::to_string(cols) + "\" rasterYSize=\"" +
                       std::to_string(rows) + "\">\n" + crs_text(dataset.get());
    if (std::array<double, 6> place{}; GDALGetGeoTransform(dataset.get(), place.data()) == CE_None)
        text += element_if_any("GeoTransform", numbers_text(place, ", "));
    const GDALRasterBandH band = GDALGetRasterBand(dataset.get(), 1);
    return text + metadata_text(dataset.get()) + "  <VRTRasterBand dataType=\"Float32\" band=\"1\">\n" +
           element_if_any("Description", GDALGetDescription(band)) +
           element_if_any("NoDataValue", number_text(static_cast<double>(GeoTiffFile::nodata))) +
           element_if_any("UnitType", GDALGetRasterUnitType(band));
}

std::string window_text(const char* name, std::int32_t row, std::int32_t col, const Window& size) {
    return std::string("<") + name + " xOff=\"" + std::to_string(col) + "\" yOff=\"" + std::to_string(row) +
           "\" xSize=\"" + std::to_string(size.cols) + "\" ySize=\"" + std::to_string(size.rows) + "\"/>";
}

std::string part_text(const RasterPart& part) {
    // States the properties of the part, because otherwise GDAL would open every part to find them.
    const std::string side = std::to_string(GeoTiffFile::tile);
    return "    <SimpleSource><SourceFilename relativeToVRT=\"1\">" + xml_file_name(part.file) +
           "</SourceFilename><SourceBand>1</SourceBand><SourceProperties RasterXSize=\"" +
           std::to_string(part.cells.cols) + "\" RasterYSize=\"" + std::to_string(part.cells.rows) +
           "\" DataType=\"Float32\" BlockXSize=\"" + side + "\" BlockYSize=\"" + side + "\"/>" +
           window_text("SrcRect", 0, 0, part.cells) +
           window_text("DstRect", part.cells.row, part.cells.col, part.cells) + "</SimpleSource>\n";
}

}  // namespace

std::unique_ptr<PendingResult> prepare_raster_parts(const std::filesystem::path& vrt, std::int32_t rows,
                                                    std::int32_t cols, const std::vector<RasterPart>& parts) {
    std::string text = head_text((vrt.parent_path() / parts.at(0).file).string(), rows, cols);
    for (const RasterPart& part : parts)
        text += part_text(part);
    return prepare_small_file(vrt, text + "  </VRTRasterBand>\n</VRTDataset>\n");
}

}  // namespace d2b
