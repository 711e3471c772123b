#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include <proj.h>

#include "core/crs.hpp"
#include "dem2buildings/error.hpp"
#include "dem2buildings/sinks.hpp"

namespace d2b {

/// Quotes text for messages, without line breaks and truncated, because WKT can be long.
[[nodiscard]] std::string in_quotes(std::string_view text);

/// Formats a position for messages, independent of the locale: "(9, 48.5)".
[[nodiscard]] std::string position_text(const Position& p);

/// Keeps letters and digits, in lower case, for comparing names.
[[nodiscard]] std::string lower_alphanumerics(std::string_view text);

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

struct AxisUnit {
    std::string name;
    double factor = 0;  ///< metres or radians in one unit
};

/// Empty if the CRS has no such axis.
[[nodiscard]] std::optional<AxisUnit> axis_unit(PJ_CONTEXT* context, const PJ* crs, int axis);

[[nodiscard]] double to_degrees(double radians);

/// Empty if the unit is unknown.
[[nodiscard]] std::optional<LengthUnit> length_unit(const std::optional<AxisUnit>& unit);

/// @param whole the CRS as given @param horizontal its horizontal part, not bound
[[nodiscard]] std::optional<LengthUnit> vertical_unit_of(PJ_CONTEXT* context, const PJ* whole,
                                                         const PJ* horizontal);

/// Returns PROJ's best operation, with axes in GIS order; null if there is none that can be instantiated.
/// @param area may be null; PROJ then uses the CRSs' areas of use
[[nodiscard]] PjPtr operation_between(PJ_CONTEXT* context, const PJ* from, const PJ* to, PJ_AREA* area);

/// Transforms in place; positions that cannot be transformed become infinite or NaN.
void transform_in_place(PJ* operation, std::span<Position> positions);

/// @throws OptionError with PROJ's reason if the text is not a CRS
[[nodiscard]] PjPtr parse_crs(const ProjContext& context, std::string_view text);

/// Returns the error for a text that PROJ has just rejected.
[[nodiscard]] OptionError unreadable(std::string_view text, const ProjContext& context);

}  // namespace d2b
