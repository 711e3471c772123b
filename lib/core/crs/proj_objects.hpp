#pragma once

#include <memory>
#include <string>

#include <proj.h>

#include "core/crs.hpp"

namespace d2b {

struct PjDelete {
    void operator()(PJ* pj) const { proj_destroy(pj); }
};
using PjPtr = std::unique_ptr<PJ, PjDelete>;

/// PROJ context that prints nothing and stays off the network. Every Crs, CoordinateTransform and Geodesy
/// owns one, so that objects made from one Crs may be used in different threads.
class ProjContext {
  public:
    ProjContext();
    // Not copyable, because PROJ keeps the address of reason_.
    ProjContext(const ProjContext&) = delete;
    ProjContext& operator=(const ProjContext&) = delete;
    ~ProjContext() = default;

    [[nodiscard]] PJ_CONTEXT* get() const { return context_.get(); }
    /// Returns PROJ's last error message, without the name of its function.
    [[nodiscard]] std::string reason() const;

  private:
    static void keep_reason(void* reason, int /*level*/, const char* message) noexcept;
    struct Delete {
        void operator()(PJ_CONTEXT* context) const { proj_context_destroy(context); }
    };
    std::string reason_;
    std::unique_ptr<PJ_CONTEXT, Delete> context_;
};

/// Unwraps a bound CRS, which is a CRS with a transformation to WGS 84 attached (TOWGS84, grids).
[[nodiscard]] PjPtr unbound(PJ_CONTEXT* context, PjPtr crs);

/// Returns the horizontal part of a compound CRS, otherwise the whole CRS.
[[nodiscard]] PjPtr horizontal_part(PJ_CONTEXT* context, const PJ* crs);

/// Returns PJ_CS_TYPE_UNKNOWN if the CRS has no axes.
[[nodiscard]] PJ_COORDINATE_SYSTEM_TYPE axes_type(PJ_CONTEXT* context, const PJ* crs);

/// @param crs not compound, not bound
[[nodiscard]] Crs::Kind kind_of(PJ_CONTEXT* context, const PJ* crs);

}  // namespace d2b
