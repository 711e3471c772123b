#pragma once

#include "core/crs.hpp"
#include "make_scene.hpp"
#include "support/memory_io.hpp"

namespace d2b::test {

/// A scene as its survey sees it, in UTM.
class SeenScene : public MemorySource {
  public:
    explicit SeenScene(const sample::Seen& seen)
        : MemorySource(seen.grid.rows, seen.grid.cols, {seen.elevations.begin(), seen.elevations.end()}) {
        edit().transform = seen.grid.transform;
        edit().crs_wkt = Crs("EPSG:25833").wkt();
        edit().georeferenced = true;
    }
};

}  // namespace d2b::test
