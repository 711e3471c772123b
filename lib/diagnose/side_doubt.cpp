#include "diagnose/side_doubt.hpp"

namespace d2b {

std::string empty_side_doubt(const SidesKnown& known, const Options& options) {
    if (!known.terrain)
        return "the terrain '" + options.ground.terrain +
               "' has no valid cell over the DEM; give one of the same place with -ground, or leave -ground "
               "out to have the ground estimated";
    if (!known.mask)
        return "the mask '" + options.detect.mask +
               "' has no cell over the DEM that is neither 0 nor NoData; give one with -mask that marks "
               "where "
               "buildings may be";
    return {};
}

std::string ndvi_doubt(const SidesKnown& known, const Options& options) {
    if (known.ndvi)
        return {};
    return "the NDVI '" + options.detect.ndvi +
           "' has no valid cell over the DEM, so it tells no plants; give one of the same place with -ndvi";
}

}  // namespace d2b
