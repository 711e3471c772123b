#include "trace/tracer.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "trace/squares.hpp"

namespace d2b {

template <typename Count>
Tracer<Count>::Tracer(const TraceFrame& frame, const TraceOptions& options, StackSink& sink)
    : frame_(frame),
      points_(options.mode == TraceMode::points),
      sink_(sink),
      sweep_(frame.levels, frame.window.col, frame.range),
      next_row_(frame.window.row) {}

template <typename Count>
void Tracer<Count>::trace(const ElevationBand& elevations, const LabelBand& labels,
                          const LevelBand<Count>& levels) {
    for (std::int32_t i = 0; i < elevations.shape.rows; ++i) {
        std::swap(rows_[1], rows_[2]);
        std::swap(rows_[0], rows_[1]);
        take_row(rows_[0], elevations, labels, levels, i);
        ++next_row_;
        if (points_)
            sweep_points();
        else
            sweep_cells();
    }
}

template <typename Count>
void Tracer<Count>::take_row(PointRow& row, const ElevationBand& elevations, const LabelBand& labels,
                             const LevelBand<Count>& levels, std::int32_t i) const {
    const auto z = elevations.row(i);
    const auto counts = levels.row(i);
    const auto label = labels.row(i);
    row.elevations.assign(z.begin(), z.end());
    row.counts.assign(counts.begin(), counts.end());
    row.labels.assign(label.begin(), label.end());
    row.outside.resize(z.size());
    for (std::size_t c = 0; c < z.size(); ++c)
        row.outside[c] = counts[c] == 1 ? z[c] : nothing_outside;
}

template <typename Count>
void Tracer<Count>::sweep_cells() {
    const PointRow& row = rows_[0];
    cut_into_runs<Count>(row.counts, row.labels, sweep_.current());
    sweep_line(next_row_ - 1, {rows_[1].outside, {}, row.outside, false});
}

template <typename Count>
void Tracer<Count>::sweep_points() {
    const PointRow& lower = rows_[0];
    const PointRow& upper = rows_[1];
    if (upper.counts.empty())
        return;  // the first row of points is the line above the first row of squares
    squares_between<Count>(upper.counts, lower.counts, upper.labels, lower.labels, squares_);
    cut_into_runs<Count>(squares_, std::span(upper.labels).first(upper.labels.empty() ? 0 : squares_.size()),
                         sweep_.current());
    sweep_line(next_row_ - 2, {rows_[2].outside, upper.outside, lower.outside, true});
}

template <typename Count>
void Tracer<Count>::sweep_line(std::int32_t line, const OutsideRows& outside) {
    sweep_.link(line, outside);
    if (points_) {
        spread_owners(lower_owners_);
        add_points(rows_[1].elevations);
        std::swap(upper_owners_, lower_owners_);
    } else {
        add_cells();
    }
    sweep_.finish_ended(sink_);
}

template <typename Count>
void Tracer<Count>::finish() {
    if (points_ && !rows_[0].counts.empty()) {
        // The last row of points is the line under the last row of squares.
        std::swap(rows_[1], rows_[2]);
        std::swap(rows_[0], rows_[1]);
        rows_[0] = {};
        sweep_.current().clear();
        sweep_line(next_row_ - 1, {rows_[2].outside, rows_[1].outside, {}, true});
    } else if (!points_) {
        rows_[1] = std::move(rows_[0]);
        rows_[0] = {};
        sweep_.current().clear();
        sweep_line(next_row_, {rows_[1].outside, {}, {}, false});
    }
}

template <typename Count>
void Tracer<Count>::add(const Owner& owner, double elevation) {
    Components& components = sweep_.components();
    components[components.find(owner.component)].own.add(elevation, frame_.fixed);
    if (owner.building != no_index)
        components[components.find(owner.building)].sample->add(elevation, frame_.range);
}

/// Every cell is a point of the contour that it lies in.
template <typename Count>
void Tracer<Count>::add_cells() {
    const RunRow& row = sweep_.current();
    Components& components = sweep_.components();
    for (const Segment& segment : row.segments) {
        const auto run_of = [&](std::int32_t level, std::uint32_t run) {
            return components.find(row.levels[static_cast<std::size_t>(level)][run].component);
        };
        PointStats& own = components[run_of(segment.level, segment.run)].own;
        ElevationSample* sample =
            segment.building == no_index ? nullptr : components[run_of(1, segment.building)].sample.get();
        for (auto c = static_cast<std::size_t>(segment.begin); c < static_cast<std::size_t>(segment.end);
             ++c) {
            const double z = rows_[0].elevations[c];
            if (std::isnan(z))
                continue;
            own.add(z, frame_.fixed);
            if (sample != nullptr)
                sample->add(z, frame_.range);
        }
    }
}

template <typename Count>
void Tracer<Count>::spread_owners(std::vector<Owner>& owners) {
    owners.assign(std::max<std::size_t>(1, static_cast<std::size_t>(frame_.window.cols)) - 1, Owner{});
    const RunRow& row = sweep_.current();
    for (const Segment& segment : row.segments) {
        Owner owner;
        owner.level = segment.level;
        owner.component = row.levels[static_cast<std::size_t>(segment.level)][segment.run].component;
        owner.building = segment.building == no_index ? no_index : row.levels[1][segment.building].component;
        std::fill(owners.begin() + segment.begin, owners.begin() + segment.end, owner);
    }
}

/// A point on the line is counted once, with the highest contour among the four squares around it (the first
/// in scan order where several are as high): a point where two contours touch belongs to one of them.
template <typename Count>
void Tracer<Count>::add_points(const std::vector<double>& elevations) {
    const std::size_t squares = lower_owners_.size();
    for (std::size_t c = 0; c < elevations.size(); ++c) {
        const Owner* best = nullptr;
        for (const auto* owners : {&upper_owners_, &lower_owners_})
            for (const std::size_t square : {c - 1, c})
                if (square < squares && square < owners->size() &&
                    (*owners)[square].level > (best == nullptr ? -1 : best->level))
                    best = &(*owners)[square];
        if (best != nullptr && !std::isnan(elevations[c]))
            add(*best, elevations[c]);
    }
}

template class Tracer<std::uint8_t>;
template class Tracer<std::uint16_t>;

}  // namespace d2b
