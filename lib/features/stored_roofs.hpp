#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "dem2buildings/records.hpp"
#include "dem2buildings/spool.hpp"
#include "roofs/make_roof.hpp"

namespace d2b::features {

/// Roofs of footprints, kept in a spool.
class StoredRoofs {
  public:
    /// @param contours number of contours
    /// @param level true if no face has a slope
    StoredRoofs(std::unique_ptr<Spool> spool, std::size_t contours, bool level)
        : spool_(std::move(spool)), places_(contours), records_(contours), level_(level) {}

    /// Thread-safe. @param contour of level 1, given once @throws OutputError if the spool is full
    void put(std::size_t contour, const roofs::Roof& roof, const RoofRecord& record);
    /// @return nullopt if the contour has no roof @throws OutputError if the spool cannot be read
    [[nodiscard]] std::optional<roofs::Roof> roof(std::size_t contour) const;
    [[nodiscard]] bool are_level() const { return level_; }
    [[nodiscard]] const RoofRecord& record(std::size_t contour) const { return records_[contour]; }

  private:
    std::unique_ptr<Spool> spool_;
    std::vector<SpoolEntry> places_;
    std::vector<RoofRecord> records_;
    bool level_;
};

}  // namespace d2b::features
