#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "core/warnings.hpp"
#include "dem2buildings/dem_source.hpp"

namespace d2b {

/// Source that owns its warnings, so that its members can refer to them.
class WarningSource : public DemSource {
  public:
    [[nodiscard]] std::vector<std::string> take_warnings() final { return warnings_->take(); }

  protected:
    explicit WarningSource(std::unique_ptr<Warnings> warnings) : warnings_(std::move(warnings)) {}

    [[nodiscard]] Warnings& warnings() { return *warnings_; }

  private:
    std::unique_ptr<Warnings> warnings_;
};

}  // namespace d2b
