#include "score/outline_distance.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#define BOOST_ALLOW_DEPRECATED_HEADERS             // required by Boost 1.74's own headers
#include <boost/geometry/algorithms/distance.hpp>  // required by the R-tree of Boost 1.83
#include <boost/geometry/geometries/box.hpp>
#include <boost/geometry/geometries/register/point.hpp>
#include <boost/geometry/geometries/register/segment.hpp>
#include <boost/geometry/index/rtree.hpp>
#include <boost/geometry/strategies/strategies.hpp>
#include <boost/iterator/function_output_iterator.hpp>

#include "score/measure.hpp"

#undef BOOST_ALLOW_DEPRECATED_HEADERS

BOOST_GEOMETRY_REGISTER_POINT_2D(d2b::Position, double, cs::cartesian, x, y)
BOOST_GEOMETRY_REGISTER_SEGMENT(d2b::score::OutlineSegment, d2b::Position, a, b)

namespace d2b::score {
namespace {

namespace index = boost::geometry::index;
using Tree = index::rtree<OutlineSegment, index::rstar<16>>;

Tree packed(std::span<const Polyline> lines) {
    std::vector<OutlineSegment> segments;
    for (const Polyline& line : lines)
        for (std::size_t i = 1; i < line.size(); ++i)
            segments.push_back({line[i - 1], line[i]});
    return Tree(segments);
}

boost::geometry::model::box<Position> around(Position p, double limit) {
    return {{p.x - limit, p.y - limit}, {p.x + limit, p.y + limit}};
}

}  // namespace

struct OutlineSegments::Impl {
    Tree tree;
};

double squared_distance(Position p, const OutlineSegment& segment) {
    const double dx = segment.b.x - segment.a.x;
    const double dy = segment.b.y - segment.a.y;
    const double px = p.x - segment.a.x;
    const double py = p.y - segment.a.y;
    const double length = dx * dx + dy * dy;
    const double t = length > 0 ? std::clamp((px * dx + py * dy) / length, 0.0, 1.0) : 0.0;
    const double x = px - t * dx;
    const double y = py - t * dy;
    return x * x + y * y;
}

OutlineSegments::OutlineSegments(std::span<const Polyline> lines)
    : impl_(std::make_unique<Impl>(Impl{packed(lines)})) {}
OutlineSegments::~OutlineSegments() = default;

double OutlineSegments::distance(Position p, double limit) const {
    double nearest = limit * limit;
    const auto measure = boost::make_function_output_iterator(
        [&](const OutlineSegment& segment) { nearest = std::min(nearest, squared_distance(p, segment)); });
    impl_->tree.query(index::nearest(p, 1), measure);
    return std::sqrt(nearest);
}

void OutlineSegments::within(Position p, double limit, std::vector<OutlineSegment>& found) const {
    found.clear();
    const auto keep = boost::make_function_output_iterator([&](const OutlineSegment& segment) {
        if (squared_distance(p, segment) < limit * limit)
            found.push_back(segment);
    });
    impl_->tree.query(index::intersects(around(p, limit)), keep);
}

namespace {

constexpr int samples_per_piece = 20;

/// Interpolates between two positions.
Position between(Position from, Position to, double share) {
    return {from.x + share * (to.x - from.x), from.y + share * (to.y - from.y)};
}

/// Candidate segments nearest to the points of a short piece of an outline.
class NearestSegments {
  public:
    /// @param limit largest distance of interest
    NearestSegments(std::span<const Polyline> lines, double limit) : segments_(lines), limit_(limit) {}

    void move_to(Position middle, double length) {
        found_.clear();
        const double reach = limit_ + length;  // no end of the piece is nearer than this minus its length
        const double distance = segments_.distance(middle, reach);
        if (distance <
            reach)  // the nearest segment of any point of the piece is within this distance of the middle
            segments_.within(middle, (distance + length) * (1 + 1e-9), found_);
    }
    /// Squared distance to the nearest segment; nullopt beyond the limit.
    [[nodiscard]] std::optional<double> squared_distance_from(Position p) const {
        std::optional<double> nearest;
        for (const OutlineSegment& segment : found_) {
            const double squared = squared_distance(p, segment);
            if (squared <= limit_ * limit_ && squared < nearest.value_or(HUGE_VAL))
                nearest = squared;
        }
        return nearest;
    }

  private:
    OutlineSegments segments_;
    double limit_;
    std::vector<OutlineSegment> found_;
};

class Sampler {
  public:
    Sampler(std::span<const Polyline> reference, double limit, double step)
        : reference_(reference, limit), step_(step) {}

    void add(Position from, Position to) {
        const double length = std::hypot(to.x - from.x, to.y - from.y);
        const double pieces = std::ceil(length / (step_ * samples_per_piece));
        const auto count = static_cast<std::int64_t>(pieces);
        for (std::int64_t i = 0; i < count; ++i)
            add_piece(between(from, to, static_cast<double>(i) / pieces),
                      between(from, to, static_cast<double>(i + 1) / pieces), length / pieces);
    }

    [[nodiscard]] OutlineDistance result() const {
        OutlineDistance result{length_, near_, {}};
        if (near_ > 0)
            result.rms = std::sqrt(squares_ / near_);
        return result;
    }

  private:
    void add_piece(Position from, Position to, double length) {
        const Position middle = between(from, to, 0.5);
        reference_.move_to(middle, length);
        const double samples = std::ceil(length / step_);
        const auto count = static_cast<std::int64_t>(samples);
        for (std::int64_t i = 0; i < count; ++i)
            add_sample(between(from, to, (static_cast<double>(i) + 0.5) / samples), length / samples);
    }

    void add_sample(Position p, double length) {
        length_ += length;
        if (const auto squared = reference_.squared_distance_from(p)) {
            near_ += length;
            squares_ += *squared * length;
        }
    }

    NearestSegments reference_;
    double step_;
    double length_ = 0;
    double near_ = 0;
    double squares_ = 0;
};

}  // namespace

OutlineDistance outline_distance(std::span<const Polyline> outline, std::span<const Polyline> reference,
                                 double limit, double step) {
    Sampler sampler(reference, limit, step);
    for (const Polyline& line : outline)
        for (std::size_t i = 1; i < line.size(); ++i)
            sampler.add(line[i - 1], line[i]);
    return sampler.result();
}

namespace {

/// Mean distance between the vertices of one outline and the nearest points of another.
double mean_distance(std::span<const Polyline> from, std::span<const Polyline> to) {
    const OutlineSegments outline(to);
    double sum = 0;
    std::size_t count = 0;
    for (const Polyline& line : from) {
        for (std::size_t i = 1; i < line.size();
             ++i)  // skips the first position, because it is repeated at the end
            sum += outline.distance(line[i], std::numeric_limits<double>::infinity());
        count += line.size() - 1;
    }
    return sum / static_cast<double>(count);
}

}  // namespace

double polis_distance(const WorldPolygon& a, const WorldPolygon& b) {
    const std::vector<Polyline> of_a = rings_of(std::span(&a, 1));
    const std::vector<Polyline> of_b = rings_of(std::span(&b, 1));
    return (mean_distance(of_a, of_b) + mean_distance(of_b, of_a)) / 2;
}

}  // namespace d2b::score
