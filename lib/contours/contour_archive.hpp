#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "contours/contour.hpp"
#include "contours/noise.hpp"
#include "core/context.hpp"
#include "core/statistics.hpp"
#include "dem2buildings/options.hpp"
#include "dem2buildings/spool.hpp"

namespace d2b::contours {

/// Contours kept in a spool. Only their heads and a few bytes per hole are in memory.
class StoredContours : public ContourList {
  public:
    struct Entry {
        ContourHead head;
        SpoolEntry place;
        std::size_t first_hole = 0;
        std::size_t holes = 0;
    };
    /// A dropped contour or a filled hole.
    struct Rejected {
        ContourKey key;  ///< key of the contour, or of the contour with the hole
        Reason reason = Reason::contour_short;
        SpoolEntry place;      ///< contour, or only the ring of the hole
        bool is_hole = false;  ///< a filled hole
    };
    struct Stored {
        Contour contour;
        RoofElevations roof;  ///< elevations of a building, level 1 only
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
    /// Sorted by key; empty unless requested.
    [[nodiscard]] std::span<const Rejected> rejected() const { return rejected_; }
    [[nodiscard]] LatticePolygon fetch(const Rejected& rejected) const;

  private:
    std::shared_ptr<const Spool> spool_;
    std::vector<Entry> entries_;
    std::vector<bool> filled_;  ///< per hole
    std::vector<Rejected> rejected_;
};

/// Selects the contours to keep and the information kept about them.
struct ArchiveSettings {
    NoiseRules noise;
    SquareArea square_area;
    ElevationRange range;
    FixedPoint fixed;
    bool keep_roots = true;      ///< if false, footprints are the lowest contours
    bool keep_rejected = false;  ///< keeps dropped contours and filled holes separately
    HeightRules heights = {};    ///< apply to buildings, which then have level 1
};

/// Contours in a spool in order of arrival. A special `parent` marks those on dropped contours.
struct ContourBatch {
    std::vector<StoredContours::Entry> entries;
    std::vector<Hole> holes;  ///< grouped by contour
    std::vector<StoredContours::Rejected> rejected;
};

/// Receives finished contours, drops noise and spools the rest.
class ContourWriter : public ContourSink {
  public:
    /// @param settings, spool may be shared with other threads @param batch, tally results are appended
    ContourWriter(const ArchiveSettings& settings, Spool& spool, ContourBatch& batch, Tally& tally)
        : settings_(settings), spool_(spool), batch_(batch), tally_(tally) {}

    std::int64_t take(FinishedContour&& finished) override;
    void reject(const StoredContours::Rejected& what);

  private:
    void spool_contour(const Contour& contour, const RoofElevations& roof);

    const ArchiveSettings& settings_;
    Spool& spool_;
    ContourBatch& batch_;
    Tally& tally_;
};

/// Collects the contours of a run, drops noise, and sorts them in finish(). Contours are spooled as soon as
/// they are traced, because all contours of a large raster do not fit into memory. Whether a hole is filled
/// and whether a contour lies on a dropped one is decided in finish(), because it depends on contours that
/// may be traced later.
class ContourArchive : public ContourSink {
  public:
    ContourArchive(ArchiveSettings settings, std::unique_ptr<Spool> spool, Context& context);

    std::int64_t take(FinishedContour&& finished) override {
        return batch_writer(all_, context_.report).take(std::move(finished));
    }
    /// Returns a sink that receives contours on another thread. @param batch, tally results are appended
    [[nodiscard]] ContourWriter batch_writer(ContourBatch& batch, Tally& tally) const {
        return {settings_, *spool_, batch, tally};
    }
    /// @param batch contours received by such a sink @return name of the first of them in this store
    std::int64_t add(ContourBatch&& batch);
    /// Drops contours on noise, sorts, numbers and fills holes. Call after the last contour; leaves the store
    /// empty.
    [[nodiscard]] std::unique_ptr<StoredContours> finish();

  private:
    void drop_children_of_noise();
    [[nodiscard]] std::vector<bool> fill();

    ArchiveSettings settings_;
    std::shared_ptr<Spool> spool_;
    Context& context_;
    ContourBatch all_;
};

/// Merges contours stored elsewhere into a new list: some contours of one list, or those of several.
class ContourMerger {
  public:
    explicit ContourMerger(std::unique_ptr<Spool> spool) : spool_(std::move(spool)) {}

    [[nodiscard]] std::size_t size() const { return entries_.size(); }
    /// @param head its parent is the index of a contour added earlier; its building is ignored
    /// @param stored with its remaining holes only @throws OutputError if the spool is full
    void add(const ContourHead& head, const StoredContours::Stored& stored);
    /// Returns the contours sorted by key, with renumbered parents and buildings, and leaves this empty.
    [[nodiscard]] std::unique_ptr<StoredContours> finish();

  private:
    std::shared_ptr<Spool> spool_;
    std::vector<StoredContours::Entry> entries_;
    std::size_t holes_ = 0;
};

/// Serializes rings, points and the roof of a building, but not the head, which the caller stores.
void save(const StoredContours::Stored& stored, std::int32_t level, ByteWriter& writer);
[[nodiscard]] StoredContours::Stored load_stored(std::int32_t level, ByteReader& reader);

}  // namespace d2b::contours
