#pragma once

#include <memory>
#include <vector>

#include "filter/contour_store.hpp"

namespace d2b {

/// Merges contours stored elsewhere into a new list: some contours of one list, or those of several.
class ContourShelf {
  public:
    explicit ContourShelf(std::unique_ptr<Spool> spool) : spool_(std::move(spool)) {}

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

}  // namespace d2b
