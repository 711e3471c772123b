#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "dem2buildings/sinks.hpp"
#include "options/run_plan.hpp"

namespace d2b {

/// Index of each layer in the list of layers; nullopt if it is not written.
struct LayerPlaces {
    std::optional<std::size_t> buildings;
    std::optional<std::size_t> contours;
    std::optional<std::size_t> doubtful;
    std::optional<std::size_t> rejected;
    std::optional<std::size_t> problems;

    [[nodiscard]] std::optional<std::size_t> of_building(bool is_doubtful) const {
        return is_doubtful ? doubtful : buildings;
    }
};

/// Layers of a run in the order of writing, without styles.
struct LayerSpecs {
    std::vector<LayerSpec> layers;
    LayerPlaces places;
};

/// @param source name of the DEM @param vertical_unit its name
/// @param sink gives the names of the layers in the destination
[[nodiscard]] LayerSpecs layer_specs(const RunPlan& plan, const std::string& source,
                                     const std::string& vertical_unit, const FeatureSink& sink);

}  // namespace d2b
