#pragma once

#include <cstdint>
#include <memory>

#include "dem2buildings/dem_source.hpp"
#include "dem2buildings/surfaces.hpp"
#include "write/raster_target.hpp"

namespace d2b {

/// A page and where its ground goes.
struct Page {
    std::unique_ptr<SurfaceSink> surface;
    std::unique_ptr<RasterSink> relief;
};

/// What a page is about.
struct PageSubject {
    const DemInfo& dem;
    bool terrain = true;  ///< whether its ground is a terrain, else elevations with buildings in them
};

/// One HTML file that shows the stack in a browser and reads nothing else: the parts of page_parts(), and the
/// tiers of all buildings as packed whole numbers. docs/page.md says what is in it.
/// @param place of RasterFormat::page @param most bytes of the file; browsers become slow with more
/// @throws OptionError where the library was built without pages
[[nodiscard]] Page open_page(RasterPlace place, const PageSubject& subject,
                             std::uint64_t most = std::uint64_t{64} << 20);

}  // namespace d2b
