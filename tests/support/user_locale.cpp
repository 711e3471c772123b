// Host programs take the locale of their user, so the tests do: no decimal comma may reach a file
// or a message.
#include <clocale>

namespace {

[[maybe_unused]] const char* const user_locale = std::setlocale(LC_ALL, "");

}  // namespace
