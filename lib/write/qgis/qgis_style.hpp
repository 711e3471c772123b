#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "dem2buildings/sinks.hpp"

namespace d2b::writing {

/// Layer created by this run.
struct NewLayer {
    const LayerSpec& spec;
    std::string table;                 ///< name given by the driver
    std::string geometry;              ///< geometry column
    std::vector<std::string> columns;  ///< column name per field of the spec
    std::vector<double> heights{};     ///< values of the field that determines the colour
};

/// First line of our styles. QGIS does not keep it, so a style saved by a user is recognized as the user's.
inline constexpr std::string_view style_signature = "<!-- The default style of dem2buildings -->\n";

/// Returns the QML document by which QGIS (3.16 and later) shows a layer: symbols, labels, 3D solids and
/// field aliases. @param columns of the layer, one per field of the spec, because formats may have shortened
/// the names
[[nodiscard]] std::string qml_style(const LayerSpec& spec, const std::vector<std::string>& columns);

/// Style under a name, by which QGIS lists it.
struct NamedStyle {
    std::string name;
    std::string title;
    std::string qml;
};
/// Names of all styles that a layer may get.
inline constexpr std::string_view default_style_name = "dem2buildings";
inline constexpr std::string_view sun_style_name = "dem2buildings solar";
inline constexpr std::string_view quantile_style_name = "dem2buildings quantiles";
/// Returns the styles of a layer, the default one first.
[[nodiscard]] std::vector<NamedStyle> qml_styles(const NewLayer& layer);

/// Returns title, abstract and lineage of a layer as QGIS metadata (XML).
[[nodiscard]] std::string qgis_metadata(const LayerSpec& spec, const Provenance& provenance);

/// Writes <layer>.qml next to a Shapefile that is not packed, which QGIS uses as its style. Failures are
/// ignored, because the result is complete without it. @param path of the dataset, a .shp or a folder of them
void write_style_sidecar(const std::string& path, const NewLayer& layer);

/// True if the file is a style that we wrote and nobody has changed.
[[nodiscard]] bool is_our_style(const std::filesystem::path& file);

/// Keeps styles of the user next to the destination: if the result is a folder, they replace our styles in
/// it; if it is a single file, our styles are deleted. @param result dataset as written
/// @param destination .shp or folder that it will become @param replaces true if the destination exists and
/// is replaced, including our style
void keep_user_styles(const std::filesystem::path& result, const std::filesystem::path& destination,
                      bool replaces);

}  // namespace d2b::writing
