#pragma once

#include <cstdint>
#include <string>

#include "core/context.hpp"
#include "features/polygon_maker.hpp"

namespace d2b {

/// Warns of features left out because the output CRS tears them. Names the first few in one sentence.
class TornWarnings {
  public:
    /// @param kind "building" or "contour" @param made polygon, torn or not
    void note(const std::string& kind, std::int64_t id, const FeaturePolygon& made);
    /// @param target display name of the output CRS @throws InputError if nothing else was written
    void finish(const std::string& target, Context& context) const;

  private:
    std::string names_;
    std::int64_t count_ = 0;
};

}  // namespace d2b
