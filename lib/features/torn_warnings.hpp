#pragma once

#include <cstdint>
#include <string>

#include "core/context.hpp"
#include "features/polygon_maker.hpp"

namespace d2b {

/// Warns of features that are left out because the CRS of the output tears them apart: of the first few by
/// their ids, in one sentence.
class TornWarnings {
  public:
    /// @param kind "building" or "contour" @param made whether or not it is torn
    void note(const std::string& kind, std::int64_t id, const FeaturePolygon& made);
    /// @param target spoken name of the CRS of the output @throws InputError where nothing else was written
    void finish(const std::string& target, Context& context) const;

  private:
    std::string names_;
    std::int64_t count_ = 0;
};

}  // namespace d2b
