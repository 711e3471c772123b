#include "read/fetch_gate.hpp"

#include <algorithm>
#include <span>
#include <string_view>

#include <cpl_conv.h>
#include <cpl_error.h>
#include <cpl_http.h>
#include <cpl_string.h>
#include <cpl_vsi.h>

namespace d2b::reading {
namespace {

/// Formats whose files are lists of addresses.
constexpr std::array<const char*, 17> address_list_formats{
    "VRT",    "OGR_VRT", "GTI",      "WMS",      "WMTS", "WCS",   "WFS", "OAPIF", "OGCAPI",
    "STACTA", "STACIT",  "PLMOSAIC", "PLSCENES", "EEDA", "EEDAI", "CSW", nullptr};

/// Prefixes of GDAL dataset names that denote a server.
constexpr std::array services{
    "WMS:", "WMTS:",    "WCS:",     "WFS:",      "OAPIF:",    "OGCAPI:", "STACTA:",     "STACIT:",
    "CSW:", "EEDA:",    "EEDAI:",   "PLMOSAIC:", "PLSCENES:", "CARTO:",  "AMIGOCLOUD:", "NGW:",
    "ES:",  "ELASTIC:", "COUCHDB:", "CLOUDANT:", "GNM:",      "DAAS:"};

bool begins_with(const std::string& name, const char* beginning) {
    return EQUALN(name.c_str(), beginning, std::string_view(beginning).size());
}

/// Returns "host:80" of the first address in a text, or "" if there is none.
std::string server_in(const std::string& text) {
    for (const std::string_view scheme : {"http://", "https://", "ftp://"})
        if (const auto at = text.find(scheme); at != std::string::npos) {
            const auto begin = at + scheme.size();
            return text.substr(begin, text.find_first_of("/?#&\"'<> ", begin) - begin);
        }
    return "";
}

/// Returns which of the formats a name or file is of, by its beginning; "" if it is of none. Streams are left
/// alone, because looking at their beginning would consume it. @param formats ends with nullptr
std::string format_among(std::span<const char* const> formats, const std::string& name) {
    VSIStatBufL status;
    const bool looks = name.starts_with('<') ||
                       (VSIStatExL(name.c_str(), &status, VSI_STAT_EXISTS_FLAG | VSI_STAT_NATURE_FLAG) == 0 &&
                        VSI_ISREG(status.st_mode) != 0);
    const GDALDriverH driver =
        looks ? GDALIdentifyDriverEx(name.c_str(), GDAL_OF_RASTER | GDAL_OF_VECTOR, formats.data(), nullptr)
              : nullptr;
    return driver != nullptr ? GDALGetDriverShortName(driver) : "";
}

/// Returns true if the response would be parsed as a CRS definition: OSRImportFromUrl() accepts OGC WKT or,
/// from GDAL 3.10 on, sets nothing but a timeout.
bool asks_for_a_crs(CSLConstList options) {
    const char* headers = CSLFetchNameValue(options, "HEADERS");
    const char* timeout = CSLFetchNameValue(options, "TIMEOUT");
    return (headers != nullptr && std::string_view(headers).find("ogcwkt") != std::string_view::npos) ||
           (CSLCount(options) == 1 && timeout != nullptr && EQUAL(timeout, "10"));
}

CPLHTTPResult* refused(const char* address) {
    CPLError(CE_Warning, CPLE_AppDefined,
             "the file refers to %s, which is not fetched: only addresses that you name are", address);
    auto* const result = static_cast<CPLHTTPResult*>(CPLCalloc(1, sizeof(CPLHTTPResult)));
    result->nStatus = 1;
    result->pszErrBuf = CPLStrdup("the address is not fetched");
    return result;
}

CPLHTTPResult* allow_or_refuse(const char* address, CSLConstList options, GDALProgressFunc /*progress*/,
                               void* /*of_progress*/, CPLHTTPFetchWriteFunc /*write*/, void* /*of_write*/,
                               void* gate) {
    const bool passes = !asks_for_a_crs(options) && static_cast<NetworkGuard*>(gate)->allows(address);
    return passes ? nullptr : refused(address);  // nullptr lets GDAL fetch the address itself
}

CPLStringList other_drivers(const char* without) {
    CPLStringList names;
    for (int i = 0; i < GDALGetDriverCount(); ++i)
        if (const char* name = GDALGetDriverShortName(GDALGetDriver(i)); !EQUAL(name, without))
            names.AddString(name);
    return names;
}

}  // namespace

NetworkGuard::Fetching NetworkGuard::access_of(const std::string& name) {
    if (std::ranges::any_of(services, [&](const char* service) { return begins_with(name, service); }))
        return Fetching::any;
    const bool text = name.starts_with('{') || name.starts_with('<');
    if (!text && !server_in(name).empty())
        return Fetching::one_server;
    if (!text && std::ranges::any_of(remote_prefixes, [&](const char* store) {
            return name.find(store) != std::string::npos;
        }))
        return Fetching::any;
    return Fetching::none;
}

NetworkGuard::NetworkGuard(const std::string& name) : name_(name), fetching_(access_of(name)) {
    if (fetching_ == Fetching::none && !format_among(address_list_formats, name).empty())
        fetching_ = Fetching::any;
    close();
}

NetworkGuard::NetworkGuard(GDALDatasetH dataset)
    : name_(dataset != nullptr ? GDALGetDescription(dataset) : ""), fetching_(access_of(name_)) {
    const GDALDriverH driver = dataset != nullptr ? GDALGetDatasetDriver(dataset) : nullptr;
    const std::string format = driver != nullptr ? GDALGetDriverShortName(driver) : "";
    if (std::ranges::any_of(address_list_formats,
                            [&](const char* list) { return list != nullptr && format == list; }))
        fetching_ = Fetching::any;
    close();
}

void NetworkGuard::close() {
    CPLHTTPPushFetchCallback(allow_or_refuse, this);
    // "none" matches no remote file that GDAL reads in ranges.
    if (fetching_ == Fetching::none)
        no_files_.emplace("CPL_VSIL_CURL_ALLOWED_FILENAME", "none", false);
}

NetworkGuard::~NetworkGuard() {
    CPLHTTPPopFetchCallback();
}

bool NetworkGuard::allows(const std::string& address) const {
    return fetching_ == Fetching::any ||
           (fetching_ == Fetching::one_server && server_in(address) == server_in(name_));
}

std::string missing_file_system(const std::string& name) {
    const CPLStringList prefixes(VSIGetFileSystemsPrefixes());
    const std::span known(prefixes.List(), static_cast<std::size_t>(prefixes.Count()));
    for (const char* prefix : remote_prefixes)
        if (name.find(prefix) != std::string::npos && std::ranges::none_of(known, [&](const char* system) {
                return std::string_view(system).starts_with(prefix);
            }))
            return "this program was built without " + std::string(prefix) + "/; download the file";
    return {};
}

DatasetOwner open_guarded(const std::string& name, unsigned flags, const char* const* drivers,
                          const char* const* open_options) {
    const NetworkGuard gate(name);
    const bool any_raster =
        drivers == nullptr && ((flags & GDAL_OF_RASTER) != 0 || (flags & GDAL_OF_VECTOR) == 0);
    constexpr std::array<const char*, 3> treated_formats{"KMLSUPEROVERLAY", "GPKG", nullptr};
    const std::string format = format_among(treated_formats, name);
    CPLStringList others;
    // Images of a KML superoverlay may lie on any server, and its driver fetches them in a way that cannot be
    // intercepted.
    if (any_raster && gate.blocks_all() && format == "KMLSUPEROVERLAY") {
        others = other_drivers("KMLSUPEROVERLAY");
        drivers = others.List();
    }
    std::optional<NoSidecar> no_sidecar;
    if (format == "GPKG")
        no_sidecar.emplace();  // as when it is closed, see close_dataset()
    // Keep the driver of GML from leaving a .gfs beside what it reads; @ makes other drivers skip the option.
    CPLStringList options(CSLDuplicate(open_options));
    options.AddString("@WRITE_GFS=NO");
    DatasetOwner dataset(GDALOpenEx(name.c_str(), flags, drivers, options.List(), nullptr));
    if (dataset && no_sidecar)
        GDALGetMetadata(dataset.get(),
                        nullptr);  // because the option is asked for when metadata are first read
    return dataset;
}

}  // namespace d2b::reading
