#include "write/crs_misfit.hpp"

#include <array>
#include <cmath>

#include "read/gdal_messages.hpp"
#include "write/trial_dataset.hpp"
#include "write/vector_format.hpp"

namespace d2b {

namespace {

/// True if the first feature of a layer was read back at its position.
bool is_at(OGRLayerH layer, const Position& place) {
    constexpr double near = 0.01;
    OGR_L_ResetReading(layer);
    const FeatureOwner feature(OGR_L_GetNextFeature(layer));
    OGRGeometryH geometry = feature ? OGR_F_GetGeometryRef(feature.get()) : nullptr;
    if (geometry == nullptr)
        return false;
    OGREnvelope envelope{};
    OGR_G_GetEnvelope(geometry, &envelope);
    return std::abs(envelope.MinX - place.x) < near && std::abs(envelope.MinY - place.y) < near;
}

bool same_kind(OGRSpatialReferenceH a, OGRSpatialReferenceH b) {
    return OSRIsProjected(a) == OSRIsProjected(b) && OSRIsLocal(a) == OSRIsLocal(b) &&
           OSRIsDerivedGeographic(a) == OSRIsDerivedGeographic(b);
}

/// True if the driver creates a layer in WGS 84; otherwise the CRS is not the reason for its failure.
bool takes_plain_degrees(GDALDriverH driver, const std::string& destination) {
    const GdalMessages messages;
    const MemoryFolder memory;
    const std::string file = memory.file(trial_name(driver, destination));
    const DatasetOwner dataset(GDALCreate(driver, file.c_str(), 0, 0, 0, GDT_Unknown, nullptr));
    const CrsOwner srs(OSRNewSpatialReference(nullptr));
    OSRSetWellKnownGeogCS(srs.get(), "WGS84");
    return dataset && add_trial_layer(dataset.get(), "probe", srs.get()) != nullptr && !messages.failed();
}

/// True if the CRS has a WKT 1, to which GDAL exports the CRS of a GeoPackage, reporting an error if it
/// cannot.
bool has_wkt1(OGRSpatialReferenceH srs) {
    const std::array<const char*, 2> options{"FORMAT=WKT1_GDAL", nullptr};
    char* text = nullptr;
    const bool done = OSRExportToWktEx(srs, &text, options.data()) == OGRERR_NONE;
    CPLFree(text);
    return done;
}

}  // namespace

CrsMisfit crs_misfit(GDALDriverH driver, const std::string& destination, const std::string& wkt,
                     const Position& place) {
    const GdalMessages messages;
    const CrsOwner srs(wkt.empty() ? nullptr : OSRNewSpatialReference(wkt.c_str()));
    if (!srs || is_connection(driver, destination) || !says_yes(driver, GDAL_DCAP_VIRTUALIO) ||
        (EQUAL(GDALGetDriverShortName(driver), "GPKG") && has_wkt1(srs.get())))
        return {};
    OSRSetAxisMappingStrategy(srs.get(), OAMS_TRADITIONAL_GIS_ORDER);
    const MemoryFolder memory;
    const std::string file = memory.file(trial_name(driver, destination));
    DatasetOwner dataset(GDALCreate(driver, file.c_str(), 0, 0, 0, GDT_Unknown, nullptr));
    const GdalMessages of_layer;
    OGRLayerH layer = dataset ? add_trial_layer(dataset.get(), "probe", srs.get()) : nullptr;
    if (of_layer.failed())
        return takes_plain_degrees(driver, destination) ? CrsMisfit{of_layer.reason()} : CrsMisfit{};
    const GdalMessages quiet;
    if (layer == nullptr || !add_trial_feature(layer, place))
        return {};  // inconclusive
    dataset.reset();
    dataset = reopen_trial(driver, file);
    layer = dataset ? GDALDatasetGetLayer(dataset.get(), 0) : nullptr;
    if (layer == nullptr || !is_at(layer, place))
        return {};
    OGRSpatialReferenceH back = OGR_L_GetSpatialRef(layer);
    if (back == nullptr)
        return {"it would be lost"};
    return same_kind(back, srs.get()) ? CrsMisfit{} : CrsMisfit{"", OSRGetName(back)};
}

}  // namespace d2b
