# pendant_page: the web page of `rapidc serve` as a source of rapidc_pendant with its compressed files (tools/pendant/page_files.h).
find_program(NODE_PROGRAM node)
find_program(NPM_PROGRAM npm)
set(pendant_source ${CMAKE_SOURCE_DIR}/web/pendant)
set(pendant_work ${CMAKE_BINARY_DIR}/pendant_page)
set(pendant_output ${CMAKE_BINARY_DIR}/generated/pendant/built_page.cpp)
file(GLOB_RECURSE pendant_files CONFIGURE_DEPENDS ${pendant_source}/*)
list(FILTER pendant_files EXCLUDE REGEX "/(node_modules|dist)/")
add_custom_command(OUTPUT ${pendant_output}
  COMMAND ${CMAKE_COMMAND} -DSOURCE=${pendant_source} -DWORK=${pendant_work} -DOUTPUT=${pendant_output}
    "-DNODE=$<$<BOOL:${NODE_PROGRAM}>:${NODE_PROGRAM}>" "-DNPM=$<$<BOOL:${NPM_PROGRAM}>:${NPM_PROGRAM}>"
    -P ${pendant_source}/build_page.cmake
  DEPENDS ${pendant_files}
  COMMENT "Bundling the web page"
  VERBATIM)
add_custom_target(pendant_page DEPENDS ${pendant_output})
set_source_files_properties(${pendant_output} PROPERTIES COMPILE_OPTIONS -Wno-overlength-strings SKIP_PRECOMPILE_HEADERS ON)
target_sources(rapidc_pendant PRIVATE ${pendant_output})
