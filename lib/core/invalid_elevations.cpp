#include "core/invalid_elevations.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <utility>

#include "core/disjoint_sets.hpp"
#include "core/text.hpp"

namespace d2b {

std::string value_text(double value) {
    constexpr double large = 1e15;
    const double size = std::abs(value);
    if (size < large || size > static_cast<double>(std::numeric_limits<float>::max()))
        return number_text(value);
    const auto single = static_cast<float>(value);
    if (static_cast<double>(single) != value)
        return number_text(value);
    std::array<char, 32> text{};
    return {text.data(), std::to_chars(text.data(), text.data() + text.size(), single).ptr};
}

double stored_value(double elevation, double scale, double offset) {
    const double stored = (elevation - offset) / scale;
    const double nearest = std::round(stored);
    return std::abs(stored - nearest) <= 1e-6 * std::max(1.0, std::abs(stored)) ? nearest : stored;
}

std::string cells_have(std::int64_t cells, const std::string& raster) {
    return std::to_string(cells) + (cells == 1 ? " cell of " : " cells of ") + raster +
           (cells == 1 ? " has " : " have ");
}

void ValueCounts::add(double value, std::int64_t cells) {
    cells_ += cells;
    lowest_ = std::min(lowest_, value);
    highest_ = std::max(highest_, value);
    if (many_)
        return;
    counts_[value] += cells;
    many_ = counts_.size() > most_values;
    if (many_)
        counts_.clear();
}

void ValueCounts::merge(const ValueCounts& other) {
    cells_ += other.cells_;
    lowest_ = std::min(lowest_, other.lowest_);
    highest_ = std::max(highest_, other.highest_);
    for (const auto& [value, cells] : other.counts_)
        counts_[value] += cells;
    many_ = many_ || other.many_ || counts_.size() > most_values;
    if (many_)
        counts_.clear();
}

void ValueCounts::save(ByteWriter& writer) const {
    writer.put(cells_);
    writer.put(lowest_);
    writer.put(highest_);
    writer.put(many_);
    writer.put(static_cast<std::uint64_t>(counts_.size()));
    for (const auto& [value, cells] : counts_)
        writer.put(SharedValue{value, cells});
}

ValueCounts ValueCounts::load(ByteReader& reader) {
    ValueCounts counts;
    counts.cells_ = reader.take<std::int64_t>();
    counts.lowest_ = reader.take<double>();
    counts.highest_ = reader.take<double>();
    counts.many_ = reader.take<std::uint8_t>() != 0;
    for (const SharedValue& shared : reader.take_list<SharedValue>())
        counts.counts_[shared.value] = shared.cells;
    return counts;
}

std::optional<SharedValue> ValueCounts::most() const {
    if (counts_.empty())
        return {};
    const auto& [value, cells] =
        *std::ranges::max_element(counts_, {}, [](const auto& count) { return count.second; });
    return SharedValue{value, cells};
}

std::optional<std::int64_t> ValueCounts::cells_of(double value) const {
    if (many_)
        return {};
    const auto found = counts_.find(value);
    return found == counts_.end() ? 0 : found->second;
}

std::string ValueCounts::text(const std::string& raster) const {
    const std::string have = cells_have(cells_, raster);
    if (lowest_ == highest_)
        return have + "the elevation " + value_text(lowest_);
    const std::string range = "elevations from " + value_text(lowest_) + " to " + value_text(highest_);
    const std::optional<SharedValue> shared = most();
    if (!shared || shared->cells == 1)
        return have + range;
    return have + range + " (" + std::to_string(shared->cells) + " of them " + value_text(shared->value) +
           ")";
}

namespace {

constexpr double bins_apart = 2;  // bins per distance that isolates a value
constexpr double most_bins = 4096;

}  // namespace

ValueBins::ValueBins(const ElevationLimits& limits, double metres)
    : lowest_(limits.lowest), apart_(apart_m / metres), bins_a_unit_(bins_apart / apart_) {
    const double bins = (limits.highest - limits.lowest) * bins_a_unit_;
    if (bins < most_bins)
        bins_.resize(static_cast<std::size_t>(bins) + 1);
}

void ValueBins::add(double value, std::int64_t cells) {
    if (bins_.empty())
        return;
    const auto at = static_cast<std::size_t>((value - lowest_) * bins_a_unit_);
    Bin& bin = bins_[std::min(at, bins_.size() - 1)];
    bin.cells += cells;
    bin.lowest = std::min(bin.lowest, value);
    bin.highest = std::max(bin.highest, value);
}

void ValueBins::load(ByteReader& reader) {
    const auto bins = reader.take_list<Bin>();
    if (bins.size() != bins_.size())
        throw CorruptRecord("it is of other limits");
    bins_ = bins;
}

void ValueBins::merge(const ValueBins& other) {
    for (std::size_t i = 0; i < bins_.size(); ++i) {
        bins_[i].cells += other.bins_[i].cells;
        bins_[i].lowest = std::min(bins_[i].lowest, other.bins_[i].lowest);
        bins_[i].highest = std::max(bins_[i].highest, other.bins_[i].highest);
    }
}

std::vector<SharedValue> ValueBins::shared(std::int64_t cells) const {
    constexpr std::int64_t fewest = 10;
    constexpr std::int64_t least_share = 1000;  // one in this many
    std::vector<Bin> some;
    std::ranges::copy_if(bins_, std::back_inserter(some), [](const Bin& bin) { return bin.cells > 0; });
    std::vector<SharedValue> shared;
    for (std::size_t i = 0; i < some.size() && some.size() > 1; ++i) {
        const Bin& bin = some[i];
        const bool alone = bin.lowest == bin.highest &&
                           (i == 0 || bin.lowest - some[i - 1].highest > apart_) &&
                           (i + 1 == some.size() || some[i + 1].lowest - bin.highest > apart_);
        if (alone && bin.cells >= fewest && bin.cells >= (cells + least_share - 1) / least_share)
            shared.push_back({bin.lowest, bin.cells});
    }
    return shared;
}

namespace {

constexpr std::size_t max_candidates = 8;
constexpr std::int64_t min_cells = 50;       // of a value: equality in a few cells means nothing
constexpr std::int64_t border_share = 1000;  // at least one of this many cells of the border
constexpr std::int64_t taken_share = 10;     // at least one of this many valid cells
constexpr std::int64_t named_share = 100;    // at least one of this many valid cells
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

/// Values found, and candidates that are elevations. Those are listed only if no land was found, because they
/// may be the land: the ground in whole metres.
struct Verdict {
    UndeclaredNodata found;
    std::vector<double> elevations;
};

/// Connected components of equal values, fed row by row from first to last.
class ValueRegions {
  public:
    ValueRegions(const std::vector<double>& candidates, double step) : candidates_(candidates), step_(step) {}

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
    void add_contours(std::span<const double> row);
    void add_contact(std::uint32_t one, std::uint32_t other, double difference);
    [[nodiscard]] double difference_above(double value, std::size_t col) const;
    void add_contact_above(double value, std::size_t col);
    void look_below(double value, std::size_t col);
    /// Returns the candidate that is land because hardly any other value occurs: a flat terrain model. 0:
    /// none.
    [[nodiscard]] std::uint8_t level_land() const;
    [[nodiscard]] bool surrounds_land(std::uint8_t level, double min_breadth) const;
    /// Merges the regions of a candidate that reach the edge.
    [[nodiscard]] Region at_edge(std::size_t candidate) const;
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
    DisjointSets sets_;
    std::vector<Region> regions_;
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

void ValueRegions::close(OpenContact& contact) {
    add_contact(contact.candidate, contact.below, contact.difference);
    contact.rows_left = 0;
}

/// Returns the largest step on the line from a candidate to the cells above.
double ValueRegions::difference_above(double value, std::size_t col) const {
    double difference = 0;
    for (const Row& row : rows_above_) {
        if (row.values.empty() || row.classes[col] != 0 || std::isnan(row.values[col]))
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
    const bool ends = classes_[col] != 0 || std::isnan(value);
    if (!ends)
        contact.difference = larger(contact.difference, value - std::exchange(contact.value, value));
    if (ends || --contact.rows_left == 0)
        close(contact);
}

void ValueRegions::add_contact_above(double value, std::size_t col) {
    const double above = rows_above_[0].values[col];
    const std::uint8_t of_above = rows_above_[0].classes[col];
    if (classes_[col] == of_above || std::isnan(value) || std::isnan(above))
        return;
    if (of_above == 0)
        add_contact(region_of_above_[col], region_of_[col], difference_above(value, col));
    else if (classes_[col] == 0)
        open_[col] = {region_of_above_[col], region_of_[col], value, value - above, compared_cells - 1};
    else
        add_contact(region_of_above_[col], region_of_[col], value - above);
}

void ValueRegions::add_contours(std::span<const double> row) {
    open_.resize(row.size());
    const auto ends = [&](std::size_t i) { return classes_[i] != 0 || std::isnan(row[i]); };
    for (std::size_t c = 0; c < row.size(); ++c) {
        if (c > 0 && classes_[c - 1] != classes_[c] && !std::isnan(row[c - 1]) && !std::isnan(row[c])) {
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
        if (classes_[i] == 0 && !std::isnan(row[i])) {
            lowest_other_ = std::min(lowest_other_, row[i]);
            highest_other_ = std::max(highest_other_, row[i]);
        }
    add_runs(row);
    join_rows();
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
        if (sets_.is_root(i))
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

Verdict ValueRegions::finish(double min_breadth) {
    for (const Run& run : above_)
        regions_[sets_.find(run.region)].at_edge = true;
    for (OpenContact& contact : open_)
        if (contact.rows_left > 0)
            close(contact);
    Verdict verdict;
    const std::uint8_t level = level_land();
    const bool land = surrounds_land(level, min_breadth);
    for (std::size_t i = 0; i < candidates_.size(); ++i) {
        const Region all = at_edge(i);
        if (!land) {
            if (!all.contour.is_step(max_similar))
                verdict.elevations.push_back(candidates_[i]);
            continue;
        }
        if (i + 1 == level || all.cells < min_cells || all.contour.length() == 0 ||
            !all.contour.is_step(max_similar) || is_larger_than_constant(all.cells))
            continue;
        if (taken_share * all.cells >= valid_)
            verdict.found.taken.push_back({candidates_[i], all.cells});
        else if (named_share * all.cells >= valid_)
            verdict.found.named.push_back({candidates_[i], all.cells});
    }
    return verdict;
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

std::string isolated_text(const SharedValue& value, const std::string& raster) {
    return cells_have(value.cells, raster) + "the elevation " + value_text(value.value) + ", more than " +
           number_text(ValueBins::apart_m) + " m from any other";
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
    constexpr std::int64_t cells_at_once = 1 << 20;
    std::vector<double> candidates = border_candidates(border, rules.step);
    const auto cols = static_cast<std::size_t>(window.cols);
    const auto rows =
        static_cast<std::int32_t>(std::clamp<std::int64_t>(cells_at_once / std::max(window.cols, 1), 1, 256));
    std::vector<double> values;
    while (!candidates.empty()) {
        ValueRegions regions(candidates, rules.step);
        for (std::int32_t row = window.row; row < window.end_row(); row += rows) {
            const Window part{row, window.col, std::min(rows, window.end_row() - row), window.cols};
            values.resize(static_cast<std::size_t>(part.points()));
            read(part, values);
            for (std::size_t i = 0; i < static_cast<std::size_t>(part.rows); ++i)
                regions.add(std::span<const double>(values).subspan(i * cols, cols));
        }
        const Verdict verdict = regions.finish(rules.min_breadth);
        if (verdict.elevations.empty())
            return verdict.found;
        std::erase_if(candidates, [&](double candidate) {
            return std::ranges::find(verdict.elevations, candidate) != verdict.elevations.end();
        });
    }
    return {};
}

}  // namespace d2b
