# cmake -DSOURCE=web/pendant -DBUILD=build/page -DOUTPUT=page_data.cpp -P pendant_page.cmake
# Bundles the web page in BUILD, where ./dev has installed its npm packages, and writes it as C++; without packages a source
# that refers to the small page that says how to build it.

set(text "// Made by cmake/pendant_page.cmake.\n#include \"tools/pendant/page_files.h\"\n\nnamespace rapidc::pendant {\n\n")
find_program(NODE NAMES node nodejs)
if(NODE AND EXISTS ${BUILD}/node_modules/esbuild AND EXISTS ${BUILD}/node_modules/three)
  file(REMOVE_RECURSE ${BUILD}/src ${BUILD}/styles)
  file(COPY ${SOURCE}/src ${SOURCE}/styles ${SOURCE}/build.mjs ${SOURCE}/index.html ${SOURCE}/icon.svg ${SOURCE}/tsconfig.json
    ${SOURCE}/package.json DESTINATION ${BUILD})
  execute_process(COMMAND ${NODE} build.mjs dist WORKING_DIRECTORY ${BUILD} RESULT_VARIABLE status)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "the web page of web/pendant could not be bundled")
  endif()
  set(entries)
  set(number 0)
  foreach(file "/|index.html|text/html" "/app.js|app.js|text/javascript" "/style.css|style.css|text/css"
      "/icon.svg|icon.svg|image/svg+xml" "/licences.txt|licences.txt|text/plain")
    string(REPLACE "|" ";" parts ${file})
    list(GET parts 0 path)
    list(GET parts 1 name)
    list(GET parts 2 type)
    file(READ ${BUILD}/dist/${name}.gz bytes HEX)
    string(REGEX REPLACE "(..)" "0x\\1," bytes ${bytes})
    string(APPEND text "static const unsigned char kFile${number}[] = {${bytes}};\n")
    string(APPEND entries "    {\"${path}\", \"${type};charset=utf-8\", {reinterpret_cast<const char*>(kFile${number}), sizeof kFile${number}}, true},\n")
    math(EXPR number "${number} + 1")
  endforeach()
  string(APPEND text "\nPageFiles builtPage() {\n    static const PageFile files[] = {\n${entries}    };\n    return files;\n}\n")
else()
  message(STATUS "the web page of web/pendant is left out: ./dev build installs its npm packages")
  string(APPEND text "PageFiles builtPage() {\n    return fallbackPage();\n}\n")
endif()
file(WRITE ${OUTPUT} "${text}\n} // namespace rapidc::pendant\n")
