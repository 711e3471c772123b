#include "core/undeclared_nodata.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>
#include <map>
#include <optional>
#include <utility>

#include "core/disjoint_sets.hpp"
#include "core/text.hpp"

namespace d2b {
namespace {

constexpr std::size_t max_candidates = 8;
constexpr std::uint8_t missing = max_candidates + 1;  // class of cells that are not valid
constexpr std::int64_t min_cells = 50;                // of a value: equality in a few cells means nothing
constexpr std::int64_t border_share = 1000;           // at least one of this many cells of the border
constexpr std::int64_t taken_share = 10;              // at least one of this many valid cells
constexpr std::int64_t named_share = 100;             // at least one of this many valid cells
// Tolerances, because a shore rises gently in some places, and so do values resampled across the edge of
// NoData.
constexpr double max_similar = 0.2;         // share of neighbours that differ by less than a step
constexpr double max_similar_border = 0.5;  // same for neighbours along the border, which are few
constexpr double min_land_share = 0.8;      // share of all other cells that is in broad regions

/// Differences along the boundary between a value and its neighbours.
struct Contour {
    std::int64_t steps = 0;
    std::int64_t similar = 0;  ///< neighbours that differ by less than a step

    [[nodiscard]] std::int64_t length() const { return steps + similar; }
    void add(double difference, double step) { ++(std::abs(difference) >= step ? steps : similar); }
    void merge(const Contour& other) {
        steps += other.steps;
        similar += other.similar;
    }
    [[nodiscard]] bool is_step(double most) const {
        return static_cast<double>(similar) <= most * static_cast<double>(length());
    }
};

/// Number of cells on a line away from a candidate among which a step is looked for, because cubic resampling
/// overshoots, so that the nearest ones may be close to the candidate.
constexpr int compared_cells = 3;

/// Returns the larger difference.
double larger(double one, double other) {
    return std::abs(other) > std::abs(one) ? other : one;
}

/// Returns the largest step on a line from a cell over its neighbour to the cells behind.
/// @param ends true for a cell that ends the line if it lies behind the neighbour
template <typename Ends>
double largest_step(std::span<const double> cells, std::size_t from, std::size_t neighbour,
                    const Ends& ends) {
    const bool right = neighbour > from;
    double step = cells[neighbour] - cells[from];
    for (int i = 1; i < compared_cells && !ends(neighbour); ++i) {
        from = neighbour;
        if (right ? from + 1 == cells.size() : from == 0)
            break;
        neighbour = right ? from + 1 : from - 1;
        if (ends(neighbour))
            break;
        step = larger(step, cells[neighbour] - cells[from]);
    }
    return step;
}

/// Connected cells (4-neighbours) of one candidate value, of none, or without a value.
struct Region {
    std::uint8_t of = 0;     ///< number of the candidate, from 1; 0: any other value; or `missing`
    bool at_edge = false;    ///< of the raster, or of missing cells that reach it
    std::int64_t cells = 0;  ///< valid cells
    Contour contour;         ///< boundary towards candidates, if this is not a candidate itself

    void merge(const Region& other) {
        at_edge = at_edge || other.at_edge;
        cells += other.cells;
        contour.merge(other.contour);
    }
};

/// Differences between neighbours, because a surface that was rounded to large steps has hardly any other
/// difference than its step.
class Differences {
  public:
    void add(double difference, double step);
    void merge(const Differences& other, std::int64_t sign);
    /// Returns the step of a surface that was rounded to at least `step`. 0: it was not.
    [[nodiscard]] double rounding() const;

  private:
    static constexpr double unit = 1e-4;  // of a difference, because floats are slightly off
    static constexpr double largest = 1e9;
    static constexpr std::size_t many = 4096;

    std::int64_t small_ = 0;                      ///< less than the step
    std::map<std::int64_t, std::int64_t> large_;  ///< pairs by difference; not all if these are many
};

/// Values found, and candidates that are elevations. Those are listed only if no land was found, because they
/// may be the land: the ground in whole metres, or level ground.
struct Verdict {
    UndeclaredNodata found;
    std::vector<double> elevations;
    double rounding = 0;  ///< step to which the other values were rounded; 0: less than that of the rules
};

/// Connected components of equal values, fed row by row from first to last.
class ValueRegions {
  public:
    ValueRegions(const std::vector<double>& candidates, double step)
        : candidates_(candidates),
          step_(step),
          beside_others_(candidates.size() + 1),
          differences_(candidates.size() + 1) {}

    void add(std::span<const double> row);
    /// @param min_breadth see UndeclaredNodataRules
    [[nodiscard]] Verdict finish(double min_breadth);

  private:
    struct Run {
        std::size_t begin;
        std::size_t end;
        std::uint32_t region;
    };
    [[nodiscard]] std::uint8_t class_of(double value) const;
    void add_runs(std::span<const double> row);
    void join_rows();
    void add_differences(std::span<const double> row);
    void add_difference(std::uint8_t of_one, std::uint8_t of_other, double difference);
    void add_contours(std::span<const double> row);
    void add_contact(std::uint32_t one, std::uint32_t other, double difference);
    void add_touch(std::uint32_t one, std::uint32_t other);
    [[nodiscard]] double difference_above(double value, std::size_t col) const;
    void add_contact_above(double value, std::size_t col);
    void look_below(double value, std::size_t col);
    /// Returns the candidate that is land because hardly any other value occurs: a flat terrain model. 0:
    /// none.
    [[nodiscard]] std::uint8_t level_land() const;
    [[nodiscard]] bool surrounds_land(std::uint8_t level, double min_breadth) const;
    /// Returns the candidates that are elevations if they do not surround land.
    [[nodiscard]] std::vector<double> elevations() const;
    /// Returns the step to which all values but a candidate were rounded. 0: less than that of the rules.
    [[nodiscard]] double rounding_beside(std::size_t candidate) const;
    /// Merges the regions of a candidate that reach the edge.
    [[nodiscard]] Region at_edge(std::size_t candidate) const;
    /// @param all regions of a candidate that reach the edge
    [[nodiscard]] bool may_be_nodata(const Region& all) const;
    /// Returns true if all other cells have one value as well, and are fewer: these are a hole in level land.
    [[nodiscard]] bool is_larger_than_constant(std::int64_t cells) const {
        return lowest_other_ == highest_other_ && 2 * cells > valid_;
    }

    const std::vector<double>& candidates_;
    double step_;
    std::int64_t valid_ = 0;
    double lowest_other_ =
        std::numeric_limits<double>::infinity();  ///< of cells that have no candidate's value
    double highest_other_ = -std::numeric_limits<double>::infinity();
    std::vector<std::int64_t> beside_others_;  ///< contacts with cells of no candidate, by its number
    std::vector<Differences> differences_;     ///< of pairs with a candidate by its number, and [0] of all
    DisjointSets sets_;
    std::vector<Region> regions_;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> touches_;  ///< candidates and missing cells
    std::vector<Run> above_;
    std::vector<Run> runs_;
    /// Row above, and its candidates.
    struct Row {
        std::vector<double> values;
        std::vector<std::uint8_t> classes;
    };
    /// Contact of a candidate with a cell below it, as long as the cells below that are compared.
    struct OpenContact {
        std::uint32_t candidate = 0;
        std::uint32_t below = 0;
        double value = 0;  ///< of the last of them
        double difference = 0;
        int rows_left = 0;
    };
    void close(OpenContact& contact);

    std::array<Row, compared_cells> rows_above_;  ///< nearest first; empty if there are fewer
    std::vector<OpenContact> open_;               ///< by column
    std::vector<std::uint8_t> classes_;
    std::vector<std::uint32_t> region_of_;        ///< by column
    std::vector<std::uint32_t> region_of_above_;  ///< by column
};

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

void ValueRegions::add_runs(std::span<const double> row) {
    for (std::size_t begin = 0; begin < row.size();) {
        std::size_t end = begin;
        while (end < row.size() && classes_[end] == classes_[begin])
            ++end;
        const auto valid = classes_[begin] == missing ? 0 : static_cast<std::int64_t>(end - begin);
        const std::uint32_t region = sets_.add();
        regions_.push_back(
            {classes_[begin], rows_above_[0].values.empty() || begin == 0 || end == row.size(), valid, {}});
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

void ValueRegions::add_contact(std::uint32_t one, std::uint32_t other, double difference) {
    regions_[sets_.find(one)].contour.add(difference, step_);
    regions_[sets_.find(other)].contour.add(difference, step_);
}

/// Keeps the contact of a candidate with missing cells. @param one, other regions, one of them missing
void ValueRegions::add_touch(std::uint32_t one, std::uint32_t other) {
    if (regions_[sets_.find(one)].of == missing)
        std::swap(one, other);
    if (regions_[sets_.find(one)].of != 0 && (touches_.empty() || touches_.back() != std::pair(one, other)))
        touches_.emplace_back(one, other);
}

void ValueRegions::close(OpenContact& contact) {
    add_contact(contact.candidate, contact.below, contact.difference);
    contact.rows_left = 0;
}

/// Returns the largest step on the line from a candidate to the cells above.
double ValueRegions::difference_above(double value, std::size_t col) const {
    double difference = 0;
    for (const Row& row : rows_above_) {
        if (row.values.empty() || row.classes[col] != 0)
            break;
        difference = larger(difference, row.values[col] - value);
        value = row.values[col];
    }
    return difference;
}

/// Continues the line that leads down from a candidate.
void ValueRegions::look_below(double value, std::size_t col) {
    OpenContact& contact = open_[col];
    if (contact.rows_left == 0)
        return;
    const bool ends = classes_[col] != 0;
    if (!ends)
        contact.difference = larger(contact.difference, value - std::exchange(contact.value, value));
    if (ends || --contact.rows_left == 0)
        close(contact);
}

void ValueRegions::add_contact_above(double value, std::size_t col) {
    const double above = rows_above_[0].values[col];
    const std::uint8_t of_above = rows_above_[0].classes[col];
    if (classes_[col] == of_above)
        return;
    if (classes_[col] == missing || of_above == missing)
        add_touch(region_of_above_[col], region_of_[col]);
    else if (of_above == 0)
        add_contact(region_of_above_[col], region_of_[col], difference_above(value, col));
    else if (classes_[col] == 0)
        open_[col] = {region_of_above_[col], region_of_[col], value, value - above, compared_cells - 1};
    else
        add_contact(region_of_above_[col], region_of_[col], value - above);
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

void ValueRegions::add_differences(std::span<const double> row) {
    const Row& above = rows_above_[0];
    for (std::size_t c = 0; c < row.size(); ++c) {
        if (c > 0)
            add_difference(classes_[c - 1], classes_[c], row[c] - row[c - 1]);
        if (!above.values.empty())
            add_difference(above.classes[c], classes_[c], row[c] - above.values[c]);
    }
}

void ValueRegions::add_contours(std::span<const double> row) {
    open_.resize(row.size());
    const auto ends = [&](std::size_t i) { return classes_[i] != 0; };
    for (std::size_t c = 0; c < row.size(); ++c) {
        const bool changes = c > 0 && classes_[c - 1] != classes_[c];
        if (changes && (classes_[c - 1] == missing || classes_[c] == missing)) {
            add_touch(region_of_[c - 1], region_of_[c]);
        } else if (changes) {
            const bool from_left = classes_[c - 1] != 0;
            add_contact(region_of_[c - 1], region_of_[c],
                        from_left ? largest_step(row, c - 1, c, ends) : largest_step(row, c, c - 1, ends));
        }
        look_below(row[c], c);
        if (!rows_above_[0].values.empty())
            add_contact_above(row[c], c);
    }
}

void ValueRegions::add(std::span<const double> row) {
    classes_.resize(row.size());
    region_of_.resize(row.size());
    runs_.clear();
    std::ranges::transform(row, classes_.begin(), [this](double value) { return class_of(value); });
    for (std::size_t i = 0; i < row.size(); ++i)
        if (classes_[i] == 0) {
            lowest_other_ = std::min(lowest_other_, row[i]);
            highest_other_ = std::max(highest_other_, row[i]);
        }
    add_runs(row);
    join_rows();
    add_differences(row);
    add_contours(row);
    std::swap(above_, runs_);
    std::swap(region_of_, region_of_above_);
    std::rotate(rows_above_.begin(), rows_above_.end() - 1, rows_above_.end());
    rows_above_[0].values.assign(row.begin(), row.end());
    std::swap(rows_above_[0].classes, classes_);
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
    return all.cells >= min_cells && named_share * all.cells >= valid_ && all.contour.length() > 0 &&
           all.contour.is_step(max_similar);
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
    for (const Run& run : above_)
        regions_[sets_.find(run.region)].at_edge = true;
    for (OpenContact& contact : open_)
        if (contact.rows_left > 0)
            close(contact);
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

/// Reads a window in parts and passes on its rows.
template <typename Take>
void for_each_row(const Window& window, const ReadValues& read, const Take& take) {
    constexpr std::int64_t cells_at_once = 1 << 20;
    if (window.points() == 0)
        return;
    const auto cols = static_cast<std::size_t>(window.cols);
    const auto rows =
        static_cast<std::int32_t>(std::clamp<std::int64_t>(cells_at_once / window.cols, 1, 256));
    std::vector<double> values;
    for (std::int32_t row = window.row; row < window.end_row(); row += rows) {
        const Window part{row, window.col, std::min(rows, window.end_row() - row), window.cols};
        values.resize(static_cast<std::size_t>(part.points()));
        read(part, values);
        for (std::size_t i = 0; i < static_cast<std::size_t>(part.rows); ++i)
            take(std::span<const double>(values).subspan(i * cols, cols));
    }
}

struct BorderCount {
    std::int64_t cells = 0;
    Contour contour;
};

void count_along(std::span<const double> cells, double step, std::map<double, BorderCount>& counts) {
    const auto is_missing = [&](std::size_t i) { return std::isnan(cells[i]); };
    for (std::size_t i = 0; i < cells.size(); ++i) {
        if (std::isnan(cells[i]))
            continue;
        ++counts[cells[i]].cells;
        if (i == 0 || std::isnan(cells[i - 1]) || cells[i] == cells[i - 1])
            continue;
        counts[cells[i]].contour.add(largest_step(cells, i, i - 1, is_missing), step);
        counts[cells[i - 1]].contour.add(largest_step(cells, i - 1, i, is_missing), step);
    }
}

/// Finds the values next to the outermost cells.
UndeclaredNodata find_at_border(const Window& window, const BorderCells& border,
                                const UndeclaredNodataRules& rules, const ReadValues& read) {
    double step = rules.step;
    std::vector<double> candidates = border_candidates(border, step);
    while (!candidates.empty()) {
        ValueRegions regions(candidates, step);
        for_each_row(window, read, [&](std::span<const double> row) { regions.add(row); });
        const Verdict verdict = regions.finish(rules.min_breadth);
        if (verdict.rounding > 0) {
            // Each value of a surface that was rounded to large steps is a large step away from the others.
            step = 1.5 * verdict.rounding;
            candidates = border_candidates(border, step);
        } else if (verdict.elevations.empty()) {
            return verdict.found;
        } else {
            std::erase_if(candidates, [&](double candidate) {
                return std::ranges::find(verdict.elevations, candidate) != verdict.elevations.end();
            });
        }
    }
    return {};
}

}  // namespace

std::vector<double> UndeclaredNodata::values() const {
    std::vector<double> all;
    for (const SharedValue& one : taken)
        all.push_back(one.value);
    return all;
}

std::string undeclared_text(const SharedValue& value, const std::string& raster) {
    return cells_have(value.cells, raster) + "the elevation " + value_text(value.value) +
           ", lie at its edge, and most cells around are at least " +
           number_text(UndeclaredNodataRules::step_m) + " m higher or lower";
}

void BorderCells::add_rows(std::int32_t rows,
                           const std::function<std::span<const double>(std::int32_t)>& row_at) {
    const auto is_valid = [](double value) { return !std::isnan(value); };
    std::optional<std::int32_t> last;
    for (std::int32_t i = 0; i < rows; ++i) {
        const std::span<const double> row = row_at(i);
        const auto first = std::ranges::find_if(row, is_valid);
        if (first == row.end())
            continue;
        left.push_back(*first);
        right.push_back(*std::find_if(row.rbegin(), row.rend(), is_valid));
        if (top.empty())
            top.assign(row.begin(), row.end());
        last = i;
    }
    if (last) {
        const std::span<const double> row = row_at(*last);
        bottom.assign(row.begin(), row.end());
    }
}

BorderCells read_border(const Window& window, const ReadValues& read) {
    const auto strip = [&](const Window& part) {
        std::vector<double> values(static_cast<std::size_t>(part.points()));
        read(part, values);
        return values;
    };
    if (window.points() == 0)
        return {};
    BorderCells border{strip({window.row, window.col, 1, window.cols}),
                       strip({window.end_row() - 1, window.col, 1, window.cols}),
                       strip({window.row, window.col, window.rows, 1}),
                       strip({window.row, window.end_col() - 1, window.rows, 1})};
    if (std::ranges::all_of(border.sides(), [](const std::vector<double>* side) {
            return std::ranges::none_of(*side, [](double value) { return std::isnan(value); });
        }))
        return border;
    border = {};
    for_each_row(window, read,
                 [&](std::span<const double> row) { border.add_rows(1, [&](std::int32_t) { return row; }); });
    return border;
}

std::vector<double> border_candidates(const BorderCells& border, double step) {
    std::map<double, BorderCount> counts;
    std::size_t all = 0;
    for (const std::vector<double>* side : border.sides()) {
        count_along(*side, step, counts);
        all += side->size();
    }
    const std::int64_t least =
        std::max<std::int64_t>(2, (static_cast<std::int64_t>(all) + border_share - 1) / border_share);
    std::vector<SharedValue> candidates;
    for (const auto& [value, count] : counts)
        if (count.cells >= least && count.contour.is_step(max_similar_border))
            candidates.push_back({value, count.cells});
    std::ranges::stable_sort(candidates, std::ranges::greater{}, &SharedValue::cells);
    candidates.resize(std::min(candidates.size(), max_candidates));
    std::vector<double> values;
    values.reserve(candidates.size());
    for (const SharedValue& one : candidates)
        values.push_back(one.value);
    return values;
}

UndeclaredNodata find_undeclared_nodata(const Window& window, const BorderCells& border,
                                        const UndeclaredNodataRules& rules, const ReadValues& read) {
    UndeclaredNodata found = find_at_border(window, border, rules, read);
    for (const std::vector<double>* side : border.sides())
        for (const double value : *side)
            if (!std::isnan(value))
                found.lowest_at_edge = std::min(value, found.lowest_at_edge.value_or(value));
    for (UndeclaredNodata outer = found; !outer.taken.empty();) {
        // Another value may surround the rest, because rasters are cut out and warped more than once.
        const std::vector<double> values = found.values();
        const ReadValues read_rest = [&](const Window& part, std::span<double> cells) {
            read(part, cells);
            for (const double value : values)
                std::ranges::replace(cells, value, std::numeric_limits<double>::quiet_NaN());
        };
        outer = find_at_border(window, read_border(window, read_rest), rules, read_rest);
        found.taken.insert(found.taken.end(), outer.taken.begin(), outer.taken.end());
        found.named = outer.named;
    }
    return found;
}

}  // namespace d2b
