#include "score/outline_distance.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "score/outline_segments.hpp"

namespace d2b {
namespace {

constexpr int steps_a_piece = 20;

/// Interpolates between two positions.
Position between(Position from, Position to, double share) {
    return {from.x + share * (to.x - from.x), from.y + share * (to.y - from.y)};
}

/// Candidate segments nearest to the points of a short piece of an outline.
class Neighbours {
  public:
    /// @param limit largest distance of interest
    Neighbours(std::span<const Polyline> lines, double limit) : segments_(lines), limit_(limit) {}

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
        const double pieces = std::ceil(length / (step_ * steps_a_piece));
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

    Neighbours reference_;
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

}  // namespace d2b
