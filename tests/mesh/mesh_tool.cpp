#include "mesh/mesh_tool.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <sstream>

namespace d2b::test {
namespace {

using Point = std::array<double, 3>;

double angle_at(const Point& at, const Point& b, const Point& c) {
    const double bx = b[0] - at[0];
    const double by = b[1] - at[1];
    const double cx = c[0] - at[0];
    const double cy = c[1] - at[1];
    return std::atan2(std::abs(bx * cy - by * cx), bx * cx + by * cy) * 180 / std::numbers::pi;
}

/// Twice the area, seen from above.
double twice_area(const Point& a, const Point& b, const Point& c) {
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

}  // namespace

bool ReadMesh::is_closed() const {
    using Corner = std::array<float, 3>;
    std::map<std::pair<Corner, Corner>, int> passed;
    const auto corner = [&](std::size_t i) {
        return Corner{static_cast<float>(points[i][0]), static_cast<float>(points[i][1]),
                      static_cast<float>(points[i][2])};
    };
    for (const auto& triangle : triangles)
        for (std::size_t i = 0; i < 3; ++i)
            ++passed[{corner(triangle[i]), corner(triangle[(i + 1) % 3])}];
    return !passed.empty() && std::ranges::all_of(passed, [&](const auto& item) {
        const auto back = passed.find({item.first.second, item.first.first});
        return item.second == 1 && back != passed.end();
    });
}

double ReadMesh::volume() const {
    double six = 0;
    for (const auto& [i, k, l] : triangles) {
        const Point& a = points[i];
        const Point& b = points[k];
        const Point& c = points[l];
        six += a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
               a[2] * (b[0] * c[1] - b[1] * c[0]);
    }
    return six / 6;
}

double ReadMesh::plan_area(const std::string& object) const {
    double sum = 0;
    for (std::size_t t = 0; t < triangles.size(); ++t)
        if (objects[t] == object)
            sum += twice_area(points[triangles[t][0]], points[triangles[t][1]], points[triangles[t][2]]) / 2;
    return sum;
}

double ReadMesh::smallest_plan_angle() const {
    double smallest = 180;
    for (std::size_t t = 0; t < triangles.size(); ++t)
        if (!objects[t].ends_with("/wall") && !objects[t].ends_with("/sides"))
            for (std::size_t i = 0; i < 3; ++i)
                smallest =
                    std::min(smallest, angle_at(points[triangles[t][i]], points[triangles[t][(i + 1) % 3]],
                                                points[triangles[t][(i + 2) % 3]]));
    return smallest;
}

double ReadMesh::longest_edge() const {
    double longest = 0;
    for (const auto& triangle : triangles)
        for (std::size_t i = 0; i < 3; ++i) {
            const Point& a = points[triangle[i]];
            const Point& b = points[triangle[(i + 1) % 3]];
            longest = std::max(longest, std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]));
        }
    return longest;
}

ToolResult MeshTool::mesh(const Arguments& arguments) const {
    Arguments command{D2B_MESH_TOOL};
    command.insert(command.end(), arguments.begin(), arguments.end());
    ToolSetup setup;
    setup.working_directory = folder_.string();
    return run_tool(command, setup);
}

nlohmann::json MeshTool::mesh_well(Arguments arguments) const {
    arguments.emplace_back("-json");
    const ToolResult result = mesh(arguments);
    EXPECT_EQ(result.status, 0);
    EXPECT_EQ(result.err, "");
    return result.status == 0 ? nlohmann::json::parse(result.out) : nlohmann::json();
}

void MeshTool::expect_refused(int status, const std::string& message, const Arguments& arguments) const {
    const std::vector<std::string> before = entries();
    const ToolResult result = mesh(arguments);
    EXPECT_EQ(result.status, status);
    EXPECT_EQ(result.err, "ERROR: " + message + "\n");
    EXPECT_EQ(result.out, "");
    EXPECT_EQ(entries(), before);
}

void MeshTool::city(const std::vector<MadeBlock>& blocks) const {
    write_text(path("in.city.json"), made_city(blocks).dump());
}

ReadMesh MeshTool::read(const std::string& name) const {
    ReadMesh mesh;
    std::istringstream lines(read_bytes(path(name)));
    std::string object;
    std::string group;
    for (std::string line; std::getline(lines, line);) {
        std::istringstream words(line);
        words.imbue(std::locale::classic());
        std::string word;
        words >> word;
        if (word == "v") {
            Point& point = mesh.points.emplace_back();
            words >> point[0] >> point[1] >> point[2];
        } else if (word == "o") {
            words >> object;
        } else if (word == "g") {
            words >> group;
        } else if (word == "f") {
            auto& triangle = mesh.triangles.emplace_back();
            for (std::size_t& corner : triangle) {
                words >> corner;
                --corner;
            }
            mesh.objects.push_back(object + "/" + group);
        }
    }
    return mesh;
}

}  // namespace d2b::test
