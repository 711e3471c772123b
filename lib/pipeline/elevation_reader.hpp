#pragma once

#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "core/band.hpp"
#include "core/context.hpp"
#include "core/dem_source.hpp"

namespace d2b {

/// Bands of rows of a source, more than once: kept after the first pass where they fit in memory, else read
/// again. Bands lie on the absolute grid: their borders do not depend on the window. They are read ahead, on
/// all threads.
class ElevationReader {
  public:
    /// @param keep_bytes most that is kept
    ElevationReader(DemSource& source, Context& context, std::size_t keep_bytes = std::size_t{512} << 20);

    [[nodiscard]] std::size_t bands() const { return shapes_.size(); }

    /// Calls use(band, prepare(i, band, tally)) for each band, the i-th of bands(), from the first row to the
    /// last: `prepare` on any thread, `use` on the caller's. @throws InputError, and what these throw
    template <typename Prepare, typename Use>
    void for_each(const Prepare& prepare, const Use& use) {
        std::vector<Tally> tallies(static_cast<std::size_t>(context_.threads->threads()));
        using Prepared = decltype(prepare(std::size_t{}, std::declval<const ElevationBand&>(), tallies[0]));
        struct Made {
            std::optional<ElevationBand> read;  ///< unless it was kept
            Prepared prepared;
        };
        const Merger merger{tallies, context_.report};
        context_.threads->in_order(
            bands(),
            [&](std::size_t i, std::size_t thread) {
                std::optional<ElevationBand> band;
                if (!complete_)
                    band = read(i, tallies[thread]);
                Prepared prepared = prepare(i, band ? *band : kept_[i], tallies[thread]);
                return Made{std::move(band), std::move(prepared)};
            },
            [&](std::size_t i, Made made) {
                use(made.read ? *made.read : kept_[i], std::move(made.prepared));
                if (keep_ && !complete_)
                    kept_[i] = std::move(*made.read);
            },
            ahead_);
        complete_ = keep_;
    }
    /// Calls `use` for each band, from the first row to the last, on this thread.
    void for_each(const std::function<void(const ElevationBand&)>& use);

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
    [[nodiscard]] ElevationBand read(std::size_t i, Tally& tally);

    DemSource& source_;
    Context& context_;
    bool keep_;
    bool complete_ = false;  ///< all bands are kept
    std::size_t ahead_ = 1;  ///< bands a thread that are read ahead
    std::vector<BandShape> shapes_;
    std::vector<ElevationBand> kept_;
};

}  // namespace d2b
