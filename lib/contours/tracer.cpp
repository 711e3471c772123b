#include "contours/tracer.hpp"

#include <algorithm>
#include <utility>

namespace d2b::contours {

Tracer::Tracer(const TraceFrame& frame, TraceMode mode, ContourSink& sink)
    : points_(mode == TraceMode::points),
      range_(frame.range),
      sink_(sink),
      sweep_line_(frame.levels, frame.window.col, frame.range) {}

void Tracer::push_outside(std::vector<double>&& outside) {
    std::swap(outside_[1], outside_[2]);
    std::swap(outside_[0], outside_[1]);
    outside_[0] = std::move(outside);
}

void Tracer::link(const TraceLine& line) {
    sweep_line_.link(line.line, points_ ? OutsideRows{outside_[2], outside_[1], outside_[0], true}
                                        : OutsideRows{outside_[1], {}, outside_[0], false});
}

void Tracer::trace(std::vector<TraceLine>&& lines) {
    for (TraceLine& line : lines) {
        push_outside(std::move(line.outside));
        if (line.line == TraceLine::none)
            continue;
        sweep_line_.current() = std::move(line.squares);
        link(line);
        add_points(line);
        sweep_line_.finish_ended(sink_);
    }
}

LinkedBand Tracer::link(const TraceFrame& frame, TraceMode mode, std::vector<TraceLine>&& lines,
                        ContourSink& sink) {
    // The line after the last of these has all relevant rows in the band.
    std::size_t first = mode == TraceMode::points ? 2 : 1;
    while (first <= lines.size() && lines[first - 1].line == TraceLine::none)
        ++first;
    LinkedBand band;
    if (first > lines.size()) {
        band.first = std::move(lines);
        return band;
    }
    Tracer tracer(frame, mode, sink);
    for (std::size_t i = 0; i < first; ++i) {
        tracer.push_outside(std::vector(lines[i].outside));
        band.first.push_back(std::move(lines[i]));
    }
    lines.erase(lines.begin(), lines.begin() + static_cast<std::ptrdiff_t>(first));
    const std::size_t rows = std::min(lines.size(), tracer.outside_.size());
    tracer.sweep_line_.begin_band(band.first.back().line, band.first.back().squares);
    tracer.trace(std::move(lines));
    band.open = tracer.sweep_line_.take_open();
    for (std::size_t i = rows; i-- > 0;)
        band.outside.push_back(std::move(tracer.outside_[i]));
    return band;
}

void Tracer::join(LinkedBand&& band, std::int64_t first_name) {
    if (!band.open) {
        trace(std::move(band.first));
        return;
    }
    TraceLine last = std::move(band.first.back());
    band.first.pop_back();
    trace(std::move(band.first));
    push_outside(std::move(last.outside));
    sweep_line_.current() = std::move(last.squares);
    link(last);
    sweep_line_.join(*band.open, first_name);
    add_points(last);
    sweep_line_.finish_band(std::move(*band.open), sink_);
    for (std::vector<double>& outside : band.outside)
        push_outside(std::move(outside));
}

void Tracer::add_points(const TraceLine& line) {
    Components& components = sweep_line_.components();
    for (const PointRun& share : line.point_runs) {
        const RunRow& row = share.above ? sweep_line_.previous() : sweep_line_.current();
        const auto component_of = [&](std::int32_t level, std::uint32_t run) -> Component& {
            return components[components.find(row.levels[static_cast<std::size_t>(level)][run].component)];
        };
        const TopRun& top_run = row.top_runs[share.top_run];
        component_of(top_run.level, top_run.run).own.merge(share.stats);
        if (top_run.building == no_index)
            continue;
        add_roof(line, share, *component_of(1, top_run.building).sample);
    }
}

/// Adds points except spires, because objects on a roof are not part of it.
void Tracer::add_roof(const TraceLine& line, const PointRun& share, ElevationSample& sample) const {
    std::int32_t begin = share.begin;
    const auto add_up_to = [&](std::int32_t end) {
        sample.add(
            line.elevations.subspan(static_cast<std::size_t>(begin), static_cast<std::size_t>(end - begin)),
            range_);
    };
    for (const std::int32_t spire : line.spires)
        if (spire >= begin && spire < share.end) {
            add_up_to(spire);
            begin = spire + 1;
        }
    add_up_to(share.end);
}

}  // namespace d2b::contours
