#include "elevations/value_bins.hpp"

#include <algorithm>
#include <iterator>

namespace d2b {
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
    const auto at = static_cast<std::size_t>((value - lowest_) * bins_a_unit_);
    Bin& bin = bins_[std::min(at, bins_.size() - 1)];
    bin.cells += cells;
    bin.lowest = std::min(bin.lowest, value);
    bin.highest = std::max(bin.highest, value);
}

void ValueBins::load(ByteReader& reader) {
    const auto bins = reader.take_list<Bin>();
    if (bins.size() != bins_.size())
        throw BrokenRecord("it is of other limits");
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

}  // namespace d2b
