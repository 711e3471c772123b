#include "common/tool_texts.hpp"

#include "common/roff.hpp"
#include "dem2buildings/version.hpp"

namespace d2b {

std::string tool_short_usage(const ToolTexts& texts) {
    return "Usage: " + texts.program + " " + texts.arguments + "\nTry " + texts.program +
           " --help for the options.\n";
}

std::string tool_help(const ToolTexts& texts) {
    std::string text = "Usage: " + texts.program + " " + texts.arguments + "\n\n";
    for (const std::string& paragraph : texts.help)
        text += wrap(paragraph, 0) + "\n";
    text += "Options:\n";
    for (const ToolOption& option : texts.options)
        text += help_entry(option_heading(option), option.help);
    return text + gdal_help() + "\nExit status: 0 done, 1 failed, 2 wrong usage.\n";
}

std::string tool_man_page(const ToolTexts& texts) {
    std::string name = texts.program;
    for (char& letter : name)
        if (letter >= 'a' && letter <= 'z')
            letter = static_cast<char>(letter - 'a' + 'A');
    // Has no date, because the same sources must give the same page.
    std::string text = ".TH " + name + " 1 \"\" \"dem2buildings " + std::string(version) + "\"\n" +
                       roff_section("NAME") + texts.program + " \\- " + texts.title + "\n" +
                       roff_section("SYNOPSIS") + ".B " + texts.program + "\n" + texts.arguments + "\n" +
                       roff_section("DESCRIPTION");
    for (const std::string& paragraph : texts.description)
        text += roff_paragraph(paragraph);
    text += roff_section("OPTIONS");
    for (const ToolOption& option : texts.options)
        text += roff_item(option_heading(option), option.help);
    text += gdal_man_section() + roff_section("EXIT STATUS");
    for (std::size_t status = 0; status < texts.statuses.size(); ++status)
        text += roff_item(std::to_string(status), texts.statuses[status]);
    text += roff_section("EXAMPLES");
    for (const std::string& example : texts.examples)
        text += roff_example(example);
    if (!texts.license.empty())
        text += roff_section("LICENSE") + roff_paragraph(texts.license);
    return text + roff_section("SEE ALSO") + texts.see_also + "\n";
}

std::string asked_text(const TextSwitches& switches, const ToolTexts& texts) {
    if (switches.help)
        return tool_help(texts);
    if (switches.version)
        return texts.program + " " + std::string(version) + ", " + library_versions() + texts.libraries +
               "\n";
    return tool_man_page(texts);
}

}  // namespace d2b
