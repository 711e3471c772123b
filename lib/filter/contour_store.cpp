#include "filter/contour_store.hpp"

#include <algorithm>
#include <optional>
#include <utility>

namespace d2b {
namespace {

constexpr std::int64_t on_noise = -2;  // a parent that was dropped

}  // namespace

StoredContours::Stored StoredContours::fetch_stored(std::size_t contour) const {
    const Entry& entry = entries_[contour];
    ByteReader reader(*spool_, entry.place);
    Stored stored{load_contour(reader), {}};
    if (entry.head.key.level == 1)
        stored.roof = reader.take<RoofElevations>();
    stored.contour.key = entry.head.key;
    stored.contour.label = entry.head.label;
    stored.contour.parent = entry.head.parent;
    std::size_t hole = entry.first_hole;
    std::erase_if(stored.contour.interiors, [&](const PackedRing&) { return filled_[hole++]; });
    return stored;
}

LatticePolygon StoredContours::fetch(const Rejected& rejected) const {
    ByteReader reader(*spool_, rejected.place);
    LatticePolygon polygon;
    if (rejected.is_hole) {
        // Around what it bounds the other way.
        polygon.exterior = PackedRing::load(reader).corners();
        std::reverse(polygon.exterior.begin() + 1, polygon.exterior.end());
        return polygon;
    }
    const Contour contour = load_contour(reader);
    polygon.exterior = contour.exterior.corners();
    for (const PackedRing& ring : contour.interiors)
        polygon.interiors.push_back(ring.corners());
    return polygon;
}

ContourStore::ContourStore(Settings settings, std::unique_ptr<Spool> spool, Context& context)
    : settings_(std::move(settings)), spool_(std::move(spool)), context_(context) {}

std::int64_t ContourStore::take(FinishedContour&& finished) {
    const Contour& contour = finished.contour;
    if (contour.key.level == 0 && !settings_.keep_roots)
        return -1;
    const auto name = static_cast<std::int64_t>(entries_.size());
    auto reason = contour_noise(contour, settings_.noise, settings_.square_area);
    const RoofElevations roof = reason ? RoofElevations() : take_roof(finished.sample, settings_.range);
    if (!reason && contour.key.level == 1 && is_too_low(contour.label, roof, settings_.heights))
        reason = Reason::building_not_tall;
    for (const std::int64_t standing : finished.standing_on_it)
        entries_[static_cast<std::size_t>(standing)].head.parent = reason ? on_noise : name;
    if (reason) {
        SpoolEntry place;
        if (settings_.keep_rejected) {
            ByteWriter writer;
            save(contour, writer);
            place = append(*spool_, writer);
        }
        reject({contour.key, *reason, place});
        return -1;
    }
    put_aside(contour, roof);
    return name;
}

void ContourStore::put_aside(const Contour& contour, const RoofElevations& roof) {
    Entry& entry = entries_.emplace_back();
    entry.head.key = contour.key;
    entry.head.label = contour.label;
    if (contour.own.n > 0)
        entry.head.tier_z = settings_.fixed.mean(contour.own.sum, contour.own.n);
    entry.head.lowest_outside = contour.lowest_outside;
    ByteWriter writer;
    save(contour, writer);
    if (contour.key.level == 1)
        writer.put(roof);
    entry.place = append(*spool_, writer);
    entry.first_hole = holes_.size();
    entry.holes = contour.interiors.size();
    for (const PackedRing& ring : contour.interiors)
        holes_.push_back({contour.key.level, ring.start(), ring.box().low, ring.box().high,
                          hole_noise(ring, contour.key.level, settings_.noise, settings_.square_area)});
}

void ContourStore::reject(const StoredContours::Rejected& what) {
    context_.report.count(what.reason);
    if (settings_.keep_rejected)
        rejected_.push_back(what);
}

/// Contours come after those that stand on them.
void ContourStore::drop_what_stands_on_noise() {
    for (auto entry = entries_.rbegin(); entry != entries_.rend(); ++entry)
        if (entry->head.parent >= 0 &&
            entries_[static_cast<std::size_t>(entry->head.parent)].head.parent == on_noise)
            entry->head.parent = on_noise;
    std::size_t kept_holes = 0;
    for (Entry& entry : entries_) {
        const std::size_t begin = std::exchange(entry.first_hole, kept_holes);
        if (entry.head.parent == on_noise) {
            reject({entry.head.key, Reason::contour_on_dropped, entry.place});
            continue;
        }
        for (std::size_t h = begin; h < begin + entry.holes; ++h)
            holes_[kept_holes++] = holes_[h];
    }
    holes_.resize(kept_holes);
}

/// Brings contours into the order of their keys.
void ContourStore::sort() {
    // Until they have places, `building` says as which one a contour came.
    for (std::size_t i = 0; i < entries_.size(); ++i)
        entries_[i].head.building = static_cast<std::int64_t>(i);
    std::vector<std::uint32_t> place(entries_.size());
    std::erase_if(entries_, [](const Entry& entry) { return entry.head.parent == on_noise; });
    std::ranges::sort(entries_, {}, [](const Entry& entry) { return entry.head.key; });
    for (std::size_t i = 0; i < entries_.size(); ++i)
        place[static_cast<std::size_t>(entries_[i].head.building)] = static_cast<std::uint32_t>(i);
    for (Entry& entry : entries_)
        if (entry.head.parent >= 0)
            entry.head.parent = place[static_cast<std::size_t>(entry.head.parent)];
}

void ContourStore::number_buildings() {
    std::int64_t buildings = 0;
    for (Entry& entry : entries_) {
        ContourHead& head = entry.head;
        if (head.key.level == 0)
            head.building = -1;
        else if (head.key.level == 1)
            head.building = buildings++;
        else
            head.building = entries_[static_cast<std::size_t>(head.parent)].head.building;
    }
}

std::vector<bool> ContourStore::fill() {
    std::vector<ContourKey> keys;
    std::vector<std::uint32_t> owner(holes_.size());
    keys.reserve(entries_.size());
    for (const Entry& entry : entries_) {
        std::fill_n(owner.begin() + static_cast<std::ptrdiff_t>(entry.first_hole), entry.holes,
                    static_cast<std::uint32_t>(keys.size()));
        keys.push_back(entry.head.key);
    }
    // A contour is loaded once for all of its holes, which follow one another.
    std::optional<std::uint32_t> loaded;
    std::vector<PackedRing> rings;
    const auto ring = [&](std::size_t hole) -> const PackedRing& {
        const Entry& entry = entries_[owner[hole]];
        if (loaded != owner[hole]) {
            ByteReader reader(*spool_, entry.place);
            rings = load_contour(reader).interiors;
            loaded = owner[hole];
        }
        return rings[hole - entry.first_hole];
    };
    std::vector<bool> filled = fill_holes(
        keys, holes_, [&](std::size_t hole) { return ring(hole).corners(); }, context_);
    for (std::size_t h = 0; settings_.keep_rejected && h < filled.size(); ++h) {
        if (!filled[h])
            continue;
        context_.check_stop();
        // Apart from the contour, which would have to be loaded for each.
        ByteWriter writer;
        ring(h).save(writer);
        rejected_.push_back({entries_[owner[h]].head.key, *holes_[h].reason, append(*spool_, writer), true});
    }
    return filled;
}

std::unique_ptr<StoredContours> ContourStore::finish() {
    drop_what_stands_on_noise();
    sort();
    number_buildings();
    std::vector<bool> filled = fill();
    std::ranges::stable_sort(rejected_, {}, &StoredContours::Rejected::key);
    return std::make_unique<StoredContours>(std::move(spool_), std::exchange(entries_, {}), std::move(filled),
                                            std::exchange(rejected_, {}));
}

}  // namespace d2b
