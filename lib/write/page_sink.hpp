#pragma once

#include <cstdint>
#include <memory>

#include "dem2buildings/dem_source.hpp"
#include "dem2buildings/surfaces.hpp"
#include "write/raster_target.hpp"

namespace d2b {

/// Sinks of a page: buildings and ground.
struct Page {
    std::unique_ptr<SurfaceSink> surface;
    std::unique_ptr<RasterSink> relief;
};

/// Input data of a page.
struct PageSubject {
    const DemInfo& dem;
    bool terrain = true;  ///< true for a terrain, false for elevations that contain buildings
};

/// Writes one self-contained HTML file that shows the stack in a browser: page_parts() and the packed tiers
/// of all buildings. See docs/page.md. @param place of RasterFormat::page @param most largest file size in
/// bytes, because browsers become slow with more @throws OptionError if the library was built without pages
[[nodiscard]] Page open_page(RasterPlace place, const PageSubject& subject,
                             std::uint64_t most = std::uint64_t{64} << 20);

}  // namespace d2b
