#include "core/value_regions.hpp"

#include <algorithm>
#include <iterator>

namespace d2b {
namespace {

constexpr std::uint8_t missing = max_candidates + 1;  // class of cells that are not valid
constexpr std::int64_t min_cells = 50;                // of a value: equality in a few cells means nothing
constexpr std::int64_t taken_share = 10;              // at least one of this many valid cells
// Tolerances, because a shore rises gently in some places, and so do values resampled across the edge of
// NoData.
constexpr double max_similar = 0.2;     // share of neighbours that differ by less than a step
constexpr double min_land_share = 0.8;  // share of all other cells that is in broad regions

}  // namespace

void Differences::add(double difference, double step) {
    const double size = std::abs(difference);
    if (size == 0)
        return;
    if (size < step)
        ++small_;
    else if (large_.size() < many)
        ++large_[std::llround(std::min(size, largest) / unit)];
}

/// @param sign -1: takes pairs away
void Differences::merge(const Differences& other, std::int64_t sign) {
    small_ += sign * other.small_;
    for (const auto& [size, pairs] : other.large_)
        large_[size] += sign * pairs;
}

double Differences::rounding() const {
    std::int64_t large = 0;
    std::pair<std::int64_t, std::int64_t> most;  // pairs, difference
    for (const auto& [size, pairs] : large_) {
        large += pairs;
        most = std::max(most, {pairs, size});
    }
    const bool is_rounded = large > 0 && large_.size() < many && 2 * most.first >= large &&
                            static_cast<double>(small_) <= max_similar * static_cast<double>(small_ + large);
    return is_rounded ? static_cast<double>(most.second) * unit : 0;
}

std::uint8_t ValueRegions::class_of(double value) const {
    if (std::isnan(value))
        return missing;
    for (std::size_t i = 0; i < candidates_.size(); ++i)
        if (value == candidates_[i])
            return static_cast<std::uint8_t>(i + 1);
    return 0;
}

void ValueRegions::add_runs(Row& row) {
    const std::vector<std::uint8_t>& classes = row.classes;
    for (std::size_t begin = 0; begin < classes.size();) {
        std::size_t end = begin;
        while (end < classes.size() && classes[end] == classes[begin])
            ++end;
        const auto valid = classes[begin] == missing ? 0 : static_cast<std::int64_t>(end - begin);
        const std::uint32_t region = sets_.add();
        regions_.push_back(
            {classes[begin], rows_.size() == 1 || begin == 0 || end == classes.size(), valid, {}});
        runs_.push_back({begin, end, region});
        std::fill(row.regions.begin() + static_cast<std::ptrdiff_t>(begin),
                  row.regions.begin() + static_cast<std::ptrdiff_t>(end), region);
        valid_ += valid;
        begin = end;
    }
}

void ValueRegions::join_rows() {
    auto up = above_.begin();
    for (Run& run : runs_) {
        while (up != above_.end() && up->end <= run.begin)
            ++up;
        for (auto other = up; other != above_.end() && other->begin < run.end; ++other)
            if (regions_[sets_.find(other->region)].of == regions_[sets_.find(run.region)].of)
                if (const std::uint32_t a = sets_.find(other->region), b = sets_.find(run.region); a != b) {
                    const std::uint32_t stays = sets_.join(a, b);
                    regions_[stays].merge(regions_[stays == a ? b : a]);
                }
    }
}

/// Keeps the contact of a candidate with missing cells. @param one, other regions, one of them missing
void ValueRegions::add_touch(std::uint32_t one, std::uint32_t other) {
    if (regions_[sets_.find(one)].of == missing)
        std::swap(one, other);
    if (regions_[sets_.find(one)].of != 0 && (touches_.empty() || touches_.back() != std::pair(one, other)))
        touches_.emplace_back(one, other);
}

/// Adds the contact of a cell of a line with the next one, if their classes differ.
void ValueRegions::add_contact(const Line& line, std::size_t first) {
    const std::size_t second = first + 1;
    if (line.classes[first] == line.classes[second])
        return;
    if (line.classes[first] == missing || line.classes[second] == missing) {
        add_touch(line.regions[first], line.regions[second]);
        return;
    }
    const auto ends = [&](std::size_t i) { return line.classes[i] != 0; };
    const double difference = ends(first) ? largest_step(line.values, first, second, ends)
                                          : largest_step(line.values, second, first, ends);
    for (const std::uint32_t region : {line.regions[first], line.regions[second]})
        regions_[sets_.find(region)].contour.add(difference, step_);
}

/// Adds the contacts of a row with the one below, along the columns of the rows that are kept.
void ValueRegions::add_contacts_below(std::size_t row) {
    const std::size_t rows = rows_.size();
    Row column;
    column.values.resize(rows);
    column.classes.resize(rows);
    column.regions.resize(rows);
    for (std::size_t c = 0; c < rows_[row].classes.size(); ++c) {
        if (rows_[row].classes[c] == rows_[row + 1].classes[c])
            continue;
        for (std::size_t i = 0; i < rows; ++i) {
            column.values[i] = rows_[i].values[c];
            column.classes[i] = rows_[i].classes[c];
            column.regions[i] = rows_[i].regions[c];
        }
        add_contact({column.values, column.classes, column.regions}, row);
    }
}

void ValueRegions::add_difference(std::uint8_t of_one, std::uint8_t of_other, double difference) {
    if (of_one == missing || of_other == missing)
        return;
    if (of_one == 0 || of_other == 0)
        ++beside_others_[std::max(of_one, of_other)];
    differences_[0].add(difference, step_);
    if (of_one != 0)
        differences_[of_one].add(difference, step_);
    if (of_other != 0 && of_other != of_one)
        differences_[of_other].add(difference, step_);
}

void ValueRegions::add_differences(const Row& row) {
    for (std::size_t c = 1; c < row.values.size(); ++c)
        add_difference(row.classes[c - 1], row.classes[c], row.values[c] - row.values[c - 1]);
    if (rows_.size() == 1)
        return;
    const Row& above = rows_[rows_.size() - 2];
    for (std::size_t c = 0; c < row.values.size(); ++c)
        add_difference(above.classes[c], row.classes[c], row.values[c] - above.values[c]);
}

void ValueRegions::add(std::span<const double> values) {
    Row reused;
    if (rows_.size() == 2 * compared_cells) {
        reused = std::move(rows_.front());
        rows_.pop_front();
    }
    Row& row = rows_.emplace_back(std::move(reused));
    row.values.assign(values.begin(), values.end());
    row.classes.resize(values.size());
    row.regions.resize(values.size());
    std::ranges::transform(values, row.classes.begin(), [this](double value) { return class_of(value); });
    for (std::size_t i = 0; i < values.size(); ++i)
        if (row.classes[i] == 0) {
            lowest_other_ = std::min(lowest_other_, values[i]);
            highest_other_ = std::max(highest_other_, values[i]);
        }
    std::swap(above_, runs_);
    runs_.clear();
    add_runs(row);
    join_rows();
    add_differences(row);
    for (std::size_t i = 0; i + 1 < values.size(); ++i)
        add_contact({row.values, row.classes, row.regions}, i);
    if (rows_.size() > compared_cells)
        add_contacts_below(rows_.size() - 1 - compared_cells);
}

std::uint8_t ValueRegions::level_land() const {
    std::vector<std::int64_t> cells(candidates_.size() + 1);
    for (std::uint32_t i = 0; i < sets_.size(); ++i)
        if (sets_.is_root(i) && regions_[i].of != missing)
            cells[regions_[i].of] += regions_[i].cells;
    std::size_t land = 0;
    if (taken_share * cells[0] < valid_)
        for (std::size_t i = 1; i < cells.size(); ++i)  // if two are equally large, the higher one
            if (cells[i] > (land == 0 ? 0 : cells[land]) ||
                (land > 0 && cells[i] == cells[land] && candidates_[i - 1] > candidates_[land - 1]))
                land = i;
    return static_cast<std::uint8_t>(land);
}

/// Returns true if the candidates surround land in regions that are broader than buildings. @param level
/// a candidate that is land; 0: none
bool ValueRegions::surrounds_land(std::uint8_t level, double min_breadth) const {
    const auto is_land = [&](const Region& region) { return region.of == 0 || region.of == level; };
    std::int64_t all = 0;
    for (std::uint32_t i = 0; i < sets_.size(); ++i)
        if (sets_.is_root(i) && is_land(regions_[i]))
            all += regions_[i].cells;
    std::int64_t land = 0;
    for (std::uint32_t i = 0; i < sets_.size(); ++i) {
        const Region& region = regions_[i];
        if (!sets_.is_root(i) || !is_land(region))
            continue;
        const auto cells = static_cast<double>(region.cells);
        // A square with n cells per side has a boundary of 4 n.
        if (4 * cells >= min_breadth * static_cast<double>(region.contour.length()))
            land += region.cells;
    }
    return all > 0 && static_cast<double>(land) >= min_land_share * static_cast<double>(all);
}

Region ValueRegions::at_edge(std::size_t candidate) const {
    Region all;
    for (std::uint32_t i = 0; i < sets_.size(); ++i)
        if (sets_.is_root(i) && regions_[i].of == candidate + 1 && regions_[i].at_edge)
            all.merge(regions_[i]);
    return all;
}

double ValueRegions::rounding_beside(std::size_t candidate) const {
    Differences others = differences_[0];
    others.merge(differences_[candidate + 1], -1);
    return others.rounding();
}

bool ValueRegions::may_be_nodata(const Region& all) const {
    return all.cells >= min_cells && UndeclaredNodataRules::named_share * all.cells >= valid_ &&
           all.contour.length() > 0 && all.contour.is_step(max_similar);
}

/// Lists candidates that are too few or without a step. If there are none, lists the level ground beside most
/// other cells, and the candidates above it, because flat roofs are level too.
std::vector<double> ValueRegions::elevations() const {
    std::vector<double> values;
    std::size_t ground = 0;
    for (std::size_t i = 0; i < candidates_.size(); ++i) {
        if (!may_be_nodata(at_edge(i)))
            values.push_back(candidates_[i]);
        if (beside_others_[i + 1] > beside_others_[ground + 1])
            ground = i;
    }
    if (values.empty())
        std::ranges::copy_if(candidates_, std::back_inserter(values),
                             [&](double value) { return value >= candidates_[ground]; });
    return values;
}

Verdict ValueRegions::finish(double min_breadth) {
    for (const Run& run : runs_)
        regions_[sets_.find(run.region)].at_edge = true;
    for (std::size_t row = rows_.size() > compared_cells ? rows_.size() - compared_cells : 0;
         row + 1 < rows_.size(); ++row)
        add_contacts_below(row);
    // Missing cells may be those outside of a cutline, which also cuts flat roofs; but these are not the
    // lowest.
    const double lowest = std::min(lowest_other_, *std::ranges::min_element(candidates_));
    for (const auto& [candidate, gap] : touches_) {
        Region& region = regions_[sets_.find(candidate)];
        if (regions_[sets_.find(gap)].at_edge && candidates_[region.of - 1U] == lowest)
            region.at_edge = true;
    }
    Verdict verdict;
    const std::uint8_t level = level_land();
    if (!surrounds_land(level, min_breadth)) {
        verdict.elevations = elevations();
        return verdict;
    }
    for (std::size_t i = 0; i < candidates_.size(); ++i) {
        const Region all = at_edge(i);
        if (i + 1 == level || !may_be_nodata(all) || is_larger_than_constant(all.cells))
            continue;
        verdict.rounding = std::max(verdict.rounding, rounding_beside(i));
        if (taken_share * all.cells >= valid_)
            verdict.found.taken.push_back({candidates_[i], all.cells});
        else
            verdict.found.named.push_back({candidates_[i], all.cells});
    }
    return verdict;
}

}  // namespace d2b
