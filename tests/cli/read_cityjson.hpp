#pragma once

#include <map>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "dem2buildings/surfaces.hpp"

namespace d2b::test {

/// A CityJSON as a program reads it that knows nothing of ours.
struct ReadCityJson {
    nlohmann::json root;
    std::vector<SurfacePart>
        solids;  ///< a building each; their corners are the vertices, as they stand there

    std::map<std::string, std::vector<std::string>> parts;    ///< names, by those of divided buildings
    std::map<std::string, std::vector<std::string>> parents;  ///< by names of parts

    [[nodiscard]] const nlohmann::json& attributes(std::int64_t building) const;
    /// Volume in cubic units of the CRS.
    [[nodiscard]] double volume() const;
    [[nodiscard]] double volume_of(const SurfacePart& solid) const;
    /// Area as seen from above.
    [[nodiscard]] double plan_area(FaceKind kind) const;
    [[nodiscard]] SurfaceFrame frame() const;
};

/// Fails the test where it is no CityJSON of Buildings with a Solid each or with BuildingParts that have one,
/// and name each other; has a number of a vertex that is
/// not there, or a vertex that no face has, or has one twice; and where a solid is not closed, by fault_of().
[[nodiscard]] ReadCityJson read_cityjson(const std::string& path);

}  // namespace d2b::test
