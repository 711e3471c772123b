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

/// Takes contours as they are finished, drops noise, and puts the rest aside.
class ContourStore : public ContourSink {
  public:
    struct Settings {
        NoiseRules noise;
        SquareArea square_area;
        ElevationRange range;
        FixedPoint fixed;
        bool keep_roots = true;      ///< else footprints are the lowest contours
        bool keep_rejected = false;  ///< what is dropped or filled is kept apart
        HeightRules heights = {};    ///< of buildings, which level 1 is then
    };
    ContourStore(Settings settings, std::unique_ptr<Spool> spool, Context& context);

    std::int64_t take(FinishedContour&& finished) override;
    /// After the last contour: drops what stands on noise, sorts, numbers and fills holes. The store is empty
    /// afterwards.
    [[nodiscard]] std::unique_ptr<StoredContours> finish();

  private:
    using Entry = StoredContours::Entry;
    void put_aside(const Contour& contour, const RoofElevations& roof);
    void reject(const StoredContours::Rejected& what);
    void drop_what_stands_on_noise();
    void sort();
    void number_buildings();
    [[nodiscard]] std::vector<bool> fill();

    Settings settings_;
    std::shared_ptr<Spool> spool_;
    Context& context_;
    std::vector<Entry> entries_;
    std::vector<Hole> holes_;  ///< of one contour after the other, as they came
    std::vector<StoredContours::Rejected> rejected_;
};

}  // namespace d2b
