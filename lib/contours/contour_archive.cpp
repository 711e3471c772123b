#include "contours/contour_archive.hpp"

#include <algorithm>
#include <optional>
#include <utility>

namespace d2b::contours {
namespace {

constexpr std::int64_t dropped_parent = -2;  // marks a dropped parent

/// Removes dropped contours, sorts the others by key, and numbers their parents and buildings.
/// @param entries their parents are indices of entries
void sort_by_key(std::vector<StoredContours::Entry>& entries) {
    // Until the contours are sorted, `building` holds their original index.
    for (std::size_t i = 0; i < entries.size(); ++i)
        entries[i].head.building = static_cast<std::int64_t>(i);
    std::vector<std::uint32_t> place(entries.size());
    std::erase_if(entries,
                  [](const StoredContours::Entry& entry) { return entry.head.parent == dropped_parent; });
    std::ranges::sort(entries, {}, [](const StoredContours::Entry& entry) { return entry.head.key; });
    for (std::size_t i = 0; i < entries.size(); ++i)
        place[static_cast<std::size_t>(entries[i].head.building)] = static_cast<std::uint32_t>(i);
    std::int64_t buildings = 0;
    // The parent of a contour has a lower level, so it comes first.
    for (StoredContours::Entry& entry : entries) {
        ContourHead& head = entry.head;
        if (head.parent >= 0)
            head.parent = place[static_cast<std::size_t>(head.parent)];
        head.building = head.key.level == 1 ? buildings++
                        : head.parent >= 0  ? entries[static_cast<std::size_t>(head.parent)].head.building
                                            : -1;
    }
}

}  // namespace

StoredContours::Stored StoredContours::fetch_stored(std::size_t contour) const {
    const Entry& entry = entries_[contour];
    ByteReader reader(*spool_, entry.place);
    Stored stored = load_stored(entry.head.key.level, reader);
    stored.contour.key = entry.head.key;
    stored.contour.label = entry.head.label;
    stored.contour.parent = entry.head.parent;
    std::size_t hole = entry.first_hole;
    std::erase_if(stored.contour.interiors, [&](const PackedRing&) { return filled_[hole++]; });
    return stored;
}

LatticePolygon StoredContours::fetch(const Rejected& rejected) const {
    ByteReader reader(*spool_, rejected.place);
    if (!rejected.is_hole)
        return traced_polygon(load_contour(reader));
    // Rotate the hole's ring to the orientation of an exterior.
    LatticePolygon polygon{PackedRing::load(reader).corners(), {}};
    std::reverse(polygon.exterior.begin() + 1, polygon.exterior.end());
    return polygon;
}

std::int64_t ContourWriter::take(FinishedContour&& finished) {
    const Contour& contour = finished.contour;
    if (contour.key.level == 0 && !settings_.keep_roots)
        return -1;
    const auto name = static_cast<std::int64_t>(batch_.entries.size());
    auto reason = contour_noise(contour, settings_.noise, settings_.square_area);
    const RoofElevations roof = reason ? RoofElevations() : summarize_roof(finished.sample, settings_.range);
    if (!reason && contour.key.level == 1 && is_too_low(contour.label, roof, settings_.heights))
        reason = Reason::building_not_tall;
    for (const std::int64_t child : finished.children)
        batch_.entries[static_cast<std::size_t>(child)].head.parent = reason ? dropped_parent : name;
    if (reason) {
        SpoolEntry place;
        if (settings_.keep_rejected) {
            ByteWriter writer;
            save(contour, writer);
            place = append(spool_, writer);
        }
        reject({contour.key, *reason, place});
        return -1;
    }
    spool_contour(contour, roof);
    return name;
}

void ContourWriter::spool_contour(const Contour& contour, const RoofElevations& roof) {
    StoredContours::Entry& entry = batch_.entries.emplace_back();
    entry.head.key = contour.key;
    entry.head.label = contour.label;
    if (contour.own.n > 0)
        entry.head.tier_z = settings_.fixed.mean(contour.own.sum, contour.own.n);
    entry.head.lowest_outside = contour.lowest_outside;
    ByteWriter writer;
    save(contour, writer);
    if (contour.key.level == 1)
        writer.put(roof);
    entry.place = append(spool_, writer);
    entry.first_hole = batch_.holes.size();
    entry.holes = contour.interiors.size();
    for (const PackedRing& ring : contour.interiors)
        batch_.holes.push_back({contour.key.level, ring.start(), ring.box().low, ring.box().high,
                                hole_noise(ring, contour.key.level, settings_.noise, settings_.square_area)});
}

void ContourWriter::reject(const StoredContours::Rejected& what) {
    tally_.count(what.reason);
    if (settings_.keep_rejected)
        batch_.rejected.push_back(what);
}

ContourArchive::ContourArchive(ArchiveSettings settings, std::unique_ptr<Spool> spool, Context& context)
    : settings_(std::move(settings)), spool_(std::move(spool)), context_(context) {}

/// Appends piled contours; the names of their sinks are their indices.
std::int64_t ContourArchive::add(ContourBatch&& batch) {
    const auto first = static_cast<std::int64_t>(all_.entries.size());
    for (StoredContours::Entry& entry : batch.entries) {
        if (entry.head.parent >= 0)
            entry.head.parent += first;
        entry.first_hole += all_.holes.size();
    }
    all_.entries.insert(all_.entries.end(), batch.entries.begin(), batch.entries.end());
    all_.holes.insert(all_.holes.end(), batch.holes.begin(), batch.holes.end());
    all_.rejected.insert(all_.rejected.end(), batch.rejected.begin(), batch.rejected.end());
    return first;
}

/// Drops contours with a dropped parent. Children come before their parents.
void ContourArchive::drop_children_of_noise() {
    for (auto entry = all_.entries.rbegin(); entry != all_.entries.rend(); ++entry)
        if (entry->head.parent >= 0 &&
            all_.entries[static_cast<std::size_t>(entry->head.parent)].head.parent == dropped_parent)
            entry->head.parent = dropped_parent;
    std::size_t kept_holes = 0;
    for (StoredContours::Entry& entry : all_.entries) {
        const std::size_t begin = std::exchange(entry.first_hole, kept_holes);
        if (entry.head.parent == dropped_parent) {
            batch_writer(all_, context_.report)
                .reject({entry.head.key, Reason::contour_on_dropped, entry.place});
            continue;
        }
        for (std::size_t h = begin; h < begin + entry.holes; ++h)
            all_.holes[kept_holes++] = all_.holes[h];
    }
    all_.holes.resize(kept_holes);
}

std::vector<bool> ContourArchive::fill() {
    std::vector<ContourKey> keys;
    std::vector<std::uint32_t> owner(all_.holes.size());
    keys.reserve(all_.entries.size());
    for (const StoredContours::Entry& entry : all_.entries) {
        std::fill_n(owner.begin() + static_cast<std::ptrdiff_t>(entry.first_hole), entry.holes,
                    static_cast<std::uint32_t>(keys.size()));
        keys.push_back(entry.head.key);
    }
    // Load each contour once for all of its holes, which are consecutive.
    std::optional<std::uint32_t> loaded;
    std::vector<PackedRing> rings;
    const auto ring = [&](std::size_t hole) -> const PackedRing& {
        const StoredContours::Entry& entry = all_.entries[owner[hole]];
        if (loaded != owner[hole]) {
            ByteReader reader(*spool_, entry.place);
            rings = load_contour(reader).interiors;
            loaded = owner[hole];
        }
        return rings[hole - entry.first_hole];
    };
    std::vector<bool> filled = fill_holes(
        keys, all_.holes, [&](std::size_t hole) { return ring(hole).corners(); }, context_);
    for (std::size_t h = 0; settings_.keep_rejected && h < filled.size(); ++h) {
        if (!filled[h])
            continue;
        context_.check_stop();
        // Store the ring separately, because the contour would have to be loaded for each of its holes.
        ByteWriter writer;
        ring(h).save(writer);
        all_.rejected.push_back(
            {all_.entries[owner[h]].head.key, *all_.holes[h].reason, append(*spool_, writer), true});
    }
    return filled;
}

std::unique_ptr<StoredContours> ContourArchive::finish() {
    drop_children_of_noise();
    sort_by_key(all_.entries);
    std::vector<bool> filled = fill();
    std::ranges::stable_sort(all_.rejected, {}, &StoredContours::Rejected::key);
    return std::make_unique<StoredContours>(std::move(spool_), std::exchange(all_.entries, {}),
                                            std::move(filled), std::exchange(all_.rejected, {}));
}

void save(const StoredContours::Stored& stored, std::int32_t level, ByteWriter& writer) {
    save(stored.contour, writer);
    if (level == 1)
        writer.put(stored.roof);
}

StoredContours::Stored load_stored(std::int32_t level, ByteReader& reader) {
    StoredContours::Stored stored{load_contour(reader), {}};
    if (level == 1)
        stored.roof = reader.take<RoofElevations>();
    return stored;
}

void ContourMerger::add(const ContourHead& head, const StoredContours::Stored& stored) {
    ByteWriter writer;
    save(stored, head.key.level, writer);
    const std::size_t holes = stored.contour.interiors.size();
    entries_.push_back({head, append(*spool_, writer), holes_, holes});
    holes_ += holes;
}

std::unique_ptr<StoredContours> ContourMerger::finish() {
    sort_by_key(entries_);
    return std::make_unique<StoredContours>(std::move(spool_), std::exchange(entries_, {}),
                                            std::vector<bool>(std::exchange(holes_, 0)),
                                            std::vector<StoredContours::Rejected>());
}

}  // namespace d2b::contours
