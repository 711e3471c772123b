#include "core/invalid_elevations.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <iterator>

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
    : lowest_(limits.lowest),
      apart_(apart_m / metres),
      below_(below_m / metres),
      bins_a_unit_(bins_apart / apart_) {
    const double bins = (limits.highest - limits.lowest) * bins_a_unit_;
    if (bins < most_bins)
        bins_.resize(static_cast<std::size_t>(bins) + 1);
}

void ValueBins::add_to_bin(double value, std::int64_t cells) {
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
    low_ = reader.take<Low>();
}

void ValueBins::merge(const ValueBins& other) {
    low_.add(other.low_.value, other.low_.cells);
    low_.add(other.low_.next, 0);
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

std::optional<SharedValue> ValueBins::far_below(std::int64_t cells) const {
    constexpr std::int64_t least_share = 10;  // one in this many
    if (!std::isfinite(low_.next) || least_share * low_.cells < cells || !(low_.next - low_.value > below_))
        return {};
    return SharedValue{low_.value, low_.cells};
}

std::string far_below_text(const SharedValue& value, const std::string& raster) {
    return cells_have(value.cells, raster) + "the elevation " + value_text(value.value) + ", more than " +
           number_text(ValueBins::below_m) + " m below any other";
}

std::string second_nodata_advice(double stored, double nodata) {
    const std::string value = value_text(nodata);
    return "set these cells to the NoData value " + value +
           ", for example with gdal_calc.py --calc=\"where(A==" + value_text(stored) + "," + value +
           ",A)\" --NoDataValue=" + value;
}

std::string isolated_text(const SharedValue& value, const std::string& raster) {
    return cells_have(value.cells, raster) + "the elevation " + value_text(value.value) + ", more than " +
           number_text(ValueBins::apart_m) + " m from any other";
}

}  // namespace d2b
