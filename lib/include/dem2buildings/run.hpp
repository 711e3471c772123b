#pragma once

#include <vector>

#include "dem2buildings/callbacks.hpp"
#include "dem2buildings/commit_list.hpp"
#include "dem2buildings/correction_source.hpp"
#include "dem2buildings/dem_source.hpp"
#include "dem2buildings/footprint_source.hpp"
#include "dem2buildings/options.hpp"
#include "dem2buildings/parcel_source.hpp"
#include "dem2buildings/report.hpp"
#include "dem2buildings/sinks.hpp"
#include "dem2buildings/surfaces.hpp"

namespace d2b {

/// Inputs of a run, all on the grid and in the window of the DEM.
struct Sources {
    DemSource& dem;
    DemSource* terrain = nullptr;  ///< needed for GroundMode::given, in the DEM's vertical unit
    DemSource* mask = nullptr;     ///< buildings are searched in cells that are neither 0 nor invalid
    DemSource* ndvi = nullptr;
    ParcelSource* parcels = nullptr;        ///< cut buildings
    FootprintSource* footprints = nullptr;  ///< get heights, instead of outlines of found buildings
    DemSource* exclusion = nullptr;         ///< objects half of whose cells are not 0 here are not buildings
    CorrectionSource* corrections = nullptr;  ///< an editor's decisions
};

/// Outputs of a run. Rasters are in metres.
struct Sinks {
    FeatureSink& features;
    RasterSink* ground = nullptr;
    RasterSink* height = nullptr;
    RasterSink* canopy = nullptr;             ///< heights of everything except buildings, 0 elsewhere
    RasterSink* elevations = nullptr;         ///< valid elevations of the DEM, with every preset
    std::vector<SurfaceSink*> surfaces = {};  ///< each gets the surface in its own form
};

/// Runs the complete job: read -> ground -> detect -> levels -> trace -> filter -> outline -> attributes ->
/// surface -> write.
///
/// Reads the DEM twice (statistics, then contours), or once if it fits in memory. Warnings of sources and
/// sinks during the run are included; those from opening them are not repeated. For files, extract_file()
/// also opens sources and sinks.
/// @param options checked first: a contradictory or ineffective option is an OptionError
/// @param size of bands; does not affect the result
/// @return everything done, found, dropped and repaired, with all warnings
/// @throws Error; nothing is visible at the sinks then, because all results become visible together (see
/// CommitList)
RunReport run(const Options& options, const Sources& sources, const Sinks& sinks,
              const Callbacks& callbacks = {}, const BandSize& size = {});

/// Same as run(), but leaves publishing the results to `commit`, which may hold others. Sinks may add
/// warnings then. @throws Error
RunReport prepare_run(const Options& options, const Sources& sources, const Sinks& sinks, CommitList& commit,
                      const Callbacks& callbacks = {}, const BandSize& size = {});

}  // namespace d2b
