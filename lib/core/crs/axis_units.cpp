#include "core/crs/axis_units.hpp"

#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "core/crs/proj_objects.hpp"
#include "core/crs/text.hpp"

namespace d2b {

std::optional<AxisUnit> axis_unit(PJ_CONTEXT* context, const PJ* crs, int axis) {
    const PjPtr axes(proj_crs_get_coordinate_system(context, crs));
    const char* name = nullptr;
    double factor = 0;
    if (!axes || axis >= proj_cs_get_axis_count(context, axes.get()) ||
        !proj_cs_get_axis_info(context, axes.get(), axis, nullptr, nullptr, nullptr, &factor, &name, nullptr,
                               nullptr))
        return std::nullopt;
    return AxisUnit{name ? name : "", factor};
}

double to_degrees(double radians) {
    const double degrees = radians * 180 / std::numbers::pi;
    return std::abs(degrees - 1) < 1e-12 ? 1 : degrees;  // the degree is often given with few digits
}

/// Identifies common units by their size, because files spell them in many ways ("Meter", "Foot_US").
std::optional<LengthUnit> length_unit(const std::optional<AxisUnit>& unit) {
    static constexpr std::array<std::pair<const char*, double>, 3> common{
        {{"metre", 1.0}, {"foot", 0.3048}, {"US survey foot", 1200.0 / 3937.0}}};
    if (!unit || !(unit->factor > 0) || letters_and_digits(unit->name) == "unknown")
        return std::nullopt;
    for (const auto& [name, metres] : common)
        if (std::abs(unit->factor - metres) < 1e-9 * metres)
            return LengthUnit{name, unit->factor};
    return LengthUnit{unit->name, unit->factor};
}

std::optional<LengthUnit> vertical_unit_of(PJ_CONTEXT* context, const PJ* whole, const PJ* horizontal) {
    if (proj_get_type(whole) == PJ_TYPE_COMPOUND_CRS) {
        const PjPtr vertical = unbound(context, PjPtr(proj_crs_get_sub_crs(context, whole, 1)));
        if (vertical && axes_type(context, vertical.get()) == PJ_CS_TYPE_VERTICAL)
            return length_unit(axis_unit(context, vertical.get(), 0));
    }
    return length_unit(axis_unit(context, horizontal, 2));
}

}  // namespace d2b
