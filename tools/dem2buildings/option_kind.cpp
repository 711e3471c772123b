#include <algorithm>
#include <array>

#include "dem2buildings/help.hpp"

namespace d2b {
namespace {

struct Kind {
    std::string_view values;  ///< as the synopsis has them
    std::string_view kind;
};

constexpr std::array kinds{Kind{"<raster>", "raster"},
                           Kind{"<polygons>", "vector"},
                           Kind{"<raster or polygons>", "dataset"},
                           Kind{"auto|none|<terrain model>", "terrain"},
                           Kind{"<crs>", "crs"},
                           Kind{"<xmin> <ymin> <xmax> <ymax>", "extent"},
                           Kind{"<file.tif>", "file:tif"},
                           Kind{"<file.png>", "file:png"}};

}  // namespace

std::vector<std::string> option_words(const OptionRow& row) {
    std::vector<std::string> words;
    if (row.arity != Arity::one || row.values.find('|') == std::string::npos)
        return words;
    for (std::size_t at = 0; at <= row.values.size();) {
        const std::size_t end = std::min(row.values.find('|', at), row.values.size());
        if (row.values[at] != '<')
            words.push_back(row.values.substr(at, end - at));
        at = end + 1;
    }
    return words;
}

std::string option_kind(const OptionRow& row) {
    if (row.arity == Arity::none)
        return "switch";
    for (const Kind& kind : kinds)
        if (row.values == kind.values)
            return std::string(kind.kind);
    if (row.arity == Arity::list || row.arity == Arity::several)
        return "numbers";
    if (row.numbers)
        return row.range.starts_with("a whole number") ? "whole" : "number";
    const bool free = row.values.find('<') != std::string::npos;
    return option_words(row).empty() || free ? "text" : "choice";
}

}  // namespace d2b
