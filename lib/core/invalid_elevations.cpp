#include "core/invalid_elevations.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
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
constexpr double min_region_share = 0.2;    // share of all other cells that one broad region has

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
    /// @param min_breadth see UndeclaredNodataRules
    [[nodiscard]] UndeclaredNodata finish(double min_breadth);

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
    void add_contact(std::size_t a, std::uint8_t of_a, double value_a, std::size_t b, std::uint8_t of_b,
                     double value_b, const std::vector<std::uint32_t>& regions_a);
    /// Returns the candidate that is land because hardly any other value occurs: a flat terrain model. 0:
    /// none.
    [[nodiscard]] std::uint8_t level_land() const;
    [[nodiscard]] bool surrounds_land(std::uint8_t level, double min_breadth) const;

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
void ValueRegions::add_contact(std::size_t a, std::uint8_t of_a, double value_a, std::size_t b,
                               std::uint8_t of_b, double value_b,
                               const std::vector<std::uint32_t>& regions_a) {
    if (of_a == of_b || std::isnan(value_a) || std::isnan(value_b))
        return;
    const double difference = value_a - value_b;
    regions_[sets_.find(regions_a[a])].contour.add(difference, step_);
    regions_[sets_.find(region_of_[b])].contour.add(difference, step_);
}

void ValueRegions::add_contours(std::span<const double> row) {
    for (std::size_t c = 0; c < row.size(); ++c) {
        if (c > 0)
            add_contact(c - 1, classes_[c - 1], row[c - 1], c, classes_[c], row[c], region_of_);
        if (!values_above_.empty())
            add_contact(c, classes_above_[c], values_above_[c], c, classes_[c], row[c], region_of_above_);
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

/// Returns true if the candidates surround land in few regions that are broader than buildings. @param level
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
        if (cells >= min_region_share * static_cast<double>(all) &&
            4 * cells >= min_breadth * static_cast<double>(region.contour.length()))
            land += region.cells;
    }
    return all > 0 && static_cast<double>(land) >= min_land_share * static_cast<double>(all);
}

UndeclaredNodata ValueRegions::finish(double min_breadth) {
    for (const Run& run : above_)
        regions_[sets_.find(run.region)].at_edge = true;
    UndeclaredNodata found;
    const std::uint8_t level = level_land();
    if (!surrounds_land(level, min_breadth))
        return found;
    for (std::size_t i = 0; i < candidates_.size(); ++i) {
        if (i + 1 == level)
            continue;
        Region all;
        for (std::uint32_t k = 0; k < sets_.size(); ++k)
            if (sets_.is_root(k) && regions_[k].of == i + 1 && regions_[k].at_edge)
                all.merge(regions_[k]);
        if (all.cells < min_cells || all.contour.length() == 0 || !all.contour.is_step(max_similar))
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

std::vector<double> UndeclaredNodata::values() const {
    std::vector<double> all;
    for (const SharedValue& one : taken)
        all.push_back(one.value);
    return all;
}

std::string undeclared_text(const SharedValue& value, const std::string& raster) {
    return cells_have(value.cells, raster) + "the elevation " + value_text(value.value) +
           ", lie at its edge, and all around is at least " + number_text(UndeclaredNodataRules::step_m) +
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
    return regions.finish(rules.min_breadth);
}

}  // namespace d2b
