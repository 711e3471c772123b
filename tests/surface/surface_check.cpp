#include "surface/surface_check.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <utility>
#include <vector>

namespace d2b::surface {
namespace {

using Ring = std::vector<std::uint32_t>;

/// Faces and triangles alike.
template <typename Visit>
void for_each_face(const SurfacePart& part, const Visit& visit) {
    for (const SurfaceBuilding& building : part.buildings) {
        for (const SurfaceFace& face : building.faces) {
            std::vector<Ring> rings{face.exterior};
            rings.insert(rings.end(), face.interiors.begin(), face.interiors.end());
            visit(face.kind, rings);
        }
        for (const SurfaceTriangle& triangle : building.triangles)
            visit(triangle.kind, std::vector<Ring>{{triangle.corners.begin(), triangle.corners.end()}});
    }
}

/// The vector that is twice a polygon's area long and looks where it looks (Newell).
struct Normal {
    Int128 x = 0;
    Int128 y = 0;
    Int128 z = 0;
};

Normal normal_of(const std::vector<Ring>& rings, const SurfacePart& part) {
    Normal sum;
    for (const Ring& ring : rings)
        for (std::size_t i = 0; i < ring.size(); ++i) {
            const SurfacePoint& a = part.points[ring[i]];
            const SurfacePoint& b = part.points[ring[(i + 1) % ring.size()]];
            sum.x += static_cast<Int128>(a.y) * b.z - static_cast<Int128>(a.z) * b.y;
            sum.y += static_cast<Int128>(a.z) * b.x - static_cast<Int128>(a.x) * b.z;
            sum.z += static_cast<Int128>(a.x) * b.y - static_cast<Int128>(a.y) * b.x;
        }
    return sum;
}

bool looks_right(FaceKind kind, const Normal& normal, bool slanted) {
    const bool upright = normal.x == 0 && normal.y == 0;
    switch (kind) {
        case FaceKind::roof:
            return (slanted || upright) && normal.z > 0;
        case FaceKind::ground:
            return upright && normal.z < 0;
        case FaceKind::wall:
            return normal.z == 0 && !upright;
    }
    return false;
}

/// Whether steps from corner to corner make one circle.
bool is_one_circle(const std::multimap<SurfacePoint, SurfacePoint>& steps) {
    const SurfacePoint first = steps.begin()->first;
    SurfacePoint at = first;
    std::size_t count = 0;
    do {
        if (steps.count(at) != 1)
            return false;
        at = steps.find(at)->second;
        ++count;
    } while (at != first);
    return count == steps.size();
}

class Checker {
  public:
    explicit Checker(bool slanted) : slanted_(slanted) {}

    void add(const SurfacePart& part) {
        std::set<std::uint32_t> used;
        for_each_face(part, [&](FaceKind kind, const std::vector<Ring>& rings) {
            if (!looks_right(kind, normal_of(rings, part), slanted_))
                fault_ = "a face is flat or looks the wrong way";
            for (const Ring& ring : rings)
                add_ring(ring, part, used);
            add_circles(kind, rings, part);
        });
        if (used.size() != part.points.size())
            fault_ = "a corner is not used";
        if (std::set(part.points.begin(), part.points.end()).size() != part.points.size())
            fault_ = "two corners are equal";
    }

    [[nodiscard]] std::string fault() const {
        if (!fault_.empty())
            return fault_;
        for (const auto& [way, count] : ways_)
            if (const auto back = ways_.find({way.second, way.first});
                count != 1 || back == ways_.end() || back->second != 1)
                return "an edge is not passed once each way" + place(way.first) + place(way.second);
        for (const auto& [corner, steps] : circles_)
            if (!is_one_circle(steps))
                return "a corner has more than one circle of faces" + place(corner);
        return "";
    }

  private:
    static std::string place(const SurfacePoint& p) {
        return " (" + std::to_string(p.x) + " " + std::to_string(p.y) + " " + std::to_string(p.z) + ")";
    }
    void add_ring(const Ring& ring, const SurfacePart& part, std::set<std::uint32_t>& used) {
        for (std::size_t i = 0; i < ring.size(); ++i) {
            used.insert(ring[i]);
            const SurfacePoint& a = part.points[ring[i]];
            const SurfacePoint& b = part.points[ring[(i + 1) % ring.size()]];
            ++ways_[{a, b}];
        }
    }
    /// Around a corner a face goes from the edge that leaves it to the next one, counter-clockwise, that
    /// comes in: not that of the same ring where two rings touch.
    void add_circles(FaceKind kind, const std::vector<Ring>& rings, const SurfacePart& part) {
        std::map<SurfacePoint, std::vector<SurfacePoint>> before;
        std::map<SurfacePoint, std::vector<SurfacePoint>> after;
        for (const Ring& ring : rings)
            for (std::size_t i = 0; i < ring.size(); ++i) {
                const SurfacePoint& a = part.points[ring[i]];
                const SurfacePoint& b = part.points[ring[(i + 1) % ring.size()]];
                after[a].push_back(b);
                before[b].push_back(a);
            }
        for (const auto& [corner, leaving] : after)
            for (const SurfacePoint& to : leaving) {
                const auto turn = [&, at = corner](const SurfacePoint& from) {
                    const double angle = angle_of(at, from) - angle_of(at, to);
                    const double seen = kind == FaceKind::ground ? -angle : angle;
                    return seen > 0 ? seen : seen + 2 * std::numbers::pi;
                };
                const std::vector<SurfacePoint>& coming = before[corner];
                circles_[corner].emplace(to, kind == FaceKind::wall
                                                 ? coming.front()
                                                 : *std::ranges::min_element(coming, {}, turn));
            }
    }
    static double angle_of(const SurfacePoint& from, const SurfacePoint& to) {
        return std::atan2(static_cast<double>(to.y - from.y), static_cast<double>(to.x - from.x));
    }

    bool slanted_;
    std::string fault_;
    std::map<std::pair<SurfacePoint, SurfacePoint>, int> ways_;
    std::map<SurfacePoint, std::multimap<SurfacePoint, SurfacePoint>> circles_;
};

}  // namespace

std::string fault_of(std::span<const SurfacePart> parts, bool slanted) {
    Checker checker(slanted);
    for (const SurfacePart& part : parts)
        checker.add(part);
    return checker.fault();
}

/// A cone from the origin over each face.
Int128 six_volumes(std::span<const SurfacePart> parts) {
    Int128 sum = 0;
    for (const SurfacePart& part : parts)
        for_each_face(part, [&](FaceKind /*kind*/, const std::vector<Ring>& rings) {
            const Normal normal = normal_of(rings, part);
            const SurfacePoint& p = part.points[rings[0][0]];
            sum += normal.x * p.x + normal.y * p.y + normal.z * p.z;
        });
    return sum;
}

Int128 twice_plan_area(std::span<const SurfacePart> parts, FaceKind kind) {
    Int128 sum = 0;
    for (const SurfacePart& part : parts)
        for_each_face(part, [&](FaceKind of, const std::vector<Ring>& rings) {
            if (of == kind)
                sum += normal_of(rings, part).z;
        });
    return sum < 0 ? -sum : sum;
}

}  // namespace d2b::surface
