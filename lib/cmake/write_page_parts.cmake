# Writes C++ that holds the common parts of all pages.
# cmake -D HTML=... -D STYLE=... -D SCRIPT=... -D LICENCE=... -D OUTPUT=... -P write_page_parts.cmake

# An array, since string literals have a least length that every compiler takes.
function(add_bytes name file)
  file(READ ${file} digits HEX)
  string(REGEX REPLACE "([0-9a-f][0-9a-f])" "'\\\\x\\1'," bytes "${digits}")
  string(APPEND text "constexpr char ${name}_bytes[] = {${bytes}'\\0'};\n")
  set(text "${text}" PARENT_SCOPE)
endfunction()

set(text "#include \"view/page_parts.hpp\"\n\n// NOLINTBEGIN: nobody edits these bytes\nnamespace d2b::view {\nnamespace {\n\n")
foreach(part HTML STYLE SCRIPT LICENCE)
  string(TOLOWER ${part} name)
  add_bytes(${name} ${${part}})
  file(SHA256 ${${part}} ${part}_SHA256)
endforeach()
string(APPEND text "
template <std::size_t size>
constexpr std::string_view text(const char (&bytes)[size]) {
    return {bytes, size - 1};
}

constexpr PageParts parts{text(html_bytes), text(style_bytes), text(script_bytes),
                          \"${STYLE_SHA256}\",
                          \"${SCRIPT_SHA256}\", text(licence_bytes)};

}  // namespace

const PageParts* page_parts() {
    return &parts;
}

}  // namespace d2b::view
// NOLINTEND
")
file(WRITE ${OUTPUT} "${text}")
