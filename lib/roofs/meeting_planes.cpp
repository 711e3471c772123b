#include "roofs/meeting_planes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <span>
#include <utility>

#include <Eigen/SparseCholesky>

namespace d2b::roofs {
namespace {

constexpr double steepest = 2.1445;          // slope of 65 degrees
constexpr double outside_m = 0.5;            // of a corner above or below the cells of its face
constexpr double meeting_weight = 1e6;       // of a corner in which planes meet, in cells
constexpr double level_weight = 1e9;         // of the slope of a level face
constexpr double small_step_m = 0.25;        // planes that are nearer than this at a corner meet there
constexpr double crease_step_m = 0.6;        // same where they cross at a steep angle
constexpr double crease_distance = 1.5;      // cells between a corner and the line in which its planes cross
constexpr int rounds = 8;
constexpr double met_m = 1e-3;

template <typename Use>
void for_corners(const FinePolygon& polygon, const Use& use) {
    for (const FinePoint& p : polygon.exterior)
        use(p);
    for (const FineRing& ring : polygon.interiors)
        for (const FinePoint& p : ring)
            use(p);
}

/// Normal equations of a face about its own centre: the unknowns are its slopes and the elevation there.
struct Normal {
    GridPoint centre;
    Eigen::Matrix3d matrix = Eigen::Matrix3d::Zero();
    Eigen::Vector3d right = Eigen::Vector3d::Zero();
    double low = std::numeric_limits<double>::infinity();
    double high = -std::numeric_limits<double>::infinity();

    void add(const GridPoint& p, double z, double weight) {
        const Eigen::Vector3d row(p.x - centre.x, p.y - centre.y, 1);
        matrix += weight * row * row.transpose();
        right += weight * z * row;
    }
};

GridPoint cell_centre(const BuildingGrid& grid, std::size_t cell) {
    const auto width = static_cast<std::size_t>(grid.cols);
    return {grid.x(static_cast<double>(cell % width) + 0.5), grid.y(static_cast<double>(cell / width) + 0.5)};
}

/// Equations of all faces of a building.
class PlaneSystem {
  public:
    PlaneSystem(const std::vector<LabelledFace>& faces, const std::vector<Plane>& first,
                const std::vector<std::vector<std::size_t>>& cells, const BuildingGrid& grid,
                const RoofLattice& lattice);

    /// Two faces that share a corner.
    struct Meeting {
        std::int32_t one;
        std::int32_t other;
        GridPoint at;

        friend bool operator==(const Meeting& a, const Meeting& b) {
            return a.one == b.one && a.other == b.other && a.at.x == b.at.x && a.at.y == b.at.y;
        }
    };
    void solve(std::span<const Meeting> meetings, std::vector<FacePlane>& planes) const;
    /// True if a plane suits its cells.
    [[nodiscard]] bool is_plausible(std::size_t face, const Plane& plane) const;

  private:
    const BuildingGrid& grid_;
    std::vector<Normal> normals_;
    std::vector<std::vector<GridPoint>> corners_;  ///< by face
};

PlaneSystem::PlaneSystem(const std::vector<LabelledFace>& faces, const std::vector<Plane>& first,
                         const std::vector<std::vector<std::size_t>>& cells, const BuildingGrid& grid,
                         const RoofLattice& lattice)
    : grid_(grid), normals_(faces.size()), corners_(faces.size()) {
    constexpr double near_m = 0.5;        // residual of cells that count fully
    constexpr double far_weight = 0.02;
    for (std::size_t i = 0; i < faces.size(); ++i) {
        Normal& normal = normals_[i];
        for_corners(faces[i].outline, [&](FinePoint p) { corners_[i].push_back(lattice.position(p)); });
        for (const GridPoint& p : corners_[i]) {
            normal.centre.x += p.x / static_cast<double>(corners_[i].size());
            normal.centre.y += p.y / static_cast<double>(corners_[i].size());
        }
        for (const std::size_t cell : cells[i]) {
            const double z = grid.elevations[cell];
            if (std::isnan(z))
                continue;
            const GridPoint p = cell_centre(grid, cell);
            normal.add(p, z, std::abs(z - first[i].at(p.x, p.y)) < near_m ? 1 : far_weight);
            normal.low = std::min(normal.low, z);
            normal.high = std::max(normal.high, z);
        }
        // The plane of the whole segment, which may have more cells.
        const Eigen::Vector3d prior(first[i].slope_x, first[i].slope_y,
                                    first[i].at(normal.centre.x, normal.centre.y));
        const Eigen::Vector3d weight(0.5, 0.5, 0.1);
        normal.matrix += weight.asDiagonal();
        normal.right += weight.cwiseProduct(prior);
    }
}

void PlaneSystem::solve(std::span<const Meeting> meetings, std::vector<FacePlane>& planes) const {
    using Sparse = Eigen::SparseMatrix<double>;
    std::vector<Eigen::Triplet<double, int>> entries;
    const auto unknowns = static_cast<Eigen::Index>(3 * normals_.size());
    Eigen::VectorXd right(unknowns);
    const auto add_block = [&](int row, int col, const Eigen::Matrix3d& block) {
        for (int r = 0; r < 3; ++r)
            for (int c = 0; c < 3; ++c)
                entries.emplace_back(row + r, col + c, block(r, c));
    };
    for (std::size_t i = 0; i < normals_.size(); ++i) {
        const int at = static_cast<int>(3 * i);
        Eigen::Matrix3d matrix = normals_[i].matrix;
        Eigen::Vector3d vector = normals_[i].right;
        if (planes[i].level) {
            matrix(0, 0) += level_weight;
            matrix(1, 1) += level_weight;
        }
        add_block(at, at, matrix);
        right.segment<3>(at) = vector;
    }
    for (const Meeting& meeting : meetings) {
        const GridPoint& a = normals_[static_cast<std::size_t>(meeting.one)].centre;
        const GridPoint& b = normals_[static_cast<std::size_t>(meeting.other)].centre;
        const Eigen::Vector3d one(meeting.at.x - a.x, meeting.at.y - a.y, 1);
        const Eigen::Vector3d other(meeting.at.x - b.x, meeting.at.y - b.y, 1);
        add_block(3 * meeting.one, 3 * meeting.one, meeting_weight * one * one.transpose());
        add_block(3 * meeting.other, 3 * meeting.other, meeting_weight * other * other.transpose());
        add_block(3 * meeting.one, 3 * meeting.other, -meeting_weight * one * other.transpose());
        add_block(3 * meeting.other, 3 * meeting.one, -meeting_weight * other * one.transpose());
    }
    Sparse matrix(unknowns, unknowns);
    matrix.setFromTriplets(entries.begin(), entries.end());
    const Eigen::SimplicialLDLT<Sparse> factors(matrix);
    const Eigen::VectorXd solution = factors.solve(right);
    for (std::size_t i = 0; i < normals_.size(); ++i) {
        const auto at = static_cast<Eigen::Index>(3 * i);
        Plane& plane = planes[i].plane;
        plane.slope_x = planes[i].level ? 0 : solution[at];
        plane.slope_y = planes[i].level ? 0 : solution[at + 1];
        const GridPoint& c = normals_[i].centre;
        plane.z0 = solution[at + 2] - plane.slope_x * c.x - plane.slope_y * c.y;
    }
}

bool PlaneSystem::is_plausible(std::size_t face, const Plane& plane) const {
    if (std::hypot(plane.slope_x, plane.slope_y) > steepest * grid_.cell_m)
        return false;
    const Normal& normal = normals_[face];
    if (normal.low > normal.high)
        return false;
    return std::ranges::all_of(corners_[face], [&](const GridPoint& p) {
        const double z = plane.at(p.x, p.y);
        return z >= normal.low - outside_m && z <= normal.high + outside_m;
    });
}

/// Corners in which neighbouring faces should meet.
std::vector<PlaneSystem::Meeting> meetings_of(const std::vector<FaceEdge>& edges, const std::vector<FacePlane>& planes,
                                              const RoofLattice& lattice) {
    std::vector<PlaneSystem::Meeting> meetings;
    std::map<std::pair<std::pair<std::int32_t, std::int32_t>, FinePoint>, bool> seen;
    for (const FaceEdge& edge : edges) {
        if (edge.left < 0 || edge.right < 0)
            continue;
        const auto [one, other] = std::minmax(edge.left, edge.right);
        const Plane& a = planes[static_cast<std::size_t>(one)].plane;
        const Plane& b = planes[static_cast<std::size_t>(other)].plane;
        const double bend = std::hypot(a.slope_x - b.slope_x, a.slope_y - b.slope_y);
        const double largest = std::min(crease_step_m, std::max(small_step_m, crease_distance * bend));
        for (const FinePoint& end : {edge.from, edge.to}) {
            const GridPoint p = lattice.position(end);
            if (std::abs(a.at(p.x, p.y) - b.at(p.x, p.y)) >= largest)
                continue;
            if (seen.emplace(std::pair(std::pair(one, other), end), true).second)
                meetings.push_back({one, other, p});
        }
    }
    return meetings;
}

}  // namespace

std::vector<FacePlane> meeting_planes(const std::vector<LabelledFace>& faces, const std::vector<FaceEdge>& edges,
                                      const std::vector<Plane>& first,
                                      const std::vector<std::vector<std::size_t>>& cells,
                                      const BuildingGrid& grid, const RoofLattice& lattice) {
    const PlaneSystem system(faces, first, cells, grid, lattice);
    std::vector<FacePlane> planes;
    for (std::size_t i = 0; i < faces.size(); ++i)
        planes.push_back({first[i], !system.is_plausible(i, first[i])});
    for (std::size_t i = 0; i < faces.size(); ++i)
        if (planes[i].level)
            planes[i].plane = {};
    std::vector<PlaneSystem::Meeting> meetings;
    system.solve(meetings, planes);
    for (int round = 0; round < rounds; ++round) {
        std::vector<PlaneSystem::Meeting> found = meetings_of(edges, planes, lattice);
        bool changed = found != meetings;
        meetings = std::move(found);
        system.solve(meetings, planes);
        for (std::size_t i = 0; i < faces.size(); ++i)
            if (!planes[i].level && !system.is_plausible(i, planes[i].plane))
                changed = planes[i].level = true;
        if (!changed)
            break;
    }
    return planes;
}

std::vector<std::vector<double>> corner_elevations(const std::vector<LabelledFace>& faces,
                                                   const std::vector<FacePlane>& planes,
                                                   const RoofLattice& lattice) {
    struct Corner {
        FinePoint point;
        std::size_t face;
        std::size_t index;
        double z;
    };
    std::vector<Corner> corners;
    std::vector<std::vector<double>> elevations(faces.size());
    for (std::size_t i = 0; i < faces.size(); ++i) {
        std::size_t index = 0;
        for_corners(faces[i].outline, [&](FinePoint p) {
            const GridPoint at = lattice.position(p);
            corners.push_back({p, i, index++, planes[i].plane.at(at.x, at.y)});
        });
        elevations[i].resize(index);
    }
    std::ranges::sort(corners, {}, [](const Corner& c) { return std::tuple(c.point, c.z, c.face, c.index); });
    for (std::size_t first = 0; first < corners.size();) {
        std::size_t end = first + 1;
        double sum = corners[first].z;
        while (end < corners.size() && corners[end].point == corners[first].point &&
               corners[end].z - corners[end - 1].z < met_m)
            sum += corners[end++].z;
        for (std::size_t k = first; k < end; ++k)
            elevations[corners[k].face][corners[k].index] = sum / static_cast<double>(end - first);
        first = end;
    }
    return elevations;
}

}  // namespace d2b::roofs
