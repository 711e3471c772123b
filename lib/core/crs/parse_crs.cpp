#include "core/crs/parse_crs.hpp"

#include <algorithm>
#include <cctype>
#include <string>

#include "core/crs.hpp"
#include "core/crs/text.hpp"

namespace d2b {
namespace {

bool is_proj_string(std::string_view text) {
    return text.find_first_of("[{") == std::string_view::npos &&
           (text.find("proj=") != std::string_view::npos || text.find("init=") != std::string_view::npos);
}

/// Returns true if PROJ would search for the text as a part of a name: it takes "foo" for Amersfoort.
bool may_be_a_name(std::string_view text) {
    return text.find_first_of("[{:=") == std::string_view::npos;
}

OptionError unusable(std::string_view text, const std::string& why) {
    return OptionError(
        quoted(text) + " is not " + why +
        "; give a code such as EPSG:25832 or EPSG:25832+7837, WKT, PROJJSON or a PROJ string.");
}

}  // namespace

std::string code_meant_by(std::string_view text) {
    constexpr std::string_view authority = "epsg";
    if (letters_and_digits(text.substr(0, authority.size())) == authority) {
        text.remove_prefix(authority.size());
        text.remove_prefix(std::min(text.find_first_not_of(" -_/"), text.size()));
    }
    const bool digits =
        std::ranges::all_of(text, [](unsigned char c) { return std::isdigit(c) != 0 || c == '+'; });
    if (text.empty() || !digits || text.find_first_of("123456789") != 0)
        return "";
    return "EPSG:" + std::string(text);
}

OptionError unreadable(std::string_view text, const ProjContext& context) {
    return unusable(text, "a coordinate reference system (PROJ: " + context.reason() + ")");
}

PjPtr parse_crs(const ProjContext& context, std::string_view text) {
    if (const std::string code = code_meant_by(text); !code.empty())
        throw OptionError(quoted(text) + " is not a coordinate reference system; write " + code +
                          " if that is meant.");
    std::string definition(text);
    if (is_proj_string(text) && text.find("type=crs") == std::string_view::npos)
        definition += " +type=crs";
    PjPtr crs(proj_create(context.get(), definition.c_str()));
    if (!crs)
        throw unreadable(text, context);
    const std::string name = proj_get_name(crs.get());
    if (!proj_is_crs(crs.get()))
        throw unusable(text, "a coordinate reference system but " + quoted(name));
    if (may_be_a_name(text) && letters_and_digits(text) != letters_and_digits(name))
        throw unusable(text,
                       "the name of a coordinate reference system (the nearest is " + quoted(name) + ")");
    return crs;
}

}  // namespace d2b
