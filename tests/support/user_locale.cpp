// Host programs take the locale of their user, so the tests do: no decimal comma may reach a file
// or a message. The system's own messages stay in English, for tests that read them.
#include <clocale>

namespace {

[[maybe_unused]] const bool user_locale =
    std::setlocale(LC_ALL, "") != nullptr && std::setlocale(LC_MESSAGES, "C") != nullptr;

}  // namespace
