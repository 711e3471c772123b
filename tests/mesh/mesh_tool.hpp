#pragma once

#include <array>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "cli/cli_test_case.hpp"
#include "mesh/made_city.hpp"

namespace d2b::test {

/// An OBJ as the program writes it.
struct ReadMesh {
    std::vector<std::array<double, 3>> points;
    std::vector<std::array<std::size_t, 3>> triangles;
    std::vector<std::string> objects;  ///< of each triangle: "building_1/roof"

    /// Every edge once each way, by coordinates in single precision.
    [[nodiscard]] bool is_closed() const;
    [[nodiscard]] double volume() const;
    /// Area of the triangles of a group, as seen from above.
    [[nodiscard]] double plan_area(const std::string& object) const;
    [[nodiscard]] double smallest_plan_angle() const;  ///< degrees, of all that is not upright
    [[nodiscard]] double longest_edge() const;
};

/// Runs dem2buildings_mesh in an empty folder of its own.
class MeshTool : public CliTest {
  protected:
    [[nodiscard]] ToolResult mesh(const Arguments& arguments) const;
    /// All must be well. @return the report
    nlohmann::json mesh_well(Arguments arguments) const;
    void expect_refused(int status, const std::string& message, const Arguments& arguments) const;
    void city(const std::vector<MadeBlock>& blocks) const;  ///< as in.city.json
    [[nodiscard]] ReadMesh read(const std::string& name) const;
};

}  // namespace d2b::test
