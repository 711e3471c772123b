#include "options/gdal_contour_options.hpp"

#include <algorithm>

namespace d2b {
namespace {

constexpr std::string_view elevations = "elevations are always in the fields threshold, base and top";
constexpr std::array gdal_contour_rows{
    GdalContourOption{"b", "-b <band>", OptionSupport::same, ""},
    GdalContourOption{"a", "-a <field>", OptionSupport::refused, elevations},
    GdalContourOption{"amin", "-amin <field>", OptionSupport::refused,
                      "the lowest elevation is always in the field elev_min"},
    GdalContourOption{"amax", "-amax <field>", OptionSupport::refused,
                      "the highest elevation is always in the field elev_max"},
    GdalContourOption{"3d", "-3d", OptionSupport::same, ""},
    GdalContourOption{"inodata", "-inodata", OptionSupport::same, ""},
    GdalContourOption{"snodata", "-snodata <value>", OptionSupport::same, ""},
    GdalContourOption{"f", "-f <format>", OptionSupport::same, ""},
    GdalContourOption{"of", "-of <format>", OptionSupport::same, ""},
    GdalContourOption{"i", "-i <interval>", OptionSupport::same, ""},
    GdalContourOption{"off", "-off <offset>", OptionSupport::same, ""},
    GdalContourOption{"fl", "-fl <level> [<level>...]", OptionSupport::same, ""},
    GdalContourOption{"e", "-e <base>", OptionSupport::refused, "-fl takes a list of levels"},
    GdalContourOption{"nln", "-nln <name>", OptionSupport::same, ""},
    GdalContourOption{"q", "-q, --quiet", OptionSupport::same, ""},
    GdalContourOption{"p", "-p", OptionSupport::ignored, "polygons are always written"},
    GdalContourOption{"dsco", "-dsco <NAME>=<VALUE>", OptionSupport::same, ""},
    GdalContourOption{"lco", "-lco <NAME>=<VALUE>", OptionSupport::same, ""},
    GdalContourOption{"oo", "-oo <NAME>=<VALUE>", OptionSupport::same, ""},
    GdalContourOption{"gt", "-gt <n>|unlimited", OptionSupport::refused,
                      "the result is written as a whole or not at all"},
};

}  // namespace

std::span<const GdalContourOption> gdal_contour_options() {
    return gdal_contour_rows;
}

std::string gdal_contour_refusal(std::string_view name) {
    const auto option = std::ranges::find(gdal_contour_rows, name, &GdalContourOption::name);
    if (option == gdal_contour_rows.end() || option->fate != OptionSupport::refused)
        return "";
    return "-" + std::string(name) + " of gdal_contour has no use here: " + std::string(option->note) + ".";
}

}  // namespace d2b
