#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/crs.hpp"
#include "core/georeference.hpp"
#include "dem2buildings/dem_source.hpp"
#include "dem2buildings/report.hpp"
#include "dem2buildings/sinks.hpp"
#include "options/run_plan.hpp"

namespace d2b::features {

/// Index of each layer in the list of layers; nullopt if it is not written.
struct LayerIndices {
    std::optional<std::size_t> buildings;
    std::optional<std::size_t> contours;
    std::optional<std::size_t> roofs;
    std::optional<std::size_t> doubtful;
    std::optional<std::size_t> rejected;
    std::optional<std::size_t> problems;
    // With given footprints, `buildings` are those that were found besides them, and `contours` is not set.
    std::optional<std::size_t> given;
    std::optional<std::size_t> given_contours;
    std::optional<std::size_t> given_roofs;

    [[nodiscard]] std::optional<std::size_t> building_layer(bool is_low_confidence) const {
        return is_low_confidence ? doubtful : buildings;
    }
};

/// Layers of a run in the order of writing, without styles.
struct LayerSpecs {
    std::vector<LayerSpec> layers;
    LayerIndices indices;
};

/// @param source name of the DEM @param vertical_unit its name
/// @param sink gives the names of the layers in the destination @param original layer of the given
/// footprints; null without
[[nodiscard]] LayerSpecs layer_specs(const RunPlan& plan, const std::string& source,
                                     const std::string& vertical_unit, const FeatureSink& sink,
                                     const std::shared_ptr<const OriginalLayer>& original = nullptr);

/// State of a run before any elevation is read: decided options, CRSs, geometry of the grid, layers.
struct RunSetup {
    RunPlan plan;
    const DemInfo& dem;
    Crs crs;
    Crs target;  ///< kind none: the CRS of the DEM
    Georeference georeference;
    SquareArea area;
    CellSize cell;      ///< set only if buildings are detected
    LayerSpecs layers;  ///< styles are added later

    /// Returns the side in metres of a square with the area of a cell.
    [[nodiscard]] double cell_m() const { return cell_size_m(dem.window, area); }
    /// Returns the CRS of the output.
    [[nodiscard]] const Crs& written() const { return target.kind() == Crs::Kind::none ? crs : target; }
};

/// Describes the origin of a dataset: source, options that reproduce it, decided values, thresholds, units
/// and version. Contains nothing that changes from run to run.
[[nodiscard]] Provenance make_provenance(const RunSetup& setup, const RunReport& report);

}  // namespace d2b::features
