#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/band.hpp"
#include "core/context.hpp"
#include "core/grid.hpp"
#include "core/undeclared_nodata.hpp"
#include "dem2buildings/dem_source.hpp"
#include "elevations/elevation_cache.hpp"
#include "elevations/filter_invalid.hpp"
#include "elevations/statistics.hpp"

namespace d2b {

/// Restricts a DEM to a part of its window. Notices remain with the DEM itself.
class SubwindowSource final : public DemSource {
  public:
    /// @param whole the DEM, which must outlive this object
    /// @param part part of its window
    SubwindowSource(DemSource& whole, const Window& part) : whole_(whole), info_(whole.info()) {
        info_.window = part;
    }
    [[nodiscard]] const DemInfo& info() const override { return info_; }
    void read(const Window& part, std::span<double> elevations) override { whole_.read(part, elevations); }

  private:
    DemSource& whole_;
    DemInfo info_;
};

/// Results of the first pass.
struct ElevationSurvey {
    ElevationStatistics statistics;  ///< statistics of valid cells
    SuspiciousValues suspicious;
    BorderCells border{};  ///< border of the window, if the survey covers all of it
};

/// Reads the bands of rows of a source several times. They are kept in memory after the first pass if they
/// fit, otherwise read again. Bands are aligned to the absolute grid, so that their borders do not depend on
/// the window. Reading runs ahead on all threads. The first pass (survey()) decides which cells are invalid;
/// these are NaN in all passes.
class ElevationReader {
  public:
    ElevationReader(DemSource& source, Context& context, const BandSize& size = {});

    [[nodiscard]] std::size_t bands() const { return shapes_.size(); }

    /// First pass. Without it every value is an elevation. A second call starts again.
    /// @param done called for each band, from the first row to the last, on this thread
    /// @param of cells covered by the survey; nullopt: all. Validity is decided for all other cells, too, if
    /// the window is empty
    [[nodiscard]] ElevationSurvey survey(const ValidityRules& rules,
                                         const std::function<void(const ElevationBand&)>& done,
                                         const std::optional<Window>& of = {});

    /// Calls use(band, prepare(band, tally)) for each band, from the first row to the last: `prepare` on any
    /// thread, `use` on the caller's.
    /// @throws InputError, and exceptions of both
    template <typename Prepare, typename Use>
    void for_each(const Prepare& prepare, const Use& use) {
        for_each_with_halo(
            0, [&](ElevationBand&&, const ElevationBand& band, Tally& tally) { return prepare(band, tally); },
            use);
    }
    /// Same, with a halo of rows above the band: prepare(above, band, tally). The band's thread reads them
    /// itself, so that it waits for no other.
    /// @param halo number of rows, at most 64; fewer at the start of the window
    template <typename Prepare, typename Use>
    void for_each_with_halo(std::int32_t halo, const Prepare& prepare, const Use& use) {
        pass([this](std::size_t i, Tally& tally) { return get(whole(shapes_[i]), buffers_.take(), tally); },
             [&](std::size_t i, const ElevationBand& band, Tally& tally) {
                 // Read after the band, because the thread that reads the band above has decoded these rows
                 // by now.
                 return prepare(get_above(i, halo, tally), band, tally);
             },
             use);
    }
    /// Calls `use` for each band, from the first row to the last, on this thread.
    void for_each(const std::function<void(const ElevationBand&)>& use);
    /// Calls `use` for batches of rows of a part of the window, on any thread and in any order. Columns are
    /// relative to the part.
    void for_part(const Window& part, const std::function<void(const ElevationBand&)>& use);

    /// Reads the valid elevations of a part of the window.
    void read_part(const Window& part, std::span<double> elevations);

    /// Lends the kept elevations if the part is the whole window and floats hold them exactly; otherwise
    /// returns an empty grid. Request nothing until they are returned unchanged.
    /// @pre the survey is done
    [[nodiscard]] MetreGrid lend(const Window& part);
    void take_back(MetreGrid&& lent) { cache_.take_back(std::move(lent)); }

  private:
    /// Merges the tallies even if an exception is thrown.
    struct Merger {
        const std::vector<Tally>& tallies;
        RunReport& report;
        ~Merger() {
            for (const Tally& tally : tallies)
                report.merge(tally);
        }
    };
    /// Implements for_each(): fetch(i, tally) returns the band, and prepare(i, band, tally) may change it
    /// before it is kept.
    template <typename Fetch, typename Prepare, typename Use>
    void pass(const Fetch& fetch, const Prepare& prepare, const Use& use) {
        using Prepared = std::decay_t<decltype(prepare(std::size_t{}, std::declval<ElevationBand&>(),
                                                       std::declval<Tally&>()))>;
        struct Made {
            ElevationBand band;
            std::vector<double> wide;
            Prepared prepared;
        };
        std::vector<Tally> tallies(static_cast<std::size_t>(context_.threads->threads()));
        const Merger merger{tallies, context_.report};
        const bool keeping = cache_.wanted();
        if (keeping)
            cache_.begin(bands(), *context_.threads);
        context_.threads->in_order(
            bands(),
            [&](std::size_t i, std::size_t thread) {
                // `prepare` may refer to the band's values, because moving it does not relocate them.
                ElevationBand band = fetch(i, tallies[thread]);
                Prepared prepared = prepare(i, band, tallies[thread]);
                std::vector<double> wide;
                if (keeping)
                    wide = cache_.keep(band);
                return Made{std::move(band), std::move(wide), std::move(prepared)};
            },
            [&](std::size_t i, Made made) {
                use(made.band, std::move(made.prepared));
                if (keeping)
                    cache_.put(i, made.band.shape, std::move(made.wide));
                buffers_.give(std::move(made.band.elevations));
            },
            ahead_);
        buffers_.clear();
        cache_.end();
    }
    /// Reads raw values from the source.
    /// @param buffer buffer for the elevations
    /// @throws InputError
    [[nodiscard]] ElevationBand read(const Window& part, std::vector<double>&& buffer);
    /// Returns the valid elevations.
    /// @param part part of the window
    /// @throws InputError
    [[nodiscard]] ElevationBand get(const Window& part, std::vector<double>&& buffer, Tally& tally);
    [[nodiscard]] ElevationBand get_above(std::size_t i, std::int32_t halo, Tally& tally);
    [[nodiscard]] Window whole(const BandShape& rows) const;
    /// Returns the first band that reaches this row.
    [[nodiscard]] std::size_t band_with(std::int32_t row) const;
    /// Decides about the spikes of the next band.
    /// @param spikes spikes of that band, compared with all their neighbours
    /// @param first_row first row of that band
    void decide_spikes(const std::vector<Spike>& spikes, std::int32_t first_row, const Window& counted,
                       ElevationSurvey& survey);
    void remove_spikes();

    DemSource& source_;
    Context& context_;
    std::int64_t points_a_band_;
    std::size_t ahead_ = 1;  ///< bands read ahead per thread
    std::vector<BandShape> shapes_;
    ElevationCache cache_;
    BufferPool buffers_;  ///< buffers of one pass
    ValidityRules rules_;
    std::optional<CellDecisions> decisions_;  ///< decisions about spikes
};

/// Returns the number of cells of the most frequent one of some values.
[[nodiscard]] std::int64_t most_cells_of(const std::vector<double>& values, ElevationReader& reader);

}  // namespace d2b
