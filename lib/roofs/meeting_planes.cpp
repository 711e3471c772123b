#include "roofs/meeting_planes.hpp"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <set>
#include <span>
#include <tuple>
#include <utility>

#include "core/disjoint_sets.hpp"
#include "core/for_rings.hpp"
#include "core/statistics.hpp"

namespace d2b::roofs {
namespace {

constexpr double steepest = 2.1445;      // slope of 65 degrees
constexpr double outside_m = 0.5;        // of a corner above or below the cells of its face
constexpr double first_weight = 100;     // of a corner in which planes should meet, in cells
constexpr double met_softly_m = 0.05;    // step that is left where planes can meet
constexpr double meeting_weight = 1e6;   // of a corner in which planes meet, in cells
constexpr double fixed_weight = 1e9;     // of a slope that is given
constexpr double small_step_m = 0.25;    // planes that are nearer than this at a corner meet there
constexpr double crease_step_m = 0.6;    // same where they cross at a steep angle
constexpr double crease_distance = 1.5;  // cells between a corner and the line in which its planes cross
constexpr int rounds = 8;
constexpr int pulls = 4;  // towards meetings, each with twice the weight
constexpr double met_m = 1e-3;
constexpr double max_cost_m2 = 0.04;  // mean squared error that meeting its neighbours may add to a face

template <typename Use>
void for_corners(const FinePolygon& polygon, const Use& use) {
    for_rings(polygon, [&](const FineRing& ring) { std::ranges::for_each(ring, use); });
}

/// Normal equations of a face about its own centre: the unknowns are its slopes and the elevation there.
struct Normal {
    Vec2 centre;
    Eigen::Matrix3d matrix = Eigen::Matrix3d::Zero();
    Eigen::Vector3d right = Eigen::Vector3d::Zero();
    double squares = 0;
    double weights = 0;  ///< of cells, without the prior
    double low = std::numeric_limits<double>::infinity();
    double high = -std::numeric_limits<double>::infinity();

    void add(const Vec2& p, double z, double weight) {
        const Eigen::Vector3d row(p.x - centre.x, p.y - centre.y, 1);
        matrix += weight * row * row.transpose();
        right += weight * z * row;
        squares += weight * z * z;
        weights += weight;
    }
    /// Mean squared error in m2 of a plane.
    [[nodiscard]] double error(const Plane& plane) const {
        const Eigen::Vector3d x(plane.slope_x, plane.slope_y, plane.at(centre.x, centre.y));
        return weights > 0 ? (x.dot(matrix * x) - 2 * right.dot(x) + squares) / weights : 0;
    }
};

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
        Vec2 at;
        double weight = 1;

        /// Step in m between the two planes.
        [[nodiscard]] double step(const std::vector<FacePlane>& planes) const {
            return std::abs(planes[static_cast<std::size_t>(one)].plane.at(at.x, at.y) -
                            planes[static_cast<std::size_t>(other)].plane.at(at.x, at.y));
        }
    };
    void solve(std::span<const Meeting> meetings, std::vector<FacePlane>& planes) const;
    /// Share of its slope that a plane may keep such that no corner is far above or below the cells of its
    /// face; 0 if it has to be level.
    [[nodiscard]] double plausible_slope(std::size_t face, const Plane& plane) const;
    /// Makes a face level at the median of its cells, because cells of walls would tilt or lower it.
    void level(std::size_t face, FacePlane& plane);
    /// Removes, of each face to which meeting its neighbours costs too much, the meeting with the highest
    /// step between the planes that fit best. @return false if there was none
    bool drop_costly(const std::vector<FacePlane>& best, const std::vector<FacePlane>& planes,
                     std::vector<Meeting>& meetings) const;

  private:
    /// Sets the equations of a face. @param plane cells near it count fully
    void set_normal(std::size_t face, const Plane& plane);

    const BuildingGrid& grid_;
    const std::vector<std::vector<std::size_t>>& cells_;
    std::vector<Normal> normals_;
    std::vector<std::vector<Vec2>> corners_;  ///< by face
};

PlaneSystem::PlaneSystem(const std::vector<LabelledFace>& faces, const std::vector<Plane>& first,
                         const std::vector<std::vector<std::size_t>>& cells, const BuildingGrid& grid,
                         const RoofLattice& lattice)
    : grid_(grid), cells_(cells), normals_(faces.size()), corners_(faces.size()) {
    for (std::size_t i = 0; i < faces.size(); ++i) {
        for_corners(faces[i].outline, [&](FinePoint p) { corners_[i].push_back(lattice.position(p)); });
        set_normal(i, first[i]);
    }
}

void PlaneSystem::set_normal(std::size_t face, const Plane& plane) {
    constexpr double near_m = 0.5;  // residual of cells that count fully
    constexpr double far_weight = 0.02;
    Normal& normal = normals_[face];
    normal = {};
    for (const Vec2& p : corners_[face]) {
        normal.centre.x += p.x / static_cast<double>(corners_[face].size());
        normal.centre.y += p.y / static_cast<double>(corners_[face].size());
    }
    for (const std::size_t cell : cells_[face]) {
        const double z = grid_.elevation(cell);
        if (std::isnan(z))
            continue;
        const Vec2 p = grid_.centre(cell);
        normal.add(p, z, std::abs(z - plane.at(p.x, p.y)) < near_m ? 1 : far_weight);
        normal.low = std::min(normal.low, z);
        normal.high = std::max(normal.high, z);
    }
    // The plane of the whole segment, which may have more cells.
    const Eigen::Vector3d prior(plane.slope_x, plane.slope_y, plane.at(normal.centre.x, normal.centre.y));
    const Eigen::Vector3d weight(0.5, 0.5, 0.1);
    normal.matrix += weight.asDiagonal();
    normal.right += weight.cwiseProduct(prior);
    normal.squares += prior.dot(weight.cwiseProduct(prior));
}

void PlaneSystem::level(std::size_t face, FacePlane& plane) {
    std::vector<double> elevations;
    for (const std::size_t cell : cells_[face])
        if (const double z = grid_.elevation(cell); !std::isnan(z))
            elevations.push_back(z);
    if (!elevations.empty())
        plane.plane = {0, 0, upper_median(elevations)};
    plane.level = true;
    set_normal(face, plane.plane);
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
        if (planes[i].fixed) {
            matrix(0, 0) += fixed_weight;
            matrix(1, 1) += fixed_weight;
            vector(0) += fixed_weight * planes[i].plane.slope_x;
            vector(1) += fixed_weight * planes[i].plane.slope_y;
        }
        add_block(at, at, matrix);
        right.segment<3>(at) = vector;
    }
    for (const Meeting& meeting : meetings) {
        const Vec2& a = normals_[static_cast<std::size_t>(meeting.one)].centre;
        const Vec2& b = normals_[static_cast<std::size_t>(meeting.other)].centre;
        const Eigen::Vector3d one(meeting.at.x - a.x, meeting.at.y - a.y, 1);
        const Eigen::Vector3d other(meeting.at.x - b.x, meeting.at.y - b.y, 1);
        add_block(3 * meeting.one, 3 * meeting.one, meeting.weight * one * one.transpose());
        add_block(3 * meeting.other, 3 * meeting.other, meeting.weight * other * other.transpose());
        add_block(3 * meeting.one, 3 * meeting.other, -meeting.weight * one * other.transpose());
        add_block(3 * meeting.other, 3 * meeting.one, -meeting.weight * other * one.transpose());
    }
    Sparse matrix(unknowns, unknowns);
    matrix.setFromTriplets(entries.begin(), entries.end());
    const Eigen::SimplicialLDLT<Sparse> factors(matrix);
    const Eigen::VectorXd solution = factors.solve(right);
    for (std::size_t i = 0; i < normals_.size(); ++i) {
        const auto at = static_cast<Eigen::Index>(3 * i);
        Plane& plane = planes[i].plane;
        if (!planes[i].fixed) {
            plane.slope_x = solution[at];
            plane.slope_y = solution[at + 1];
        }
        const Vec2& c = normals_[i].centre;
        plane.z0 = solution[at + 2] - plane.slope_x * c.x - plane.slope_y * c.y;
    }
}

double PlaneSystem::plausible_slope(std::size_t face, const Plane& plane) const {
    constexpr double least_share = 0.3;
    const double slope = grid_.steepness(plane.slope_x, plane.slope_y);
    const Normal& normal = normals_[face];
    if (slope > steepest * grid_.cell_m || normal.low > normal.high)
        return 0;
    // The centres of its cells are up to a cell away from the corners of a face.
    const double spare = outside_m + slope;
    const double middle = plane.at(normal.centre.x, normal.centre.y);
    double share = 1;
    for (const Vec2& p : corners_[face]) {
        const double rise = plane.at(p.x, p.y) - middle;
        const double room = rise > 0 ? normal.high + spare - middle : middle - (normal.low - spare);
        if (std::abs(rise) > room)
            share = std::min(share, room / std::abs(rise));
    }
    return share < least_share ? 0 : share;
}

bool PlaneSystem::drop_costly(const std::vector<FacePlane>& best, const std::vector<FacePlane>& planes,
                              std::vector<Meeting>& meetings) const {
    constexpr std::size_t none = std::numeric_limits<std::size_t>::max();
    std::vector<std::size_t> highest(normals_.size(), none);
    for (std::size_t m = 0; m < meetings.size(); ++m)
        for (const std::int32_t face : {meetings[m].one, meetings[m].other}) {
            std::size_t& of_face = highest[static_cast<std::size_t>(face)];
            if (of_face == none || meetings[m].step(best) > meetings[of_face].step(best))
                of_face = m;
        }
    std::set<std::size_t, std::greater<>> costly;  // the last first
    for (std::size_t i = 0; i < normals_.size(); ++i)
        if (highest[i] != none &&
            normals_[i].error(planes[i].plane) > normals_[i].error(best[i].plane) + max_cost_m2)
            costly.insert(highest[i]);
    for (const std::size_t m : costly)
        meetings.erase(meetings.begin() + static_cast<std::ptrdiff_t>(m));
    return !costly.empty();
}

/// Steepness in m per cell of the difference of two planes.
double bend_between(const Plane& a, const Plane& b) {
    return std::hypot(a.slope_x - b.slope_x, a.slope_y - b.slope_y);
}

/// Corners in which neighbouring faces should meet.
std::vector<PlaneSystem::Meeting> meetings_of(const std::vector<FaceEdge>& edges,
                                              const std::vector<FacePlane>& planes,
                                              const RoofLattice& lattice) {
    std::vector<PlaneSystem::Meeting> meetings;
    std::set<std::tuple<std::int32_t, std::int32_t, FinePoint>> seen;
    for (const FaceEdge& edge : edges) {
        if (edge.left < 0 || edge.right < 0)
            continue;
        const auto [one, other] = std::minmax(edge.left, edge.right);
        const Plane& a = planes[static_cast<std::size_t>(one)].plane;
        const Plane& b = planes[static_cast<std::size_t>(other)].plane;
        const double largest =
            std::min(crease_step_m, std::max(small_step_m, crease_distance * bend_between(a, b)));
        for (const FinePoint& end : {edge.from, edge.to}) {
            const Vec2 p = lattice.position(end);
            if (std::abs(a.at(p.x, p.y) - b.at(p.x, p.y)) >= largest)
                continue;
            if (seen.emplace(one, other, end).second)
                meetings.push_back({one, other, p, first_weight});
        }
    }
    return meetings;
}

}  // namespace

std::vector<FacePlane> meeting_planes(const std::vector<LabelledFace>& faces,
                                      const std::vector<FaceEdge>& edges, const std::vector<Plane>& first,
                                      const std::vector<std::vector<std::size_t>>& cells,
                                      const BuildingGrid& grid, const RoofLattice& lattice) {
    PlaneSystem system(faces, first, cells, grid, lattice);
    std::vector<FacePlane> planes(first.size());
    std::ranges::transform(first, planes.begin(), [](const Plane& plane) { return FacePlane{plane}; });
    const auto keep_plausible = [&] {
        bool changed = false;
        for (std::size_t i = 0; i < faces.size(); ++i) {
            const double share = system.plausible_slope(i, planes[i].plane);
            if (share == 1 || planes[i].level)
                continue;
            changed = true;
            planes[i].fixed = true;
            planes[i].plane.slope_x *= share;
            planes[i].plane.slope_y *= share;
            if (share == 0)
                system.level(i, planes[i]);
        }
        return changed;
    };
    keep_plausible();
    system.solve({}, planes);
    std::vector<FacePlane> best = planes;
    for (int round = 0; round < rounds; ++round) {
        std::vector<PlaneSystem::Meeting> meetings = meetings_of(edges, planes, lattice);
        system.solve(meetings, planes);
        double weight = first_weight;
        for (int pull = 0; pull < pulls; ++pull) {
            for (PlaneSystem::Meeting& m : meetings)
                m.weight = m.step(planes) < met_softly_m ? meeting_weight : weight;
            system.solve(meetings, planes);
            weight *= 2;
        }
        std::erase_if(meetings, [&](const PlaneSystem::Meeting& m) { return m.weight != meeting_weight; });
        do
            system.solve(meetings, planes);
        while (system.drop_costly(best, planes, meetings));
        if (!keep_plausible())
            break;
        best = planes;
        system.solve({}, best);
    }
    return planes;
}

std::vector<std::int32_t> merged_faces(const std::vector<FaceEdge>& edges,
                                       const std::vector<FacePlane>& planes,
                                       const std::vector<std::vector<std::size_t>>& cells, double price,
                                       const BuildingGrid& grid, const RoofLattice& lattice) {
    /// Border between two faces.
    struct Border {
        double length = 0;  ///< cells
        double highest = 0;
    };
    constexpr double max_bend = 0.14;  // m per m, because a ridge is not a step
    std::map<std::pair<std::int32_t, std::int32_t>, Border> borders;
    for (const FaceEdge& edge : edges) {
        if (edge.left < 0 || edge.right < 0)
            continue;
        Border& border = borders[std::minmax(edge.left, edge.right)];
        const Vec2 from = lattice.position(edge.from);
        const Vec2 to = lattice.position(edge.to);
        border.length += std::hypot(to.x - from.x, to.y - from.y);
        for (const Vec2& p : {from, to})
            border.highest = std::max(
                border.highest, std::abs(planes[static_cast<std::size_t>(edge.left)].plane.at(p.x, p.y) -
                                         planes[static_cast<std::size_t>(edge.right)].plane.at(p.x, p.y)));
    }
    std::vector<PlaneMoments> moments(planes.size());
    for (std::size_t i = 0; i < planes.size(); ++i)
        for (const std::size_t cell : cells[i])
            if (const double z = grid.elevation(cell); !std::isnan(z)) {
                const Vec2 p = grid.centre(cell);
                moments[i].add(p.x, p.y, z);
            }
    DisjointSets sets(static_cast<std::uint32_t>(planes.size()));
    for (const auto& [pair, border] : borders) {
        const double bend = bend_between(planes[static_cast<std::size_t>(pair.first)].plane,
                                         planes[static_cast<std::size_t>(pair.second)].plane);
        if (border.highest < met_m || border.highest >= small_step_m || bend > max_bend * grid.cell_m)
            continue;
        const std::uint32_t one = sets.find(static_cast<std::uint32_t>(pair.first));
        const std::uint32_t other = sets.find(static_cast<std::uint32_t>(pair.second));
        PlaneMoments both = moments[one];
        both.add(moments[other]);
        const double added = both.error() - moments[one].error() - moments[other].error();
        if (one == other || added > price * border.length)
            continue;
        moments[sets.join(one, other)] = both;
    }
    std::vector<std::int32_t> merged(planes.size());
    for (std::uint32_t i = 0; i < merged.size(); ++i)
        merged[i] = static_cast<std::int32_t>(sets.find(i));
    return merged;
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
            const Vec2 at = lattice.position(p);
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
