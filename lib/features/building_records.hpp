#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "dem2buildings/records.hpp"
#include "dem2buildings/spool.hpp"

namespace d2b {

/// The records of buildings, as they are when their outlines are known. They wait in a spool.
class BuildingRecords {
  public:
    explicit BuildingRecords(std::unique_ptr<Spool> spool) : spool_(std::move(spool)) {}

    /// @param building its number from 0, as heads of contours have it
    void put(std::int64_t building, const BuildingRecord& record);
    /// From any thread, when all are there. @return nothing where it has no outline
    [[nodiscard]] std::optional<BuildingRecord> of(std::int64_t building) const;

  private:
    std::unique_ptr<Spool> spool_;
    std::vector<SpoolEntry> places_;  ///< by building; empty where there is none
};

}  // namespace d2b
