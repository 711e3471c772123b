#include "elevations/sift.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>

namespace d2b {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double invalid = std::numeric_limits<double>::quiet_NaN();

struct Extremes {
    double lowest = infinity;
    double highest = -infinity;
    std::size_t known = 0;
};

/// Returns the range of values that are not NaN. Uses lanes, so that the loop vectorises.
Extremes extremes_of(std::span<const double> values) {
    constexpr std::size_t lanes = 4;
    std::array<double, lanes> lowest{infinity, infinity, infinity, infinity};
    std::array<double, lanes> highest{-infinity, -infinity, -infinity, -infinity};
    std::array<double, lanes> known{};
    const auto look = [&](std::size_t i, std::size_t lane) {
        const double z = values[i];
        lowest[lane] = z < lowest[lane] ? z : lowest[lane];
        highest[lane] = z > highest[lane] ? z : highest[lane];
        known[lane] += z == z ? 1.0 : 0.0;
    };
    std::size_t i = 0;
    for (; i + lanes <= values.size(); i += lanes)
        for (std::size_t lane = 0; lane < lanes; ++lane)
            look(i + lane, lane);
    for (; i < values.size(); ++i)
        look(i, 0);
    return {std::ranges::min(lowest), std::ranges::max(highest),
            static_cast<std::size_t>(known[0] + known[1] + known[2] + known[3])};
}

void take_out(std::span<double> values, const ElevationLimits& limits, ValueCounts& outside) {
    for (double& z : values)
        if (!limits.hold(z)) {
            if (!std::isnan(z))
                outside.add(z);
            z = invalid;
        }
}

void take_undeclared_out(std::span<double> values, const std::vector<double>& undeclared,
                         ValueCounts& counts) {
    for (const double none : undeclared) {
        const std::int64_t cells = std::ranges::count(values, none);
        if (cells == 0)
            continue;
        counts.add(none, cells);
        std::ranges::replace(values, none, invalid);
    }
}

/// Counts of values that are invalid by themselves.
struct NoElevations {
    ValueCounts& outside;
    ValueCounts& undeclared;
};

/// Filters a stretch of a row.
/// @param seen null: no statistics
/// @param steep receives stretches that may contain spikes
void sift_cells(ElevationBand& band, const Stretch& cells, const SiftRules& rules, StrangeValues* seen,
                const NoElevations& none, std::vector<Stretch>& steep) {
    constexpr std::int32_t stretch = 64;  // columns
    for (std::int32_t begin = cells.begin; begin < cells.end; begin += stretch) {
        const std::int32_t end = std::min(begin + stretch, cells.end);
        const std::size_t first =
            static_cast<std::size_t>(cells.row) * static_cast<std::size_t>(band.shape.cols) +
            static_cast<std::size_t>(begin);
        const std::span<double> values(band.elevations.data() + first, static_cast<std::size_t>(end - begin));
        Extremes of = extremes_of(values);
        if (of.known > 0 && !(rules.limits.hold(of.lowest) && rules.limits.hold(of.highest))) {
            take_out(values, rules.limits, none.outside);
            of = extremes_of(values);
        }
        if (!rules.undeclared.empty()) {
            take_undeclared_out(values, rules.undeclared, none.undeclared);
            of = extremes_of(values);
        }
        if (of.known == 0)
            continue;
        if (seen != nullptr) {
            seen->bins.add(values, of.lowest, of.highest, static_cast<std::int64_t>(of.known));
            if (rules.set_aside_nodata)
                seen->set_aside_nodata += std::ranges::count(values, *rules.set_aside_nodata);
        }
        // If all cells are valid, each has a neighbour among them, unless there is only one cell.
        if (of.known < values.size() || values.size() == 1 || of.highest - of.lowest > rules.spikes.no_roof)
            steep.push_back({cells.row, begin, end});
    }
}

}  // namespace

void StrangeValues::merge(const StrangeValues& other) {
    outside.merge(other.outside);
    undeclared.merge(other.undeclared);
    spikes.merge(other.spikes);
    spires += other.spires;
    set_aside_nodata += other.set_aside_nodata;
    bins.merge(other.bins);
}

void StrangeValues::save(ByteWriter& writer) const {
    outside.save(writer);
    undeclared.save(writer);
    spikes.save(writer);
    writer.put(spires);
    writer.put(set_aside_nodata);
    bins.save(writer);
}

void StrangeValues::load(ByteReader& reader) {
    outside = ValueCounts::load(reader);
    undeclared = ValueCounts::load(reader);
    spikes = ValueCounts::load(reader);
    spires = reader.take<std::int64_t>();
    set_aside_nodata = reader.take<std::int64_t>();
    bins.load(reader);
}

void limit(std::span<double> elevations, const SiftRules& rules) {
    for (double& z : elevations)
        z = rules.limits.hold(z) ? z : invalid;
    for (const double none : rules.undeclared)
        std::ranges::replace(elevations, none, invalid);
}

std::vector<Stretch> sift(ElevationBand& band, const SiftRules& rules, StrangeValues& seen) {
    return sift(band, rules, seen, {0, 0, band.shape.rows, band.shape.cols});
}

std::vector<Stretch> sift(ElevationBand& band, const SiftRules& rules, StrangeValues& seen,
                          const Window& of) {
    std::vector<Stretch> steep;
    ValueCounts nobodys;
    const NoElevations uncounted{nobodys, nobodys};
    const NoElevations counted{seen.outside, seen.undeclared};
    for (std::int32_t row = 0; row < band.shape.rows; ++row) {
        const bool noted = row >= of.row && row < of.end_row();
        const std::int32_t first = noted ? of.col : band.shape.cols;
        const std::int32_t end = noted ? of.end_col() : band.shape.cols;
        sift_cells(band, {row, 0, first}, rules, nullptr, uncounted, steep);
        sift_cells(band, {row, first, end}, rules, &seen, counted, steep);
        sift_cells(band, {row, end, band.shape.cols}, rules, nullptr, uncounted, steep);
    }
    return steep;
}

}  // namespace d2b
