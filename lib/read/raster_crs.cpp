#include "read/raster_crs.hpp"

#include <array>

#include <ogr_spatialref.h>

#include "core/crs.hpp"
#include "core/utf8_text.hpp"
#include "dem2buildings/error.hpp"
#include "read/gdal_handles.hpp"
#include "read/gdal_messages.hpp"

namespace d2b {

namespace {

std::string wkt_from_user(const std::string& text) {
    if (const std::string code = code_meant_by(text); !code.empty())
        throw OptionError("-a_srs " + text + " is not a coordinate reference system; write -a_srs " + code +
                          " if that is meant.");
    const GdalMessages messages;
    OGRSpatialReference crs;
    // Limits GDAL because the text may come from an untrusted caller of the library and must not make it open
    // files or connections.
    const OGRErr status =
        crs.SetFromUserInput(text.c_str(), OGRSpatialReference::SET_FROM_USER_INPUT_LIMITATIONS_get());
    std::string wkt = status == OGRERR_NONE ? wkt_of(OGRSpatialReference::ToHandle(&crs)) : "";
    if (wkt.empty())
        throw OptionError("-a_srs " + one_line(text) + " is not a coordinate reference system (" +
                          messages.reason() +
                          "); give a code such as EPSG:25832, WKT, PROJJSON or a PROJ string.");
    return wkt;
}

/// Returns true for the placeholders that GDAL derives from codes 0 and -1 (unknown CRS) of a GeoPackage and
/// writes on into other files. The degrees of the first are not real.
bool stands_for_none(OGRSpatialReferenceH crs) {
    const char* name = OSRGetName(crs);
    return name != nullptr && OSRGetAuthorityCode(crs, nullptr) == nullptr &&
           (EQUAL(name, "Undefined geographic SRS") || EQUAL(name, "Undefined Cartesian SRS") ||
            EQUAL(name, "Undefined SRS"));
}

}  // namespace

std::string wkt_of(OGRSpatialReferenceH crs) {
    if (crs == nullptr || OGRSpatialReference::FromHandle(crs)->IsEmpty() != FALSE || stands_for_none(crs))
        return {};
    constexpr std::array<const char*, 3> options{"FORMAT=WKT2_2019", "MULTILINE=NO", nullptr};
    char* text = nullptr;
    const OGRErr status = OSRExportToWktEx(crs, &text, options.data());
    const std::unique_ptr<char, GdalRelease<void*, VSIFree>> owner(text);
    // Repairs names, because those in GeoTIFF keys or a .prj may be in any encoding.
    return status == OGRERR_NONE && text != nullptr ? utf8_text(text) : "";
}

void set_crs(const std::string& own_wkt, const std::string& user_crs, DemInfo& info, Warnings& warnings) {
    info.crs_wkt = user_crs.empty() ? own_wkt : wkt_from_user(user_crs);
    const Crs crs(info.crs_wkt);
    require_plane(crs, user_crs.empty() ? "" : "-a_srs " + one_line(user_crs), info.name);
    if (!info.georeferenced && user_crs.empty() && crs.kind() == Crs::Kind::geographic) {
        info.crs_wkt.clear();
        warnings.add("'" + info.name + "' has a coordinate reference system in degrees, which columns and " +
                     "rows are not; it is left out.");
        return;
    }
    if (info.crs_wkt.empty())
        warnings.add("'" + info.name +
                     "' has no coordinate reference system; lengths are taken as plain units; " +
                     "give it with -a_srs.");
}

void read_crs(GDALDatasetH dataset, const std::string& user_crs, DemInfo& info, Warnings& warnings) {
    set_crs(user_crs.empty() ? wkt_of(GDALGetSpatialRef(dataset)) : "", user_crs, info, warnings);
}

CrsOwner horizontal_crs(const std::string& wkt) {
    if (wkt.empty())
        return nullptr;
    CrsOwner crs(OSRNewSpatialReference(wkt.c_str()));
    if (!crs)
        return crs;
    OSRSetAxisMappingStrategy(crs.get(), OAMS_TRADITIONAL_GIS_ORDER);
    if (OSRIsCompound(crs.get()) != FALSE)
        OSRStripVertical(crs.get());
    OSRDemoteTo2D(crs.get(), nullptr);
    return crs;
}

}  // namespace d2b
