#include "core/undeclared_values.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <utility>

#include "core/disjoint_sets.hpp"
#include "core/number_text.hpp"

namespace d2b {
namespace {

constexpr std::size_t most_candidates = 8;
constexpr std::int64_t fewest_cells = 50;    // of a value: equality in a few cells means nothing
constexpr std::int64_t border_share = 1000;  // at least one of this many cells of the border
constexpr std::int64_t taken_share = 10;     // at least one of this many valid cells
constexpr std::int64_t named_share = 100;    // at least one of this many valid cells
// Tolerances, because a shore rises gently in some places, and so do values resampled across the edge of
// NoData.
constexpr double most_even = 0.2;         // share of neighbours that differ by less than a step
constexpr double most_even_border = 0.5;  // same for neighbours along the border, which are few
constexpr double least_land = 0.8;        // share of all other cells that is in broad regions
constexpr double least_region = 0.2;      // share of all other cells that one broad region has

/// Differences along the boundary between a value and its neighbours.
struct Contour {
    std::int64_t steps = 0;
    std::int64_t even = 0;  ///< neighbours that differ by less than a step

    [[nodiscard]] std::int64_t length() const { return steps + even; }
    void add(double difference, double step) { ++(std::abs(difference) >= step ? steps : even); }
    void merge(const Contour& other) {
        steps += other.steps;
        even += other.even;
    }
    [[nodiscard]] bool is_step(double most) const {
        return static_cast<double>(even) <= most * static_cast<double>(length());
    }
};

/// Connected cells (4-neighbours) of one candidate value, or of none.
struct Region {
    std::uint8_t of = 0;  ///< number of the candidate, from 1; 0: any other value, or not valid
    bool at_edge = false;
    std::int64_t cells = 0;  ///< valid cells
    Contour contour;         ///< boundary towards candidates, if this is not a candidate itself

    void merge(const Region& other) {
        at_edge = at_edge || other.at_edge;
        cells += other.cells;
        contour.merge(other.contour);
    }
};

/// Connected components of equal values, fed row by row from first to last.
class ValueRegions {
  public:
    ValueRegions(const std::vector<double>& candidates, double step) : candidates_(candidates), step_(step) {}

    void add(std::span<const double> row);
    /// @param least_breadth see UndeclaredRules
    [[nodiscard]] UndeclaredValues finish(double least_breadth);

  private:
    struct Run {
        std::size_t begin;
        std::size_t end;
        std::uint32_t region;
    };
    [[nodiscard]] std::uint8_t class_of(double value) const;
    void add_runs(std::span<const double> row);
    void join_rows();
    void add_contours(std::span<const double> row);
    void meet(std::size_t a, std::uint8_t of_a, double value_a, std::size_t b, std::uint8_t of_b,
              double value_b, const std::vector<std::uint32_t>& regions_a);
    /// Returns the candidate that is land because hardly any other value occurs: a flat terrain model. 0:
    /// none.
    [[nodiscard]] std::uint8_t level_land() const;
    [[nodiscard]] bool surrounds_land(std::uint8_t level, double least_breadth) const;

    const std::vector<double>& candidates_;
    double step_;
    std::int64_t valid_ = 0;
    DisjointSets sets_;
    std::vector<Region> regions_;
    std::vector<Run> above_;
    std::vector<Run> runs_;
    std::vector<double> values_above_;
    std::vector<std::uint8_t> classes_;
    std::vector<std::uint8_t> classes_above_;
    std::vector<std::uint32_t> region_of_;        ///< by column
    std::vector<std::uint32_t> region_of_above_;  ///< by column
};

std::uint8_t ValueRegions::class_of(double value) const {
    for (std::size_t i = 0; i < candidates_.size(); ++i)
        if (value == candidates_[i])
            return static_cast<std::uint8_t>(i + 1);
    return 0;
}

void ValueRegions::add_runs(std::span<const double> row) {
    for (std::size_t begin = 0; begin < row.size();) {
        std::size_t end = begin;
        std::int64_t valid = 0;
        for (; end < row.size() && classes_[end] == classes_[begin]; ++end)
            valid += std::isnan(row[end]) ? 0 : 1;
        const std::uint32_t region = sets_.add();
        regions_.push_back(
            {classes_[begin], values_above_.empty() || begin == 0 || end == row.size(), valid, {}});
        runs_.push_back({begin, end, region});
        std::fill(region_of_.begin() + static_cast<std::ptrdiff_t>(begin),
                  region_of_.begin() + static_cast<std::ptrdiff_t>(end), region);
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

/// Records two neighbours of different classes if both are valid. At least one belongs to a candidate.
void ValueRegions::meet(std::size_t a, std::uint8_t of_a, double value_a, std::size_t b, std::uint8_t of_b,
                        double value_b, const std::vector<std::uint32_t>& regions_a) {
    if (of_a == of_b || std::isnan(value_a) || std::isnan(value_b))
        return;
    const double difference = value_a - value_b;
    regions_[sets_.find(regions_a[a])].contour.add(difference, step_);
    regions_[sets_.find(region_of_[b])].contour.add(difference, step_);
}

void ValueRegions::add_contours(std::span<const double> row) {
    for (std::size_t c = 0; c < row.size(); ++c) {
        if (c > 0)
            meet(c - 1, classes_[c - 1], row[c - 1], c, classes_[c], row[c], region_of_);
        if (!values_above_.empty())
            meet(c, classes_above_[c], values_above_[c], c, classes_[c], row[c], region_of_above_);
    }
}

void ValueRegions::add(std::span<const double> row) {
    classes_.resize(row.size());
    region_of_.resize(row.size());
    runs_.clear();
    std::ranges::transform(row, classes_.begin(), [this](double value) { return class_of(value); });
    add_runs(row);
    join_rows();
    add_contours(row);
    std::swap(above_, runs_);
    std::swap(classes_, classes_above_);
    std::swap(region_of_, region_of_above_);
    values_above_.assign(row.begin(), row.end());
}

std::uint8_t ValueRegions::level_land() const {
    std::vector<std::int64_t> cells(candidates_.size() + 1);
    for (std::uint32_t i = 0; i < sets_.size(); ++i)
        if (sets_.stands(i))
            cells[regions_[i].of] += regions_[i].cells;
    std::size_t land = 0;
    if (taken_share * cells[0] < valid_)
        for (std::size_t i = 1; i < cells.size(); ++i)  // if two are equally large, the higher one
            if (cells[i] > (land == 0 ? 0 : cells[land]) ||
                (land > 0 && cells[i] == cells[land] && candidates_[i - 1] > candidates_[land - 1]))
                land = i;
    return static_cast<std::uint8_t>(land);
}

/// Returns true if the candidates surround land in few regions that are broader than buildings. @param level
/// a candidate that is land; 0: none
bool ValueRegions::surrounds_land(std::uint8_t level, double least_breadth) const {
    const auto is_land = [&](const Region& region) { return region.of == 0 || region.of == level; };
    std::int64_t all = 0;
    for (std::uint32_t i = 0; i < sets_.size(); ++i)
        if (sets_.stands(i) && is_land(regions_[i]))
            all += regions_[i].cells;
    std::int64_t land = 0;
    for (std::uint32_t i = 0; i < sets_.size(); ++i) {
        const Region& region = regions_[i];
        if (!sets_.stands(i) || !is_land(region))
            continue;
        const auto cells = static_cast<double>(region.cells);
        // A square with n cells per side has a boundary of 4 n.
        if (cells >= least_region * static_cast<double>(all) &&
            4 * cells >= least_breadth * static_cast<double>(region.contour.length()))
            land += region.cells;
    }
    return all > 0 && static_cast<double>(land) >= least_land * static_cast<double>(all);
}

UndeclaredValues ValueRegions::finish(double least_breadth) {
    for (const Run& run : above_)
        regions_[sets_.find(run.region)].at_edge = true;
    UndeclaredValues found;
    const std::uint8_t level = level_land();
    if (!surrounds_land(level, least_breadth))
        return found;
    for (std::size_t i = 0; i < candidates_.size(); ++i) {
        if (i + 1 == level)
            continue;
        Region all;
        for (std::uint32_t k = 0; k < sets_.size(); ++k)
            if (sets_.stands(k) && regions_[k].of == i + 1 && regions_[k].at_edge)
                all.merge(regions_[k]);
        if (all.cells < fewest_cells || all.contour.length() == 0 || !all.contour.is_step(most_even))
            continue;
        if (taken_share * all.cells >= valid_)
            found.taken.push_back({candidates_[i], all.cells});
        else if (named_share * all.cells >= valid_)
            found.named.push_back({candidates_[i], all.cells});
    }
    return found;
}

struct BorderCount {
    std::int64_t cells = 0;
    Contour contour;
};

void count_along(std::span<const double> cells, double step, std::map<double, BorderCount>& counts) {
    for (std::size_t i = 0; i < cells.size(); ++i) {
        if (std::isnan(cells[i]))
            continue;
        ++counts[cells[i]].cells;
        if (i == 0 || std::isnan(cells[i - 1]) || cells[i] == cells[i - 1])
            continue;
        counts[cells[i]].contour.add(cells[i] - cells[i - 1], step);
        counts[cells[i - 1]].contour.add(cells[i] - cells[i - 1], step);
    }
}

}  // namespace

std::vector<double> UndeclaredValues::values() const {
    std::vector<double> all;
    for (const SharedValue& one : taken)
        all.push_back(one.value);
    return all;
}

std::string undeclared_text(const SharedValue& value, const std::string& raster) {
    return cells_have(value.cells, raster) + "the elevation " + value_text(value.value) +
           ", lie at its edge, and all around is at least " + number_text(UndeclaredRules::step_m) +
           " m higher or lower";
}

BorderCells read_border(const Window& window, const ReadValues& read) {
    const auto strip = [&](const Window& part) {
        std::vector<double> values(static_cast<std::size_t>(part.points()));
        read(part, values);
        return values;
    };
    if (window.points() == 0)
        return {};
    return {strip({window.row, window.col, 1, window.cols}),
            strip({window.end_row() - 1, window.col, 1, window.cols}),
            strip({window.row, window.col, window.rows, 1}),
            strip({window.row, window.end_col() - 1, window.rows, 1})};
}

std::vector<double> border_candidates(const BorderCells& border, double step) {
    std::map<double, BorderCount> counts;
    std::size_t all = 0;
    for (const std::vector<double>* side : {&border.top, &border.bottom, &border.left, &border.right}) {
        count_along(*side, step, counts);
        all += side->size();
    }
    const std::int64_t least =
        std::max<std::int64_t>(2, (static_cast<std::int64_t>(all) + border_share - 1) / border_share);
    std::vector<SharedValue> candidates;
    for (const auto& [value, count] : counts)
        if (count.cells >= least && count.contour.is_step(most_even_border))
            candidates.push_back({value, count.cells});
    std::ranges::stable_sort(candidates, std::ranges::greater{}, &SharedValue::cells);
    candidates.resize(std::min(candidates.size(), most_candidates));
    std::vector<double> values;
    values.reserve(candidates.size());
    for (const SharedValue& one : candidates)
        values.push_back(one.value);
    return values;
}

UndeclaredValues find_undeclared(const Window& window, const BorderCells& border,
                                 const UndeclaredRules& rules, const ReadValues& read) {
    constexpr std::int64_t cells_at_once = 1 << 20;
    const std::vector<double> candidates = border_candidates(border, rules.step);
    if (candidates.empty())
        return {};
    ValueRegions regions(candidates, rules.step);
    const auto cols = static_cast<std::size_t>(window.cols);
    const auto rows =
        static_cast<std::int32_t>(std::clamp<std::int64_t>(cells_at_once / window.cols, 1, 256));
    std::vector<double> values;
    for (std::int32_t row = window.row; row < window.end_row(); row += rows) {
        const Window part{row, window.col, std::min(rows, window.end_row() - row), window.cols};
        values.resize(static_cast<std::size_t>(part.points()));
        read(part, values);
        for (std::size_t i = 0; i < static_cast<std::size_t>(part.rows); ++i)
            regions.add(std::span<const double>(values).subspan(i * cols, cols));
    }
    return regions.finish(rules.least_breadth);
}

}  // namespace d2b
