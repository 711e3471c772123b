#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "dem2buildings/records.hpp"
#include "dem2buildings/spool.hpp"

namespace d2b {

/// Records of buildings with final outlines, kept in a spool.
class BuildingRecords {
  public:
    explicit BuildingRecords(std::unique_ptr<Spool> spool) : spool_(std::move(spool)) {}

    /// @param building index of the building, as in ContourHead
    void put(std::int64_t building, const BuildingRecord& record);
    /// Thread-safe once all are added. @return nullopt if the building has no outline
    [[nodiscard]] std::optional<BuildingRecord> of(std::int64_t building) const;

  private:
    std::unique_ptr<Spool> spool_;
    std::vector<SpoolEntry> places_;  ///< by building; empty for a building without outline
};

}  // namespace d2b
