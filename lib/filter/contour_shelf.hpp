#pragma once

#include <memory>
#include <vector>

#include "filter/contour_store.hpp"

namespace d2b {

/// Puts contours that were stored elsewhere side by side: some of one list, or those of several.
class ContourShelf {
  public:
    explicit ContourShelf(std::unique_ptr<Spool> spool) : spool_(std::move(spool)) {}

    [[nodiscard]] std::size_t size() const { return entries_.size(); }
    /// @param head whose parent is the place of one that was added before, and whose building does not count
    /// @param stored its holes are all there are @throws OutputError the spool has no room
    void add(const ContourHead& head, const StoredContours::Stored& stored);
    /// Sorted by key, with parents and buildings numbered anew. The shelf is empty afterwards.
    [[nodiscard]] std::unique_ptr<StoredContours> finish();

  private:
    std::shared_ptr<Spool> spool_;
    std::vector<StoredContours::Entry> entries_;
    std::size_t holes_ = 0;
};

/// Rings and points, and what is known of a building's roof. Its head is the caller's.
void save(const StoredContours::Stored& stored, std::int32_t level, ByteWriter& writer);
[[nodiscard]] StoredContours::Stored load_stored(std::int32_t level, ByteReader& reader);

}  // namespace d2b
