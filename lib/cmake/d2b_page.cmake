# Parts of pages, from the files of lib/view/page and three.js, which are bundled and packed into C++ here.
# three.js is Debian's (libjs-three), not npm's: the build asks no network then, the version is that of the release and
# gets its security updates, and the sources it was made from are in the archive.
set(D2B_THREE_DIR /usr/share/javascript/three CACHE PATH "Folder of three.module.js, as libjs-three installs it")

# d2b_page_parts(variable): the source that has the parts, or the one that has none.
function(d2b_page_parts variable)
  set(${variable} no_page_parts.cpp PARENT_SCOPE)
  if(NOT D2B_BUILD_PAGE)
    return()
  endif()
  find_program(D2B_ESBUILD_PROGRAM esbuild)
  set(three ${D2B_THREE_DIR}/three.module.js)
  set(orbit ${D2B_THREE_DIR}/examples/jsm/controls/OrbitControls.js)
  if(NOT D2B_ESBUILD_PROGRAM OR NOT EXISTS ${three} OR NOT EXISTS ${orbit})
    message(FATAL_ERROR "D2B_BUILD_PAGE needs esbuild, and three.js in D2B_THREE_DIR (Debian: esbuild libjs-three)")
  endif()
  set(from ${CMAKE_CURRENT_SOURCE_DIR}/page)
  set(script ${CMAKE_CURRENT_BINARY_DIR}/page.js)
  set(parts ${CMAKE_CURRENT_BINARY_DIR}/page_parts.cpp)
  file(GLOB modules CONFIGURE_DEPENDS ${from}/*.js)
  add_custom_command(OUTPUT ${script}
    COMMAND ${D2B_ESBUILD_PROGRAM} ${from}/main.js --bundle --minify --format=iife --target=es2020 --charset=ascii
            --legal-comments=none --log-level=warning --alias:three=${three} --alias:three-orbit=${orbit}
            --outfile=${script}
    DEPENDS ${modules} ${three} ${orbit} VERBATIM COMMENT "Bundling the script of pages")
  set(script_of_build ${PROJECT_SOURCE_DIR}/lib/cmake/write_page_parts.cmake)
  add_custom_command(OUTPUT ${parts}
    COMMAND ${CMAKE_COMMAND} -D HTML=${from}/page.html -D STYLE=${from}/page.css -D SCRIPT=${script}
            -D LICENCE=${from}/three_licence.txt -D OUTPUT=${parts} -P ${script_of_build}
    DEPENDS ${script} ${from}/page.html ${from}/page.css ${from}/three_licence.txt ${script_of_build}
    VERBATIM COMMENT "Packing the parts of pages")
  set_source_files_properties(${parts} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
  set(${variable} ${parts} PARENT_SCOPE)
endfunction()
