#pragma once

#include <memory>
#include <span>
#include <vector>

#include "core/context.hpp"
#include "core/point_stats.hpp"
#include "core/roof_elevations.hpp"
#include "dem2buildings/options.hpp"
#include "dem2buildings/spool.hpp"
#include "filter/noise.hpp"
#include "trace/contour_list.hpp"

namespace d2b {

/// Contours that wait in a spool for their turn; in memory there are their heads and some bytes for each
/// hole.
class StoredContours : public ContourList {
  public:
    struct Entry {
        ContourHead head;
        SpoolEntry place;
        std::size_t first_hole = 0;
        std::size_t holes = 0;
    };
    /// What was dropped, or a hole that was filled.
    struct Rejected {
        ContourKey key;  ///< of the contour, or of the one that has the hole
        Reason reason = Reason::contour_short;
        SpoolEntry place;      ///< of the contour, or of the hole's ring alone
        bool is_hole = false;  ///< that was filled
    };
    struct Stored {
        Contour contour;
        RoofElevations roof;  ///< of a building's points; in level 1 alone
    };

    StoredContours(std::shared_ptr<const Spool> spool, std::vector<Entry> entries, std::vector<bool> filled,
                   std::vector<Rejected> rejected)
        : spool_(std::move(spool)),
          entries_(std::move(entries)),
          filled_(std::move(filled)),
          rejected_(std::move(rejected)) {}

    [[nodiscard]] std::size_t size() const override { return entries_.size(); }
    [[nodiscard]] const ContourHead& head(std::size_t contour) const override {
        return entries_[contour].head;
    }
    [[nodiscard]] Contour fetch(std::size_t contour) const override { return fetch_stored(contour).contour; }
    [[nodiscard]] Stored fetch_stored(std::size_t contour) const;
    /// Sorted by key; empty where nobody wants it.
    [[nodiscard]] std::span<const Rejected> rejected() const { return rejected_; }
    [[nodiscard]] LatticePolygon fetch(const Rejected& rejected) const;

  private:
    std::shared_ptr<const Spool> spool_;
    std::vector<Entry> entries_;
    std::vector<bool> filled_;  ///< a hole
    std::vector<Rejected> rejected_;
};

/// What is kept of contours, and how.
struct StoreSettings {
    NoiseRules noise;
    SquareArea square_area;
    ElevationRange range;
    FixedPoint fixed;
    bool keep_roots = true;      ///< else footprints are the lowest contours
    bool keep_rejected = false;  ///< what is dropped or filled is kept apart
    HeightRules heights = {};    ///< of buildings, which level 1 is then
};

/// Contours in a spool, as they came; `parent` of those that stand on noise is that they do.
struct PiledContours {
    std::vector<StoredContours::Entry> entries;
    std::vector<Hole> holes;  ///< of one contour after the other
    std::vector<StoredContours::Rejected> rejected;
};

/// Takes contours as they are finished, drops noise, and puts the rest aside.
class ContourPile : public ContourSink {
  public:
    /// @param settings, spool other threads may have piles of the same @param piled, tally are added to
    ContourPile(const StoreSettings& settings, Spool& spool, PiledContours& piled, Tally& tally)
        : settings_(settings), spool_(spool), piled_(piled), tally_(tally) {}

    std::int64_t take(FinishedContour&& finished) override;
    void reject(const StoredContours::Rejected& what);

  private:
    void put_aside(const Contour& contour, const RoofElevations& roof);

    const StoreSettings& settings_;
    Spool& spool_;
    PiledContours& piled_;
    Tally& tally_;
};

/// The contours of a run, until the last has been taken.
class ContourStore : public ContourSink {
  public:
    ContourStore(StoreSettings settings, std::unique_ptr<Spool> spool, Context& context);

    std::int64_t take(FinishedContour&& finished) override {
        return pile(all_, context_.report).take(std::move(finished));
    }
    /// Takes some of the contours on another thread. @param piled, tally are added to
    [[nodiscard]] ContourPile pile(PiledContours& piled, Tally& tally) const {
        return {settings_, *spool_, piled, tally};
    }
    /// @param piled what such a pile has taken @return what the first of its contours is called here
    std::int64_t add(PiledContours&& piled);
    /// After the last contour: drops what stands on noise, sorts, numbers and fills holes. The store is empty
    /// afterwards.
    [[nodiscard]] std::unique_ptr<StoredContours> finish();

  private:
    void drop_what_stands_on_noise();
    void sort();
    void number_buildings();
    [[nodiscard]] std::vector<bool> fill();

    StoreSettings settings_;
    std::shared_ptr<Spool> spool_;
    Context& context_;
    PiledContours all_;
};

}  // namespace d2b
