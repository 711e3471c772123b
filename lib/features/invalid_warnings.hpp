#pragma once

#include <cstdint>
#include <string>

#include "core/context.hpp"
#include "features/polygon_maker.hpp"

namespace d2b {

/// Warns of features that were not written as drawn because GEOS rejected them. The first few are named with
/// GEOS's reason, all others are only counted.
class InvalidWarnings {
  public:
    explicit InvalidWarnings(Context& context) : context_(context) {}

    /// @param kind "Building" or "Contour" @param made polygon, valid or not
    void note(const std::string& kind, std::int64_t id, const FeaturePolygon& made);
    void finish();

  private:
    Context& context_;
    std::int64_t count_ = 0;
};

}  // namespace d2b
