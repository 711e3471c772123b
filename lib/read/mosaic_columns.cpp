#include "read/mosaic_columns.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <string_view>

#include <cpl_conv.h>
#include <cpl_minixml.h>
#include <cpl_vsi.h>

namespace d2b {
namespace {

struct XmlRelease {
    void operator()(CPLXMLNode* node) const { CPLDestroyXMLNode(node); }
};
using XmlOwner = std::unique_ptr<CPLXMLNode, XmlRelease>;

/// Parses the XML of a VRT. Returns null if the dataset is not a VRT or so large that a mosaic opened once is
/// better.
XmlOwner description_of(GDALDatasetH dataset) {
    constexpr vsi_l_offset most_bytes = vsi_l_offset{4} << 20;
    const GDALDriverH driver = GDALGetDatasetDriver(dataset);
    if (driver == nullptr || std::string_view(GDALGetDriverShortName(driver)) != "VRT")
        return nullptr;
    VSIStatBufL status{};
    if (VSIStatL(GDALGetDescription(dataset), &status) != 0 ||
        static_cast<vsi_l_offset>(status.st_size) > most_bytes)
        return nullptr;
    const CSLConstList all = GDALGetMetadata(dataset, "xml:VRT");
    return XmlOwner(all == nullptr || *all == nullptr ? nullptr : CPLParseXMLString(*all));
}

/// Returns the band with this number if it is a plain mosaic band.
const CPLXMLNode* band_of(const CPLXMLNode* vrt, int band) {
    const CPLXMLNode* root = CPLGetXMLNode(vrt, "=VRTDataset");
    for (const CPLXMLNode* node = root != nullptr ? root->psChild : nullptr; node != nullptr;
         node = node->psNext)
        if (std::string_view(node->pszValue) == "VRTRasterBand" && --band == 0)
            return CPLGetXMLValue(node, "subClass", nullptr) == nullptr ? node : nullptr;
    return nullptr;
}

std::vector<ColumnSpan> rasters_of(const CPLXMLNode* band, std::int32_t cols) {
    std::vector<ColumnSpan> rasters;
    for (const CPLXMLNode* node = band->psChild; node != nullptr; node = node->psNext) {
        if (!std::string_view(node->pszValue).ends_with("Source"))
            continue;
        const auto number = [&](const char* name, double other) {
            const char* text = CPLGetXMLValue(node, name, nullptr);
            return text == nullptr ? other : CPLAtof(text);
        };
        const double first = number("DstRect.xOff", 0);
        const double end = first + number("DstRect.xSize", cols);
        const auto within = [&](double col) {
            return static_cast<std::int32_t>(std::clamp(col, 0.0, static_cast<double>(cols)));
        };
        const ColumnSpan span{within(std::floor(first)), within(std::ceil(end))};
        if (span[0] < span[1])
            rasters.push_back(span);
    }
    return rasters;
}

}  // namespace

std::vector<std::int32_t> divide_columns(std::vector<ColumnSpan> rasters, std::int32_t cols,
                                         const ColumnLimits& limits) {
    const std::size_t most = std::min(limits.most_columns, limits.most_rasters / (rasters.size() + 1));
    const std::int32_t least =
        std::max(limits.least_cells, most == 0 ? cols : cols / static_cast<std::int32_t>(most));
    std::ranges::sort(rasters);
    std::vector<std::int32_t> ends;
    std::int32_t begin = 0;
    std::int32_t covered = 0;  // by rasters that begin earlier
    for (const auto& [first, end] : rasters) {
        if (first >= covered && first - begin >= least && cols - first >= least)
            ends.push_back(begin = first);
        covered = std::max(covered, end);
    }
    ends.push_back(cols);
    return ends;
}

std::vector<std::int32_t> ends_of_columns(GDALDatasetH dataset, int band) {
    const std::int32_t cols = GDALGetRasterXSize(dataset);
    const XmlOwner vrt = description_of(dataset);
    const CPLXMLNode* const described = vrt == nullptr ? nullptr : band_of(vrt.get(), band);
    if (described == nullptr)
        return {cols};
    return divide_columns(rasters_of(described, cols), cols);
}

}  // namespace d2b
