#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "dem2buildings/feature_sink.hpp"
#include "options/run_plan.hpp"

namespace d2b {

/// Where each layer stands in a list; nothing where it is not written.
struct LayerPlaces {
    std::optional<std::size_t> buildings;
    std::optional<std::size_t> contours;
    std::optional<std::size_t> doubtful;
    std::optional<std::size_t> rejected;
};

/// The layers of a run, in the order in which they are written, without their styles.
struct LayerSpecs {
    std::vector<LayerSpec> layers;
    LayerPlaces places;
};

/// What the words and fields of layers depend on.
struct LayerTerms {
    std::string source;         ///< name of the DEM
    std::string vertical_unit;  ///< its name
    bool reprojected = false;   ///< arcs are none then: a circle of one CRS is none in another
};

/// @param options layers resolved @param sink knows what the destination calls its layers
[[nodiscard]] LayerSpecs layer_specs(const RunPlan& plan, const LayerTerms& terms, const FeatureSink& sink);

}  // namespace d2b
