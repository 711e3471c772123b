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

/// Of those that are not NaN. In lanes, which processors do at once.
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

}  // namespace

void StrangeValues::merge(const StrangeValues& other) {
    outside.merge(other.outside);
    spikes.merge(other.spikes);
    spires += other.spires;
    set_aside_nodata += other.set_aside_nodata;
    bins.merge(other.bins);
}

void StrangeValues::save(ByteWriter& writer) const {
    outside.save(writer);
    spikes.save(writer);
    writer.put(spires);
    writer.put(set_aside_nodata);
    bins.save(writer);
}

void StrangeValues::load(ByteReader& reader) {
    outside = ValueCounts::load(reader);
    spikes = ValueCounts::load(reader);
    spires = reader.take<std::int64_t>();
    set_aside_nodata = reader.take<std::int64_t>();
    bins.load(reader);
}

void limit(std::vector<double>& elevations, const ElevationLimits& limits) {
    for (double& z : elevations)
        z = limits.hold(z) ? z : invalid;
}

std::vector<Stretch> sift(ElevationBand& band, const SiftRules& rules, StrangeValues& seen) {
    constexpr std::int32_t stretch = 64;  // columns
    const std::int32_t cols = band.shape.cols;
    std::vector<Stretch> steep;
    for (std::int32_t row = 0; row < band.shape.rows; ++row)
        for (std::int32_t begin = 0; begin < cols; begin += stretch) {
            const auto size = static_cast<std::size_t>(std::min(stretch, cols - begin));
            const std::size_t first = static_cast<std::size_t>(row) * static_cast<std::size_t>(cols) +
                                      static_cast<std::size_t>(begin);
            const std::span<double> values(band.elevations.data() + first, size);
            Extremes of = extremes_of(values);
            if (of.known > 0 && !(rules.limits.hold(of.lowest) && rules.limits.hold(of.highest))) {
                take_out(values, rules.limits, seen.outside);
                of = extremes_of(values);
            }
            if (of.known == 0)
                continue;
            seen.bins.add(values, of.lowest, of.highest, static_cast<std::int64_t>(of.known));
            if (rules.set_aside_nodata)
                seen.set_aside_nodata += std::ranges::count(values, *rules.set_aside_nodata);
            // Where all are known each has a neighbour among them, or there is one alone.
            if (of.known < size || size == 1 || of.highest - of.lowest > rules.spikes.no_roof)
                steep.push_back({row, begin, begin + static_cast<std::int32_t>(size)});
        }
    return steep;
}

}  // namespace d2b
