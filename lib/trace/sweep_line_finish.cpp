// Finishing at the line: closed rings and contours whose last row has passed.
#include <algorithm>
#include <utility>

#include "trace/simple_rings.hpp"
#include "trace/sweep_line.hpp"

namespace d2b {

void SweepLine::add_outline(std::uint32_t component, std::span<const Corner> outline) {
    Component& c = components_[component];
    if (std::ranges::none_of(outline, &Corner::pinch)) {
        add_ring(c, outline);
        return;
    }
    for (const std::vector<Corner>& corners : split_at_pinches(outline))
        add_ring(c, corners);
}

void SweepLine::add_ring(Component& c, std::span<const Corner> corners) {
    ring_.clear();
    for (const Corner& corner : corners)
        ring_.push_back(corner.at);
    PackedRing packed(ring_);
    if (packed.area() < 0) {
        c.interiors.push_back(std::move(packed));
        return;
    }
    c.exterior = std::move(packed);
    for (const Corner& corner : corners)
        c.lowest_outside = std::min(c.lowest_outside, corner.outside);
}

void SweepLine::finish_row(std::vector<Run>& runs, std::int32_t line, ContourSink& sink) {
    for (const Run& run : runs) {
        const std::uint32_t root = components_.find(run.component);
        Component& c = components_[root];
        // Negative last rows mark contours already handed out, because several runs of the row above may
        // belong to one contour.
        if (c.last_row >= 0 && c.last_row < line && !c.open_above)
            finish(root, sink);
    }
}

void SweepLine::finish_ended(ContourSink& sink) {
    for (auto level = previous_.levels.rbegin(); level != previous_.levels.rend(); ++level)
        finish_row(*level, line_, sink);
    std::swap(previous_, current_);
    current_.clear();
}

void SweepLine::finish_band(OpenBand&& band, ContourSink& sink) {
    for (std::size_t level = current_.levels.size(); level-- > 0;) {
        finish_row(previous_.levels[level], band.last_line, sink);
        finish_row(current_.levels[level], band.last_line, sink);
    }
    line_ = band.last_line;
    previous_ = std::move(band.bottom);
    current_.clear();
}

void SweepLine::finish(std::uint32_t root, ContourSink& sink) {
    Component& c = components_[root];
    c.last_row = -1;
    const std::int32_t level = c.level;
    const std::uint32_t below = c.below;
    FinishedContour finished = components_.finish(root);
    std::sort(finished.contour.interiors.begin(), finished.contour.interiors.end(),
              [](const PackedRing& a, const PackedRing& b) { return a.start() < b.start(); });
    PointStats points = finished.contour.own;
    points.merge(finished.contour.above);
    const std::int64_t name = sink.take(std::move(finished));
    if (level == 0)
        return;
    Component& lower = components_[components_.find(below)];
    if (name < 0) {
        lower.own.merge(points);
        return;
    }
    lower.above.merge(points);
    lower.standing_on_it.push_back(name);
}

}  // namespace d2b
