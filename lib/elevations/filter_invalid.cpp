#include "elevations/filter_invalid.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>

#include "elevations/statistics.hpp"
#include "raster/blended_margin.hpp"

namespace d2b {
namespace {

/// Returns the higher neighbour of a column in a row; -infinity if neither is valid.
double beside(std::span<const double> row, std::size_t col) {
    double highest = -std::numeric_limits<double>::infinity();
    if (col > 0 && row[col - 1] > highest)
        highest = row[col - 1];
    if (col + 1 < row.size() && row[col + 1] > highest)
        highest = row[col + 1];
    return highest;
}

constexpr double invalid = std::numeric_limits<double>::quiet_NaN();

void remove_undeclared(std::span<double> values, const std::vector<double>& undeclared, ValueCounts& counts) {
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
    std::int64_t& blended;
};

void remove_outside(std::span<double> values, const ElevationLimits& limits, const NoElevations& none) {
    for (double& z : values)
        if (!limits.hold(z)) {
            if (z == blended_value)
                ++none.blended;
            else if (!std::isnan(z))
                none.outside.add(z);
            z = invalid;
        }
}

/// Filters a stretch of a row.
/// @param seen null: no statistics
/// @param steep receives stretches that may contain spikes
void filter_cells(ElevationBand& band, const ColumnRun& cells, const ValidityRules& rules,
                  SuspiciousValues* seen, const NoElevations& none, std::vector<ColumnRun>& steep) {
    constexpr std::int32_t stretch = 64;  // columns
    for (std::int32_t begin = cells.begin; begin < cells.end; begin += stretch) {
        const std::int32_t end = std::min(begin + stretch, cells.end);
        const std::size_t first =
            static_cast<std::size_t>(cells.row) * static_cast<std::size_t>(band.shape.cols) +
            static_cast<std::size_t>(begin);
        const std::span<double> values(band.elevations.data() + first, static_cast<std::size_t>(end - begin));
        ValueRange of = value_range(values);
        if (of.known > 0 && !(rules.limits.hold(of.lowest) && rules.limits.hold(of.highest))) {
            remove_outside(values, rules.limits, none);
            of = value_range(values);
        }
        if (!rules.undeclared.empty()) {
            remove_undeclared(values, rules.undeclared, none.undeclared);
            of = value_range(values);
        }
        if (of.known == 0)
            continue;
        if (seen != nullptr) {
            seen->bins.add(values, of.lowest, of.highest, static_cast<std::int64_t>(of.known));
            if (rules.overridden_nodata)
                seen->overridden_nodata += std::ranges::count(values, *rules.overridden_nodata);
        }
        // If all cells are valid, each has a neighbour among them, unless there is only one cell.
        if (of.known < values.size() || values.size() == 1 ||
            of.highest - of.lowest > rules.spikes.not_roof_above)
            steep.push_back({cells.row, begin, end});
    }
}

}  // namespace

void Spike::see(std::span<const double> other) {
    const auto at = static_cast<std::size_t>(col);
    around = std::max(around, beside(other, at));
    if (other[at] > around)
        around = other[at];
}

std::vector<Spike> find_spikes(const ElevationBand& band, std::span<const ColumnRun> steep,
                               const SpikeRules& rules) {
    std::vector<Spike> spikes;
    for (const ColumnRun& stretch : steep) {
        const std::span<const double> row = band.row(stretch.row);
        for (std::int32_t col = stretch.begin; col < stretch.end; ++col) {
            const auto at = static_cast<std::size_t>(col);
            Spike spike{stretch.row, col, row[at], beside(row, at)};
            if (!spike.above(rules.not_roof_above))  // also for NaN
                continue;
            if (stretch.row > 0)
                spike.see(band.row(stretch.row - 1));
            if (stretch.row + 1 < band.shape.rows)
                spike.see(band.row(stretch.row + 1));
            if (spike.above(rules.not_roof_above))
                spikes.push_back(spike);
        }
    }
    return spikes;
}

std::vector<Spike> SpikeSeams::add(const ElevationBand& band, std::vector<Spike> spikes) {
    for (Spike& spike : waiting_)
        if (spike.row == last_)
            spike.see(band.row(0));
    for (Spike& spike : spikes)
        if (spike.row == 0 && !last_row_.empty())
            spike.see(last_row_);
    last_ = band.shape.rows - 1;
    last_row_.assign(band.row(last_).begin(), band.row(last_).end());
    return std::exchange(waiting_, std::move(spikes));
}

void SuspiciousValues::merge(const SuspiciousValues& other) {
    outside.merge(other.outside);
    undeclared.merge(other.undeclared);
    blended += other.blended;
    spikes.merge(other.spikes);
    spires += other.spires;
    overridden_nodata += other.overridden_nodata;
    bins.merge(other.bins);
}

void SuspiciousValues::save(ByteWriter& writer) const {
    outside.save(writer);
    undeclared.save(writer);
    writer.put(blended);
    spikes.save(writer);
    writer.put(spires);
    writer.put(overridden_nodata);
    bins.save(writer);
}

void SuspiciousValues::load(ByteReader& reader) {
    outside = ValueCounts::load(reader);
    undeclared = ValueCounts::load(reader);
    blended = reader.take<std::int64_t>();
    spikes = ValueCounts::load(reader);
    spires = reader.take<std::int64_t>();
    overridden_nodata = reader.take<std::int64_t>();
    bins.load(reader);
}

void apply_limits(std::span<double> elevations, const ValidityRules& rules) {
    for (double& z : elevations)
        z = rules.limits.hold(z) ? z : invalid;
    for (const double none : rules.undeclared)
        std::ranges::replace(elevations, none, invalid);
}

std::vector<ColumnRun> filter_invalid(ElevationBand& band, const ValidityRules& rules, SuspiciousValues& seen,
                                      const Window& of) {
    std::vector<ColumnRun> steep;
    ValueCounts nobodys;
    std::int64_t nobodys_cells = 0;
    const NoElevations uncounted{nobodys, nobodys, nobodys_cells};
    const NoElevations counted{seen.outside, seen.undeclared, seen.blended};
    for (std::int32_t row = 0; row < band.shape.rows; ++row) {
        const bool noted = row >= of.row && row < of.end_row();
        const std::int32_t first = noted ? of.col : band.shape.cols;
        const std::int32_t end = noted ? of.end_col() : band.shape.cols;
        filter_cells(band, {row, 0, first}, rules, nullptr, uncounted, steep);
        filter_cells(band, {row, first, end}, rules, &seen, counted, steep);
        filter_cells(band, {row, end, band.shape.cols}, rules, nullptr, uncounted, steep);
    }
    return steep;
}

ElevationLimits elevation_limits(const ReadOptions& options, double metres) {
    if (const auto& range = options.elevation_range)
        return {(*range)[0], (*range)[1]};
    return land_elevations.times(1 / metres);
}

ValidityRules validity_rules(const ReadOptions& options, bool with_spikes, const DemInfo& info,
                             double metres) {
    ValidityRules rules{elevation_limits(options, metres), {}, metres, info.overridden_nodata, {}};
    if (with_spikes)
        rules.spikes = {spikes_m.invalid_above / metres, spikes_m.not_roof_above / metres};
    return rules;
}

UndeclaredNodata undeclared_values(DemSource& source, const Options& options, const ValidityRules& rules,
                                   double cell_m, const FirstPass* known, const Context& context) {
    const Window& window = source.info().window;
    if (options.read.ignore_nodata || window.points() == 0)
        return {};
    const ReadValues read_all = [&](const Window& part, std::span<double> values) {
        context.check_stop();
        if (known != nullptr && known->read)
            known->read(part, values);
        else
            source.read(part, values);
    };
    const ReadValues read = [&](const Window& part, std::span<double> values) {
        read_all(part, values);
        apply_limits(values, rules);
    };
    const double side = cell_m > 0 ? cell_m : 1;
    const double step = UndeclaredNodataRules::step_m / rules.metres;
    const UndeclaredNodataRules value_rules{step, options.ground.max_building_width / side};
    UndeclaredNodata found =
        known != nullptr ? find_undeclared_nodata(window, known->border, value_rules, read, known->any_common)
                         : find_undeclared_nodata(window, read_border(window, read), value_rules, read);
    // Heights above the ground may have no value on the ground, and any along walls.
    const bool all_valid = known != nullptr && known->all_valid && found.taken.empty();
    if (options.ground.mode != GroundMode::none && !all_valid)
        found.margin =
            find_blended_margin(window, {source.info().nodata, found.values(), rules.limits}, step, read_all);
    return found;
}

}  // namespace d2b
