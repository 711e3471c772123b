#include "features/suspicious_values.hpp"

#include <algorithm>
#include <cmath>

#include "core/text.hpp"
#include "dem2buildings/error.hpp"
#include "raster/blended_margin.hpp"

namespace d2b::features {
namespace {

/// Converts a value to the form of -snodata: before scale and offset.
std::string stored_text(double elevation, const DemInfo& info) {
    return value_text(stored_value(elevation, info.scale, info.offset));
}

class Strange {
  public:
    Strange(const DemInfo& info, const ReadOptions& options, Context& context)
        : info_(info), options_(options), context_(context), name_("'" + info.name + "'") {}

    void refuse_most(const ValueCounts& outside, std::int64_t valid) const;
    void warn_of_outside(const ValueCounts& outside) const;
    void warn_of_spikes(const ValueCounts& spikes) const;
    void warn_of_undeclared(const SuspiciousValues& suspicious, const UndeclaredNodata& undeclared) const;
    void warn_of_blended(std::int64_t cells, const BlendedMargin& margin) const;
    /// @param told values that were reported already
    void warn_of_shared(const SuspiciousValues& suspicious, std::int64_t cells,
                        const std::vector<SharedValue>& told) const;
    /// @param low value that no cell at the edge has
    void warn_of_hole(const SharedValue& low) const;
    void warn_of_set_aside(std::int64_t cells) const;

  private:
    /// "outside the range of land, -500 to 9000 m"
    [[nodiscard]] std::string not_in_range() const;
    /// Returns the remedy if a value stands for no data.
    [[nodiscard]] std::string nodata_advice(double elevation) const;
    /// Returns the option that declares a value, or another way if a NoData value is in use, which -snodata
    /// would make an elevation. @param give verb before the option
    [[nodiscard]] std::string declaration(const std::string& give, double elevation) const;
    /// Returns ", and if not, -inodata" after such an advice, with a verb if that of the advice does not fit.
    [[nodiscard]] std::string otherwise(const std::string& option) const {
        return std::string(", and if not, ") + (info_.nodata ? "give " : "") + option;
    }
    [[nodiscard]] bool is_own_nodata(double elevation) const { return info_.overridden_nodata == elevation; }

    const DemInfo& info_;
    const ReadOptions& options_;
    Context& context_;
    std::string name_;
};

std::string Strange::not_in_range() const {
    if (const auto& range = options_.elevation_range)
        return "outside of -zrange " + number_text((*range)[0]) + " " + number_text((*range)[1]);
    std::string text = "outside the range of land, " + number_text(land_elevations.lowest) + " to " +
                       number_text(land_elevations.highest) + " m";
    if (const UnitReport& units = context_.report.units; units.vertical_metres != 1)
        text += ", in the unit " + units.vertical;
    return text;
}

std::string Strange::nodata_advice(double elevation) const {
    if (is_own_nodata(elevation))
        return std::string("it is the NoData value that the file declares, so leave out ") +
               (options_.ignore_nodata ? "-inodata" : "-snodata");
    return "if " + value_text(elevation) + " stands for no data, " + declaration("give", elevation);
}

std::string Strange::declaration(const std::string& give, double elevation) const {
    if (info_.nodata)
        return second_nodata_advice(stored_value(elevation, info_.scale, info_.offset),
                                    stored_value(*info_.nodata, info_.scale, info_.offset));
    return give + " -snodata " + stored_text(elevation, info_);
}

void Strange::refuse_most(const ValueCounts& outside, std::int64_t valid) const {
    if (outside.cells() <= valid)
        return;
    const auto most = outside.most();
    throw InputError(
        outside.text(name_) + ", which is " + not_in_range() +
        ", and these are more than half of all; give the unit of the elevations with -zunit, the "
        "range in which they lie with -zrange" +
        (most ? ", or the value that stands for no data with -snodata " + stored_text(most->value, info_)
              : "") +
        ".");
}

void Strange::warn_of_outside(const ValueCounts& outside) const {
    if (outside.cells() == 0)
        return;
    const auto most = outside.most();
    std::string advice = "give the range of elevations with -zrange";
    if (most)
        advice = nodata_advice(most->value) +
                 (is_own_nodata(most->value) ? "" : otherwise("the range with -zrange"));
    context_.warn(outside.text(name_) + ", which is " + not_in_range() + ", and " +
                  (outside.cells() == 1 ? "is" : "are") + " treated as no data; " + advice + ".");
}

void Strange::warn_of_spikes(const ValueCounts& spikes) const {
    if (spikes.cells() == 0)
        return;
    const auto most = spikes.most();
    context_.warn(spikes.text(name_) + ", more than " + number_text(spikes_m.invalid_above) +
                  " m above all cells around, and " + (spikes.cells() == 1 ? "is" : "are") +
                  " treated as no data" + (most ? "; " + nodata_advice(most->value) : "") + ".");
}

void Strange::warn_of_undeclared(const SuspiciousValues& suspicious,
                                 const UndeclaredNodata& undeclared) const {
    for (const SharedValue& taken : undeclared.taken) {
        const std::int64_t cells = suspicious.undeclared.cells_of(taken.value).value_or(taken.cells);
        // To declare a value that was blended with others would not help, see warn_of_blended().
        const bool blended = undeclared.margin.cells > 0 && undeclared.margin.with == taken.value;
        context_.warn(undeclared_text({taken.value, cells}, name_) + ", so they are treated as no data; " +
                      (blended ? "" : declaration("declare that with", taken.value) + ", or ") +
                      "keep the elevation with -inodata.");
    }
    for (const SharedValue& named : undeclared.named)
        context_.warn(undeclared_text(named, name_) + "; if it stands for no data, " +
                      declaration("give", named.value) + otherwise("-inodata") + ".");
}

void Strange::warn_of_blended(std::int64_t cells, const BlendedMargin& margin) const {
    if (cells > 0)
        context_.warn(
            blended_text(cells, margin, name_, margin.with ? stored_text(*margin.with, info_) : ""));
}

void Strange::warn_of_shared(const SuspiciousValues& suspicious, std::int64_t cells,
                             const std::vector<SharedValue>& told) const {
    for (const auto& [value, sharing] : suspicious.bins.shared(cells))
        if (info_.overridden_nodata != value &&
            std::ranges::find(told, value, &SharedValue::value) == told.end())
            context_.warn(isolated_text({value, sharing}, name_) + "; " + nodata_advice(value) + ".");
}

void Strange::warn_of_hole(const SharedValue& low) const {
    context_.warn(far_below_text(low, name_) + ", and lie inside; " + nodata_advice(low.value) +
                  otherwise("-inodata") + ".");
}

void Strange::warn_of_set_aside(std::int64_t cells) const {
    if (cells == 0 || options_.ignore_nodata || !info_.overridden_nodata)
        return;
    const std::string value = value_text(*info_.overridden_nodata);
    context_.warn(cells_have(cells, name_) + "the elevation " + value +
                  ", the NoData value that the file declares and -snodata overrides; if it stands for no "
                  "data, leave out -snodata.");
}

constexpr double highest_m = 1000;     // the highest building of the world has 828 m
constexpr double negligible_m = 1e-6;  // rounding error of a mean

std::string whole_metres(double metres) {
    return value_text(std::round(metres)) + " m";
}

std::string advice(double elevation) {
    return " has an elevation of " + value_text(elevation) +
           "; give the value that stands for no data with -snodata, the range of elevations with -zrange, or "
           "their "
           "unit "
           "with -zunit.";
}

/// "Building 3 is", "12 buildings are"
std::string who(std::int64_t buildings, std::int64_t id, const char* one, const char* more) {
    return buildings == 1 ? "Building " + std::to_string(id) + one
                          : std::to_string(buildings) + " buildings" + more;
}

}  // namespace

void report_suspicious_values(const SuspiciousValues& suspicious, std::int64_t valid,
                              const UndeclaredNodata& undeclared, const DemInfo& info,
                              const ReadOptions& options, Context& context) {
    RunReport& report = context.report;
    report.count(Reason::elevation_outside_range, suspicious.outside.cells());
    report.count(Reason::elevation_undeclared_nodata, suspicious.undeclared.cells());
    report.count(Reason::elevation_blended, suspicious.blended);
    report.count(Reason::elevation_spike, suspicious.spikes.cells());
    report.count(Reason::roof_spike, suspicious.spires);
    const Strange of(info, options, context);
    const std::int64_t within = valid + suspicious.spikes.cells();
    of.refuse_most(suspicious.outside, within);
    of.warn_of_outside(suspicious.outside);
    of.warn_of_set_aside(suspicious.overridden_nodata);
    of.warn_of_spikes(suspicious.spikes);
    of.warn_of_undeclared(suspicious, undeclared);
    of.warn_of_blended(suspicious.blended, undeclared.margin);
    std::vector<SharedValue> told = undeclared.named;
    if (const auto low = suspicious.bins.far_below(within);
        low && undeclared.lowest_at_edge && low->value < *undeclared.lowest_at_edge) {
        of.warn_of_hole(*low);
        told.push_back(*low);
    }
    of.warn_of_shared(suspicious, within, told);
}

void ImplausibleHeights::Extreme::add(std::int64_t building, double metres, double extreme, bool farther) {
    if (buildings++ == 0 || farther) {
        id = building;
        height_m = metres;
        elevation = extreme;
    }
}

void ImplausibleHeights::note(const BuildingRecord& building, const ContourRecord& footprint) {
    if (building.height_m > highest_m)
        high_.add(building.id, building.height_m, building.roof, building.height_m > high_.height_m);
    if (building.mean_m < -negligible_m)
        low_.add(building.id, building.mean_m, footprint.lowest, building.mean_m < low_.height_m);
}

std::vector<std::string> ImplausibleHeights::warnings() const {
    std::vector<std::string> sentences;
    if (high_.buildings > 0)
        sentences.push_back(who(high_.buildings, high_.id, " is", " are") + " more than " +
                            whole_metres(highest_m) + " high: building " + std::to_string(high_.id) + ", " +
                            whole_metres(high_.height_m) + "," + advice(high_.elevation));
    if (low_.buildings > 0)
        sentences.push_back(who(low_.buildings, low_.id, " has", " have") +
                            " a negative volume, because it is lower than the ground on average: building " +
                            std::to_string(low_.id) + advice(low_.elevation));
    return sentences;
}

}  // namespace d2b::features
