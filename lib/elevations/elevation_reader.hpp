#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/band.hpp"
#include "core/context.hpp"
#include "core/grid.hpp"
#include "core/undeclared_values.hpp"
#include "dem2buildings/dem_source.hpp"
#include "elevations/band_buffers.hpp"
#include "elevations/band_cells.hpp"
#include "elevations/kept_elevations.hpp"
#include "elevations/sift.hpp"
#include "elevations/statistics.hpp"

namespace d2b {

/// What the first pass has seen.
struct ElevationSurvey {
    ElevationStatistics statistics;  ///< of what is valid
    StrangeValues strange;
    BorderCells border{};  ///< of the window, where the survey is of all of it
};

/// Bands of rows of a source, more than once: kept after the first pass where they fit in memory, else read
/// again. Bands lie on the absolute grid: their borders do not depend on the window. They are read ahead, on
/// all threads. What is no elevation is decided in the first pass, and is NaN in all of them.
class ElevationReader {
  public:
    ElevationReader(DemSource& source, Context& context, const BandSize& size = {});

    [[nodiscard]] std::size_t bands() const { return shapes_.size(); }

    /// The first pass, without which every value is an elevation. Once more it is as if it were the first.
    /// @param done called for each band, from the first row to the last, on this thread
    /// @param of cells that the survey is of; nothing: all. Of others it is decided what they are: all of
    /// them, where the window is empty
    [[nodiscard]] ElevationSurvey survey(const SiftRules& rules,
                                         const std::function<void(const ElevationBand&)>& done,
                                         const std::optional<Window>& of = {});

    /// In place of the first pass, where no cell is judged by those around it. @pre rules without spikes
    void apply(const SiftRules& rules) { rules_ = rules; }

    /// Calls use(band, prepare(band, tally)) for each band, from the first row to the last: `prepare` on any
    /// thread, `use` on the caller's. @throws InputError, and what these throw
    template <typename Prepare, typename Use>
    void for_each(const Prepare& prepare, const Use& use) {
        for_each_below(
            0, [&](ElevationBand&&, const ElevationBand& band, Tally& tally) { return prepare(band, tally); },
            use);
    }
    /// The same with a halo, prepare(above, band, tally): the rows above the band, which its thread gets
    /// itself and waits for no other. @param halo so many rows, at most 64; fewer where the window begins
    template <typename Prepare, typename Use>
    void for_each_below(std::int32_t halo, const Prepare& prepare, const Use& use) {
        pass([this](std::size_t i, Tally& tally) { return get(whole(shapes_[i]), buffers_.take(), tally); },
             [&](std::size_t i, const ElevationBand& band, Tally& tally) {
                 // After the band: whoever reads the one above has decoded these rows by now.
                 return prepare(get_above(i, halo, tally), band, tally);
             },
             use);
    }
    /// Calls `use` for each band, from the first row to the last, on this thread.
    void for_each(const std::function<void(const ElevationBand&)>& use);
    /// Calls `use` for some rows of a part of the window at a time, on any thread and in any order. Columns
    /// count from the part's first.
    void for_part(const Window& part, const std::function<void(const ElevationBand&)>& use);

    /// What is kept of a part of the window, where that is all of it and floats hold it; else nothing. Until
    /// it is given back as it was, nothing may be asked for. @pre the survey is done
    [[nodiscard]] MetreGrid lend(const Window& part);
    void take_back(MetreGrid&& lent) { kept_.take_back(std::move(lent)); }

  private:
    /// Also where something is thrown.
    struct Merger {
        const std::vector<Tally>& tallies;
        RunReport& report;
        ~Merger() {
            for (const Tally& tally : tallies)
                report.merge(tally);
        }
    };
    /// As for_each(), where fetch(i, tally) gives the band, and prepare(i, band, tally) may change it before
    /// it is kept.
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
        const bool keeping = kept_.wanted();
        if (keeping)
            kept_.begin(bands(), *context_.threads);
        context_.threads->in_order(
            bands(),
            [&](std::size_t i, std::size_t thread) {
                // `prepare` may refer to the band's values, which stay where they are when it is moved.
                ElevationBand band = fetch(i, tallies[thread]);
                Prepared prepared = prepare(i, band, tallies[thread]);
                std::vector<double> wide;
                if (keeping)
                    wide = kept_.keep(band);
                return Made{std::move(band), std::move(wide), std::move(prepared)};
            },
            [&](std::size_t i, Made made) {
                use(made.band, std::move(made.prepared));
                if (keeping)
                    kept_.put(i, made.band.shape, std::move(made.wide));
                buffers_.give(std::move(made.band.elevations));
            },
            ahead_);
        buffers_.clear();
        kept_.end();
    }
    /// What is in the source. @param buffer for the elevations @throws InputError
    [[nodiscard]] ElevationBand read(const Window& part, std::vector<double>&& buffer);
    /// What of it is valid. @param part of the window @throws InputError
    [[nodiscard]] ElevationBand get(const Window& part, std::vector<double>&& buffer, Tally& tally);
    [[nodiscard]] ElevationBand get_above(std::size_t i, std::int32_t halo, Tally& tally);
    [[nodiscard]] Window whole(const BandShape& rows) const;
    /// The first band that has rows from this one on.
    [[nodiscard]] std::size_t band_with(std::int32_t row) const;
    /// @param spikes of the next band, all of whose neighbours have been seen @param first_row of that band
    void settle(const std::vector<Spike>& spikes, std::int32_t first_row, const Window& counted,
                ElevationSurvey& survey);
    void take_spikes_out();
    void add_border(const ElevationBand& band, BorderCells& border) const;

    DemSource& source_;
    Context& context_;
    std::int64_t points_a_band_;
    std::size_t ahead_ = 1;  ///< bands a thread that are read ahead
    std::vector<BandShape> shapes_;
    KeptElevations kept_;
    BandBuffers buffers_;  ///< of one pass
    SiftRules rules_;
    std::optional<BandCells> decided_;  ///< spikes of the bands
};

}  // namespace d2b
