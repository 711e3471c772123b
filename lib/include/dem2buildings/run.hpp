#pragma once

#include <vector>

#include "dem2buildings/callbacks.hpp"
#include "dem2buildings/commit_list.hpp"
#include "dem2buildings/dem_source.hpp"
#include "dem2buildings/options.hpp"
#include "dem2buildings/parcel_source.hpp"
#include "dem2buildings/report.hpp"
#include "dem2buildings/sinks.hpp"
#include "dem2buildings/surfaces.hpp"

namespace d2b {

/// What a run reads. All on the grid and in the window of the DEM.
struct Sources {
    DemSource& dem;
    DemSource* terrain = nullptr;  ///< of GroundMode::given, in the DEM's vertical unit
    DemSource* mask = nullptr;     ///< buildings are looked for where it is neither 0 nor invalid
    DemSource* ndvi = nullptr;
    ParcelSource* parcels = nullptr;  ///< cut buildings
};

/// Where a run writes to. Rasters are in metres.
struct Sinks {
    FeatureSink& features;
    RasterSink* ground = nullptr;
    RasterSink* height = nullptr;
    RasterSink* canopy = nullptr;             ///< heights of what is no building, 0 elsewhere
    RasterSink* elevations = nullptr;         ///< of the DEM, without what is no elevation; with every preset
    std::vector<SurfaceSink*> surfaces = {};  ///< each gets the surface in the form that it holds
};

/// The whole job: read -> ground -> detect -> levels -> trace -> filter -> outline -> attributes ->
/// surface -> write.
/// Reads the DEM twice (statistics, then contours), or once where it fits in memory. What sources and sinks
/// notice meanwhile is warned of with the rest; what they warned of when they were opened is not told again.
/// @param options  are checked first: what contradicts itself, or has no effect, is an OptionError
/// @param size     of bands; the result does not depend on it
/// @return what was done, found, dropped and repaired, and all that was warned of
/// @throws Error: nothing is visible at the sinks then, all of whose results show together (see CommitList)
RunReport run(const Options& options, const Sources& sources, const Sinks& sinks,
              const Callbacks& callbacks = {}, const BandSize& size = {});

/// As run(), but leaves the results of the sinks to `commit`, which may have others to show with them; sinks
/// may have more to warn of then. @throws Error
RunReport prepare_run(const Options& options, const Sources& sources, const Sinks& sinks, CommitList& commit,
                      const Callbacks& callbacks = {}, const BandSize& size = {});

}  // namespace d2b
