#include "common/tool_line.hpp"

#include <algorithm>
#include <cstddef>
#include <set>

#include <boost/make_shared.hpp>
#include <boost/program_options.hpp>

#include "dem2buildings/error.hpp"
#include "options/option_checks.hpp"
#include "options/option_values.hpp"

namespace d2b {
namespace {

namespace po = boost::program_options;

class Parser {
  public:
    Parser(const std::vector<ToolOption>& options, std::string_view program)
        : options_(options), program_(program) {}

    [[nodiscard]] ToolLine parse(const std::vector<std::string>& arguments) const;

  private:
    [[nodiscard]] const ToolOption* find(const std::string& name) const {
        const auto found = std::ranges::find(options_, name, &ToolOption::name);
        return found == options_.end() ? nullptr : &*found;
    }
    [[noreturn]] void refuse_syntax(const std::string& token) const;
    [[nodiscard]] std::vector<std::string> joined(const std::vector<std::string>& arguments) const;
    [[nodiscard]] std::vector<po::option> tokens(const std::vector<std::string>& arguments) const;
    [[nodiscard]] std::string value_of(const ToolOption& option, const po::option& parsed) const;

    const std::vector<ToolOption>& options_;
    std::string_view program_;
};

/// Boost refuses a switch with a value and an option without one.
void Parser::refuse_syntax(const std::string& token) const {
    const ToolOption* const option = find(split_name(token).first);
    if (option == nullptr)
        refuse_unknown_option(token, options_, program_);
    if (option->value.empty())
        throw OptionError("-" + option->name + " is a switch and takes no value.");
    throw OptionError("-" + option->name + " needs a value: -" + option->name + " " + option->value + ".");
}

/// Several values of an option become one, which Boost can read.
std::vector<std::string> Parser::joined(const std::vector<std::string>& arguments) const {
    std::vector<std::string> result;
    for (std::size_t i = 0; i < arguments.size(); ++i) {
        const std::string& token = arguments[i];
        const ToolOption* const option = token.starts_with('-') && token.find('=') == std::string::npos
                                             ? find(split_name(token).first)
                                             : nullptr;
        const std::size_t values =
            option == nullptr ? 1 : static_cast<std::size_t>(std::ranges::count(option->value, '<'));
        result.push_back(token);
        if (values <= 1)
            continue;
        if (i + values >= arguments.size())
            refuse_syntax(token);
        result.back() += "=";
        for (std::size_t k = 1; k <= values; ++k)
            result.back() += (k == 1 ? "" : " ") + arguments[i + k];
        i += values;
    }
    return result;
}

std::vector<po::option> Parser::tokens(const std::vector<std::string>& arguments) const {
    // Boost takes "-=x" for the beginning of every name there is.
    for (const std::string& argument : arguments)
        if (argument.starts_with("-=") || argument.starts_with("--="))
            throw OptionError("An option has no name before its =; " + std::string(program_) +
                              " --help lists all.");
    namespace style = po::command_line_style;
    po::options_description description;
    for (const ToolOption& option : options_) {
        const po::value_semantic* semantic = nullptr;  // owned by the description
        if (option.value.empty())
            semantic = new po::untyped_value(true);
        else
            semantic = po::value<std::string>();
        description.add(boost::make_shared<po::option_description>(option.name.c_str(), semantic, ""));
    }
    po::command_line_parser parser(arguments);
    parser.options(description).allow_unregistered();
    parser.style(style::allow_long | style::long_allow_adjacent | style::long_allow_next |
                 style::allow_long_disguise);
    try {
        return parser.run().options;
    } catch (const po::invalid_command_line_syntax& error) {
        refuse_syntax(error.get_option_name());
    }
}

std::string Parser::value_of(const ToolOption& option, const po::option& parsed) const {
    if (option.value.empty())
        return {};
    const bool separate = parsed.original_tokens.size() > 1;
    if (parsed.value.empty() || parsed.value.front().empty() ||
        (separate && looks_like_option(parsed.value.front())))
        refuse_syntax("-" + option.name);
    return parsed.value.front();
}

ToolLine Parser::parse(const std::vector<std::string>& arguments) const {
    const auto end = std::ranges::find(arguments, "--");
    ToolLine line;
    std::set<std::string> given;
    std::vector<std::string> before(arguments.begin(), end);
    std::ranges::transform(before, before.begin(), with_one_help);
    for (const po::option& parsed : tokens(joined(before))) {
        const std::string& token = parsed.original_tokens.front();
        if (parsed.unregistered || (parsed.string_key.empty() && token.size() > 1 && token[0] == '-')) {
            line.unknown = line.unknown.value_or(token);
        } else if (parsed.string_key.empty()) {
            line.names.push_back(parsed.value.front());
        } else {
            const ToolOption* const option = find(parsed.string_key);
            line.given.emplace_back(option - options_.data(), value_of(*option, parsed));
            if (!option->value.empty() && !given.insert(option->name).second)
                throw OptionError("-" + option->name + " is given twice; give it once.");
        }
    }
    line.names.insert(line.names.end(), end == arguments.end() ? end : end + 1, arguments.end());
    return line;
}

}  // namespace

bool looks_like_option(const std::string& token) {
    return token.size() > 1 && token[0] == '-' && !looks_like_number(token);
}

std::pair<std::string, std::string> split_name(const std::string& token) {
    const std::size_t first = token.starts_with("--") ? 2 : 1;
    const std::size_t equals = std::min(token.find('='), token.size());
    return {token.substr(first, equals - first), token.substr(equals)};
}

std::string with_one_help(const std::string& token) {
    const std::string name = looks_like_option(token) ? token.substr(token.starts_with("--") ? 2 : 1) : "";
    return name == "h" || name == "help_all" || name == "help-all" ? "-help" : token;
}

ToolLine take_apart(const std::vector<std::string>& arguments, const std::vector<ToolOption>& options,
                    std::string_view program) {
    return Parser(options, program).parse(arguments);
}

void refuse_unknown_option(const std::string& token, const std::vector<ToolOption>& options,
                           std::string_view program) {
    std::vector<std::string> names{"-config", "-debug", "-formats", "-format", "-optfile", "-help-general"};
    for (const ToolOption& option : options)
        names.push_back(option.name);
    const std::string near = nearest_name(split_name(token).first, names);
    throw OptionError("There is no option " + token.substr(0, token.find('=')) +
                      (near.empty() ? "; " + std::string(program) + " --help lists all."
                                    : "; did you mean -" + near + "?"));
}

std::string option_heading(const ToolOption& option) {
    return "-" + option.name + (option.value.empty() ? "" : " ") + option.value;
}

}  // namespace d2b
