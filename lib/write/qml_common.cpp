#include "core/height_classes.hpp"
#include "core/number_text.hpp"
#include "write/qml_parts.hpp"

namespace d2b::qml {

std::string colour_text(std::size_t height_class) {
    const auto& [red, green, blue] = height_classes()[height_class].colour;
    return std::to_string(red) + "," + std::to_string(green) + "," + std::to_string(blue) + ",255";
}

std::string class_filter(std::size_t height_class, const std::string& height) {
    const auto classes = height_classes();
    std::string text = height_class == 0 ? height + " IS NOT NULL"
                                         : height + " &gt;= " + number_text(classes[height_class].from);
    if (height_class + 1 < classes.size())
        text += " AND " + height + " &lt; " + number_text(classes[height_class + 1].from);
    return text;
}

std::string defined_property(const std::string& name, const std::string& expression) {
    return "        <Option type=\"Map\" name=\"" + name +
           "\">\n         <Option type=\"bool\" name=\"active\" value=\"true\"/>\n"
           "         <Option type=\"QString\" name=\"expression\" value=\"" +
           expression +
           "\"/>\n         <Option type=\"int\" name=\"type\" value=\"3\"/>\n        </Option>\n";
}

std::string defined_properties(const std::string& element, const std::string& properties) {
    return "     <" + element +
           ">\n      <Option type=\"Map\">\n"
           "       <Option type=\"QString\" name=\"name\" value=\"\"/>\n"
           "       <Option type=\"Map\" name=\"properties\">\n" +
           properties +
           "       </Option>\n       <Option type=\"QString\" name=\"type\" value=\"collection\"/>\n"
           "      </Option>\n     </" +
           element + ">\n";
}

}  // namespace d2b::qml
