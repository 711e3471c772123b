#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "core/band.hpp"
#include "core/byte_stream.hpp"
#include "core/context.hpp"
#include "core/undeclared_nodata.hpp"
#include "dem2buildings/dem_source.hpp"
#include "dem2buildings/options.hpp"

namespace d2b {

/// Heights above the highest of its eight neighbours from which a cell is not an elevation, or not a roof. In
/// vertical units.
struct SpikeRules {
    double invalid_above = std::numeric_limits<double>::infinity();
    double not_roof_above = std::numeric_limits<double>::infinity();
};
/// Rules in m. No wall is one cell wide and 100 m high; masts, cranes and birds may reach 30 m.
inline constexpr SpikeRules spikes_m{100, 30};

/// Run of adjacent cells in a row.
struct ColumnRun {
    std::int32_t row = 0;    ///< row of the band
    std::int32_t begin = 0;  ///< first column
    std::int32_t end = 0;
};

/// Cell that exceeds its neighbours read so far.
struct Spike {
    std::int32_t row = 0;  ///< row of the band
    std::int32_t col = 0;
    double elevation = 0;
    double around =
        -std::numeric_limits<double>::infinity();  ///< its highest neighbour; -infinity: none is valid

    /// Compares with the row above or below.
    void see(std::span<const double> other);
    [[nodiscard]] bool above(double by) const { return elevation - around > by; }
    [[nodiscard]] bool stands_alone() const { return around == -std::numeric_limits<double>::infinity(); }
};

/// Finds the cells that are too high for a roof compared to the band. Spikes in the first and last row are
/// provisional until the adjacent rows are read. In scan order.
/// @param steep stretches to search; cells elsewhere are not spikes
[[nodiscard]] std::vector<Spike> find_spikes(const ElevationBand& band, std::span<const ColumnRun> steep,
                                             const SpikeRules& rules);

/// Compares spikes with the rows beyond their band while bands pass from the first to the last.
class SpikeSeams {
  public:
    /// @param spikes spikes of the band, which is the next one
    /// @return spikes of the previous band, compared with all their neighbours
    [[nodiscard]] std::vector<Spike> add(const ElevationBand& band, std::vector<Spike> spikes);
    /// @return spikes of the last band
    [[nodiscard]] std::vector<Spike> finish() { return std::move(waiting_); }

  private:
    std::vector<Spike> waiting_;
    std::int32_t last_ = 0;         ///< last row of their band
    std::vector<double> last_row_;  ///< its elevations
};

/// Rules for values that are not elevations, in the vertical unit of the raster.
struct ValidityRules {
    ElevationLimits limits;
    SpikeRules spikes;
    double metres = 1;                        ///< metres per vertical unit
    std::optional<double> overridden_nodata;  ///< see DemInfo
    std::vector<double> undeclared{};         ///< undeclared NoData values, see UndeclaredNodata
};

/// Statistics of cells that may not be elevations. A mergeable reduction.
struct SuspiciousValues {
    explicit SuspiciousValues(const ValidityRules& rules) : bins(rules.limits, rules.metres) {}
    void merge(const SuspiciousValues& other);
    void save(ByteWriter& writer) const;
    /// Restores statistics saved under the same rules.
    void load(ByteReader& reader);

    ValueCounts outside;                 ///< values outside of the limits
    ValueCounts undeclared;              ///< NoData values that are not declared
    std::int64_t blended = 0;            ///< cells with `blended_value`
    ValueCounts spikes;                  ///< spikes that are not elevations
    std::int64_t spires = 0;             ///< spikes that are elevations, but not roofs
    std::int64_t overridden_nodata = 0;  ///< cells with that elevation
    ValueBins bins;                      ///< all values within the limits, including spikes
};

/// Sets elevations outside of the limits and undeclared NoData values to NaN.
void apply_limits(std::span<double> elevations, const ValidityRules& rules);

/// Same, and collects statistics of a part, at little more than the cost of reading each elevation.
/// @param of rows and columns of the band that are counted
/// @return stretches of the band that may contain spikes; there are none elsewhere
[[nodiscard]] std::vector<ColumnRun> filter_invalid(ElevationBand& band, const ValidityRules& rules,
                                                    SuspiciousValues& seen, const Window& of);

/// Returns -zrange, or the range of elevations on land.
/// @param metres metres per vertical unit, which is the unit of the limits
[[nodiscard]] ElevationLimits elevation_limits(const ReadOptions& options, double metres);

/// Returns the rules for valid elevations.
/// @param with_spikes true: single cells above all their neighbours may be invalid
[[nodiscard]] ValidityRules validity_rules(const ReadOptions& options, bool with_spikes, const DemInfo& info,
                                           double metres);

/// Results of a first pass, which spare others.
struct FirstPass {
    const BorderCells& border;  ///< of the window, within the limits
    bool all_valid;             ///< every value is an elevation, as far as is known
    AnyCommon any_common;
    ReadValues read;  ///< reads kept values; empty if some of them were changed
};

/// Finds the undeclared NoData values of a whole window, and the margin that was blended with NoData; none
/// with -inodata.
/// @param known null: the window has not been read yet
/// @param cell_m cell size in m; 0 if unknown
/// @throws InputError, Cancelled
[[nodiscard]] UndeclaredNodata undeclared_values(DemSource& source, const Options& options,
                                                 const ValidityRules& rules, double cell_m,
                                                 const FirstPass* known, const Context& context);

}  // namespace d2b
