# Bundles the page in a copy of its sources and writes it as a C++ source:
#     cmake -DSOURCE=web/pendant -DWORK=FOLDER -DOUTPUT=built_page.cpp -DNODE=node -DNPM=npm -P build_page.cmake
# Without node or without the packages of npm the output holds the page that says how to build it, and WORK/not_built says why. A mistake in the page
# ends the build.

# Copies that differ only; packages of an earlier build stay.
file(GLOB_RECURSE files RELATIVE ${SOURCE} ${SOURCE}/*)
list(FILTER files EXCLUDE REGEX "^(node_modules|dist)/")
file(REMOVE_RECURSE ${WORK}/src ${WORK}/styles ${WORK}/not_built)
foreach(file ${files})
  configure_file(${SOURCE}/${file} ${WORK}/${file} COPYONLY)
endforeach()

function(rapidc_fall_back why)
  message("The web page is not built: ${why}. rapidc serve shows a page that says how to build it.")
  file(WRITE ${WORK}/not_built "${why}\n")
  file(WRITE ${OUTPUT} "// Generated: the web page could not be built.\n#include \"tools/pendant/page_files.h\"\n\n"
    "namespace rapidc::pendant {\n\nPageFiles builtPage() {\n    return fallbackPage();\n}\n\n} // namespace rapidc::pendant\n")
endfunction()

if(NOT NODE OR NOT NPM)
  rapidc_fall_back("node and npm are not installed")
  return()
endif()

# The packages, unless those of this very lock file are there.
file(SHA256 ${WORK}/package-lock.json lock)
set(installed "")
if(EXISTS ${WORK}/node_modules/.rapidc-lock)
  file(READ ${WORK}/node_modules/.rapidc-lock installed)
endif()
if(NOT installed STREQUAL lock)
  if(NOT "$ENV{RAPIDC_NO_INSTALL}" STREQUAL "")
    rapidc_fall_back("its npm packages are missing and RAPIDC_NO_INSTALL is set")
    return()
  endif()
  execute_process(COMMAND ${NPM} ci --ignore-scripts --no-audit --no-fund --loglevel=error --fetch-retries=1
    WORKING_DIRECTORY ${WORK} TIMEOUT 300 RESULT_VARIABLE status OUTPUT_VARIABLE text ERROR_VARIABLE text)
  if(NOT status STREQUAL "0" OR NOT EXISTS ${WORK}/node_modules/esbuild/package.json) # npm that was interrupted may say 0
    string(REGEX MATCH "reason: [^\n]+|code [A-Z0-9_]+" reason "${text}")
    if(NOT reason)
      set(reason "status ${status}")
    endif()
    rapidc_fall_back("npm ci failed in ${WORK}, ${reason}")
    file(APPEND ${WORK}/not_built "${text}")
    return()
  endif()
  file(WRITE ${WORK}/node_modules/.rapidc-lock ${lock})
endif()

foreach(command "build.mjs;dist" "embed.mjs;dist;${OUTPUT}")
  execute_process(COMMAND ${NODE} ${command} WORKING_DIRECTORY ${WORK} RESULT_VARIABLE status)
  if(NOT status STREQUAL "0")
    list(JOIN command " " command)
    message(FATAL_ERROR "node ${command} failed in ${WORK}: correct the mistake in web/pendant that is reported above")
  endif()
endforeach()
