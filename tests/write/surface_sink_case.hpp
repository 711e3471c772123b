#pragma once

#include <cstdint>
#include <string>

#include "dem2buildings/surfaces.hpp"
#include "write/file_target.hpp"
#include "write/write_fixture.hpp"

namespace d2b::test {

/// Case for sinks of surfaces: a folder, and parts to write.
class SurfaceSinkCase : public WriteTest {
  protected:
    SurfaceSinkCase() {
        meta_.frame.scale = {0.5 / 1024, 0.5 / 1024, 0.001};
        meta_.frame.translate = {1000.25, 2000, 0};
        meta_.frame.origin = {1000, 2010, 7};
        meta_.provenance.metadata = {{"D2B_SOURCE", "a\nb\\.tif"}};
    }
    [[nodiscard]] writing::FileDestination place(const std::string& name, bool overwrite = false) const {
        return writing::resolve_file_target({path(name), overwrite, {}, writing::FileKind::surface});
    }
    [[nodiscard]] writing::FileDestination materials(const std::string& name, bool overwrite = false) const {
        return writing::resolve_file_target({path(name), overwrite, {}, writing::FileKind::materials});
    }
    /// Half of a tetrahedron, in two buildings: sinks do not look at its shape.
    static SurfacePart part(std::int64_t id) {
        SurfacePart part;
        part.points = {{0, 0, 7000}, {1024, 0, 7000}, {0, 2048, 7250}, {1, 0, 7001}};
        part.buildings.resize(2);
        part.buildings[0].id = id;
        part.buildings[0].triangles = {
            {FaceKind::ground, {0, 2, 1}}, {FaceKind::wall, {0, 1, 3}}, {FaceKind::wall, {1, 2, 3}}};
        part.buildings[1].id = id + 1;
        part.buildings[1].triangles = {{FaceKind::roof, {0, 3, 2}}};
        return part;
    }

    SurfaceMeta meta_;
};

}  // namespace d2b::test
